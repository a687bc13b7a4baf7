#include "kardan/app/isa.hpp"

#include "kardan/base/isa.hpp"

namespace kardan::app {

namespace {
constexpr const char* names[] = {"x86-64-v2", "x86-64-v3", "x86-64-v4"};
}

const char* to_string(Isa isa) { return names[static_cast<int>(isa)]; }

std::optional<Isa> isa_from(const std::string& name) {
  if (name == "native") return native_isa();
  for (Isa isa : {Isa::v2, Isa::v3, Isa::v4})
    if (name == to_string(isa) || "x86-64-" + name == to_string(isa)) return isa;
  return std::nullopt;
}

Isa native_isa() { return native_level() >= 4 ? Isa::v4 : (native_level() == 3 ? Isa::v3 : Isa::v2); }

void use_isa(Isa isa) { set_kernel_level(static_cast<int>(isa) + lowest_kernel_level); }

}  // namespace kardan::app

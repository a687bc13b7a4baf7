#include "kardan/app/isa.hpp"

#include <cstdlib>

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

Isa native_isa() {
  if (__builtin_cpu_supports("x86-64-v4")) return Isa::v4;
  if (__builtin_cpu_supports("x86-64-v3")) return Isa::v3;
  return Isa::v2;
}

void use_isa(Isa isa) { setenv("KARDAN_ISA", to_string(isa), 1); }  // what elements/ chooses its kernels by

}  // namespace kardan::app

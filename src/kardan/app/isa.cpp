#include "kardan/app/isa.hpp"

namespace kardan::app {

namespace {
constexpr const char* names[] = {"x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4"};
}

const char* to_string(Isa isa) { return names[static_cast<int>(isa)]; }

std::optional<Isa> isa_from(const std::string& name) {
  if (name == "native") return native_isa();
  for (Isa isa : {Isa::v1, Isa::v2, Isa::v3, Isa::v4})
    if (name == to_string(isa) || "x86-64-" + name == to_string(isa)) return isa;
  return std::nullopt;
}

Isa native_isa() {
  if (__builtin_cpu_supports("x86-64-v4")) return Isa::v4;
  if (__builtin_cpu_supports("x86-64-v3")) return Isa::v3;
  if (__builtin_cpu_supports("x86-64-v2")) return Isa::v2;
  return Isa::v1;
}

Isa built_isa() {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  return Isa::v4;
#elif defined(__AVX2__) && defined(__FMA__)
  return Isa::v3;
#elif defined(__SSE4_2__)
  return Isa::v2;
#else
  return Isa::v1;
#endif
}

}  // namespace kardan::app

#include "kardan/elements/shell/shell_kernel.hpp"

#include <cstdlib>
#include <string_view>

namespace kardan {

namespace isa_v2 {
void belytschko_tsay_elastic(ShellTileWork& work);
}
namespace isa_v3 {
void belytschko_tsay_elastic(ShellTileWork& work);
}
namespace isa_v4 {
void belytschko_tsay_elastic(ShellTileWork& work);
}

ShellKernel belytschko_tsay_elastic() {
#if defined(__x86_64__)
  const char* named = std::getenv("KARDAN_ISA");
  const std::string_view wanted = named ? named : "";
  const bool v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
                  __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  if (v4 && wanted != "x86-64-v3" && wanted != "x86-64-v2") return isa_v4::belytschko_tsay_elastic;
  if (v3 && wanted != "x86-64-v2") return isa_v3::belytschko_tsay_elastic;
#endif
  return isa_v2::belytschko_tsay_elastic;
}

}  // namespace kardan

#include "kardan/elements/shell/shell_kernel.hpp"

#include "kardan/base/isa.hpp"

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
  static constexpr ShellKernel kernels[] = {isa_v2::belytschko_tsay_elastic, isa_v3::belytschko_tsay_elastic,
                                            isa_v4::belytschko_tsay_elastic};
  return kernels[kernel_level() - lowest_kernel_level];
}

}  // namespace kardan

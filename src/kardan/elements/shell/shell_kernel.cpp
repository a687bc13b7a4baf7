#include "kardan/elements/shell/shell_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

namespace isa_v2 {
extern const ShellKernels<ShellLaw> belytschko_tsay;
}
namespace isa_v3 {
extern const ShellKernels<ShellLaw> belytschko_tsay;
}
namespace isa_v4 {
extern const ShellKernels<ShellLaw> belytschko_tsay;
}

const ShellKernels<ShellLaw>& belytschko_tsay() {
  static constexpr const ShellKernels<ShellLaw>* kernels[] = {&isa_v2::belytschko_tsay, &isa_v3::belytschko_tsay,
                                                              &isa_v4::belytschko_tsay};
  return *kernels[kernel_level() - lowest_kernel_level];
}

}  // namespace kardan

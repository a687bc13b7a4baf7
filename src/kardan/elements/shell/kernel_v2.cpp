// The shell kernels compiled for x86-64-v2 (the flags are set in src/kardan/CMakeLists.txt).
#define KARDAN_ISA_NAMESPACE isa_v2
#include "kardan/elements/shell/belytschko_tsay.hpp"

namespace kardan::isa_v2 {

extern const ShellKernels<ShellLaw> belytschko_tsay;
const ShellKernels<ShellLaw> belytschko_tsay = kernels_of(static_cast<const ShellLaw*>(nullptr));

}  // namespace kardan::isa_v2

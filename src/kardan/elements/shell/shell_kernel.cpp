#include "kardan/elements/shell/shell_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, belytschko_tsay_kernels);

const TileKernels& belytschko_tsay() { return belytschko_tsay_kernels_of_isa.running(); }

}  // namespace kardan

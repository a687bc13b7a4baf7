#include "kardan/elements/shell/shell_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, belytschko_tsay_kernels);
KARDAN_ISA_OBJECT(TileKernels, c0_triangle_kernels);
KARDAN_ISA_OBJECT(TileKernels, fully_integrated_kernels);

const TileKernels& belytschko_tsay() { return belytschko_tsay_kernels_of_isa.running(); }
const TileKernels& c0_triangle() { return c0_triangle_kernels_of_isa.running(); }
const TileKernels& fully_integrated() { return fully_integrated_kernels_of_isa.running(); }

}  // namespace kardan

#include "kardan/elements/beam/beam_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, belytschko_schwer_kernels);
KARDAN_ISA_OBJECT(TileKernels, truss_kernels);
KARDAN_ISA_OBJECT(TileKernels, hughes_liu_kernels);

const TileKernels& belytschko_schwer() { return belytschko_schwer_kernels_of_isa.running(); }
const TileKernels& truss() { return truss_kernels_of_isa.running(); }
const TileKernels& hughes_liu() { return hughes_liu_kernels_of_isa.running(); }

}  // namespace kardan

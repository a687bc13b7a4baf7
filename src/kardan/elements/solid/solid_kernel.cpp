#include "kardan/elements/solid/solid_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, hexahedron_kernels);

const TileKernels& hexahedron() { return hexahedron_kernels_of_isa.running(); }

}  // namespace kardan

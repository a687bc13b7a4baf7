#include "kardan/elements/solid/solid_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, hexahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, full_hexahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, tetrahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, pentahedron_kernels);

const SolidFormulation one_point_hexahedron{8, 1, 12, []() -> const TileKernels& { return hexahedron_kernels_of_isa.running(); }};
const SolidFormulation full_hexahedron{8, 8, 0, []() -> const TileKernels& { return full_hexahedron_kernels_of_isa.running(); }};
const SolidFormulation one_point_tetrahedron{4, 1, 1, []() -> const TileKernels& { return tetrahedron_kernels_of_isa.running(); }};
const SolidFormulation two_point_pentahedron{6, 2, 1, []() -> const TileKernels& { return pentahedron_kernels_of_isa.running(); }};

}  // namespace kardan

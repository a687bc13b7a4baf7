#include "kardan/elements/solid/solid_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

KARDAN_ISA_OBJECT(TileKernels, hexahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, full_hexahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, quadratic_hexahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, tetrahedron_kernels);
KARDAN_ISA_OBJECT(TileKernels, pentahedron_kernels);

const SolidFormulation one_point_hexahedron{8, 1, 12, []() -> const TileKernels& { return hexahedron_kernels_of_isa.running(); }, nullptr};
const SolidFormulation full_hexahedron{8, 8, 0, []() -> const TileKernels& { return full_hexahedron_kernels_of_isa.running(); }, nullptr};
const SolidFormulation quadratic_hexahedron{8, quadratic_point_count, quadratic_history::count,
                                            []() -> const TileKernels& { return quadratic_hexahedron_kernels_of_isa.running(); },
                                            [](std::size_t point) { return quadratic_points[point].weight / 8; }};
const SolidFormulation one_point_tetrahedron{4, 1, 1, []() -> const TileKernels& { return tetrahedron_kernels_of_isa.running(); }, nullptr};
const SolidFormulation two_point_pentahedron{6, 2, 1, []() -> const TileKernels& { return pentahedron_kernels_of_isa.running(); }, nullptr};

}  // namespace kardan

#include "kardan/elements/solid/hexahedron.hpp"

#include "kardan/materials/laws/piecewise_plastic.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

extern const TileKernels hexahedron_kernels;
const TileKernels hexahedron_kernels = {&solid_tile<Inlined<Elastic>>, &solid_tile<Inlined<PiecewisePlastic>>, &solid_tile<Called>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

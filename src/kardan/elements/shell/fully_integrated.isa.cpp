#include "kardan/elements/shell/fully_integrated.hpp"

#include "kardan/materials/laws/plastic_plane_stress.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

extern const TileKernels fully_integrated_kernels;
const TileKernels fully_integrated_kernels = {&fully_integrated_tile<Inlined<ElasticPlaneStress>>, &fully_integrated_tile<Inlined<PlasticPlaneStress>>, &fully_integrated_tile<Called>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

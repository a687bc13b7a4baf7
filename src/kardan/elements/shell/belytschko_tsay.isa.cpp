#include "kardan/elements/shell/belytschko_tsay.hpp"

#include "kardan/materials/laws/plastic_plane_stress.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

extern const TileKernels belytschko_tsay_kernels;
const TileKernels belytschko_tsay_kernels = {&shell_tile<Inlined<ElasticPlaneStress>>, &shell_tile<Inlined<PlasticPlaneStress>>,
                                             &shell_tile<Called>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

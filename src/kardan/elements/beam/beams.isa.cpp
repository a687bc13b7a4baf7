#include "kardan/elements/beam/beam_tile.hpp"
#include "kardan/materials/beam_stress_of.hpp"
#include "kardan/materials/laws/elastic.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

extern const TileKernels belytschko_schwer_kernels, truss_kernels, hughes_liu_kernels;

const TileKernels belytschko_schwer_kernels = {nullptr, nullptr, &beam_tile<BelytschkoSchwer>};
const TileKernels truss_kernels = {nullptr, nullptr, &beam_tile<Truss<Called>>};
const TileKernels hughes_liu_kernels = {&beam_tile<HughesLiu<Inlined<BeamStressOf<Elastic>>>>, nullptr, &beam_tile<HughesLiu<Called>>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

#include "kardan/elements/solid/hexahedron.hpp"

#include "kardan/materials/laws/piecewise_plastic.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

template <class Law>
void hexahedra(TileWork& work) {
  solid_tile<8, 1, 12, Law>(work, [](const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<8>& block, double* history) {
    hexahedron_pack<Pack>(p, law, place, block, history);
  });
}

}  // namespace

extern const TileKernels hexahedron_kernels;
const TileKernels hexahedron_kernels = {&hexahedra<Inlined<Elastic>>, &hexahedra<Inlined<PiecewisePlastic>>, &hexahedra<Called>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

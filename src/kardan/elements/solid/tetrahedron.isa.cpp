#include "kardan/elements/solid/tetrahedron.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

void tetrahedra(TileWork& work) {
  solid_tile<4, 1, 1, Called>(work, [](const SolidProperties& p, const Called& law, const PackPlace& place, SolidBlock<4>& block, double* history) {
    tetrahedron_pack<Pack>(p, law, place, block, history);
  });
}

}  // namespace

extern const TileKernels tetrahedron_kernels;
const TileKernels tetrahedron_kernels = {nullptr, nullptr, &tetrahedra};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

#include "kardan/elements/solid/pentahedron.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

void pentahedra(TileWork& work) {
  solid_tile<6, 2, 1, Called>(work, [](const SolidProperties& p, const Called& law, const PackPlace& place, SolidBlock<6>& block, double* history) {
    pentahedron_pack<Pack>(p, law, place, block, history);
  });
}

}  // namespace

extern const TileKernels pentahedron_kernels;
const TileKernels pentahedron_kernels = {nullptr, nullptr, &pentahedra};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

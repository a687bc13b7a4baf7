#include "kardan/elements/solid/full_hexahedron.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

void full_hexahedra(TileWork& work) {
  solid_tile<8, 8, 0, Called>(work, [](const SolidProperties& p, const Called& law, const PackPlace& place, SolidBlock<8>& block, double* history) {
    full_hexahedron_pack<Pack>(p, law, place, block, history);
  });
}

}  // namespace

extern const TileKernels full_hexahedron_kernels;
const TileKernels full_hexahedron_kernels = {nullptr, nullptr, &full_hexahedra};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

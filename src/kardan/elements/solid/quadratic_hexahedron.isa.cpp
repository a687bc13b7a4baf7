#include "kardan/elements/solid/quadratic_hexahedron.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

namespace {

void quadratic_hexahedra(TileWork& work) {
  solid_tile<8, quadratic_point_count, quadratic_history::count, Called, 6>(
      work, [](const SolidProperties& p, const Called& law, const PackPlace& place, SolidBlock<8, 6>& block, double* history) {
        quadratic_hexahedron_pack<Pack>(p, law, place, block, history);
      });
}

}  // namespace

extern const TileKernels quadratic_hexahedron_kernels;
const TileKernels quadratic_hexahedron_kernels = {nullptr, nullptr, &quadratic_hexahedra};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

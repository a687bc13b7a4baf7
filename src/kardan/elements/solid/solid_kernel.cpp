#include "kardan/elements/solid/solid_kernel.hpp"

#include "kardan/base/isa.hpp"

namespace kardan {

namespace isa_v2 {
void hexahedron_elastic(SolidTileWork& work);
}
namespace isa_v3 {
void hexahedron_elastic(SolidTileWork& work);
}
namespace isa_v4 {
void hexahedron_elastic(SolidTileWork& work);
}

SolidKernel hexahedron_elastic() {
  static constexpr SolidKernel kernels[] = {isa_v2::hexahedron_elastic, isa_v3::hexahedron_elastic,
                                            isa_v4::hexahedron_elastic};
  return kernels[kernel_level() - lowest_kernel_level];
}

}  // namespace kardan

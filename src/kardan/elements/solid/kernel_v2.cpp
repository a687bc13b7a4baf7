// The solid kernel compiled for x86-64-v2 (the flags are set in src/kardan/CMakeLists.txt).
#define KARDAN_ISA_NAMESPACE isa_v2
#include "kardan/elements/solid/hexahedron.hpp"

namespace kardan::isa_v2 {

void hexahedron_elastic(SolidTileWork& work) {
  solid_tile(work, work.properties->law);
}

}  // namespace kardan::isa_v2

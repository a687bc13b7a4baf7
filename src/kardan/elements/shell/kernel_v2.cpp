// The shell kernel compiled for x86-64-v2 (the flags are set in src/kardan/CMakeLists.txt).
#define KARDAN_ISA_NAMESPACE isa_v2
#include "kardan/elements/shell/belytschko_tsay.hpp"

namespace kardan::isa_v2 {

void belytschko_tsay_elastic(ShellTileWork& work) { shell_tile(work, work.properties->law); }

}  // namespace kardan::isa_v2

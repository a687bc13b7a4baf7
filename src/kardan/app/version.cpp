#include "kardan/app/version.hpp"

#include <fmt/format.h>
#include <omp.h>

#include "kardan/app/isa.hpp"
#include "kardan_build_info.hpp"

namespace kardan::app {

const BuildInfo& build_info() {
  static const BuildInfo info{KARDAN_VERSION, KARDAN_COMMIT, KARDAN_COMPILER, KARDAN_FLAGS};
  return info;
}

std::string version_text() {
  const BuildInfo& info = build_info();
  return fmt::format(
      "kardan {} (commit {})\n"
      "compiler:        {}, {}\n"
      "instruction set: kernels for {}, {} and {}; this machine has {}\n"
      "threads:         OpenMP {}, {} processors\n"
      "MPI:             no MPI in this build\n",
      info.version, info.commit, info.compiler, info.flags, to_string(Isa::v2), to_string(Isa::v3),
      to_string(Isa::v4), to_string(native_isa()), _OPENMP,
      omp_get_num_procs());
}

}  // namespace kardan::app

// What this program is: for --version and summary.json.
#pragma once

#include <string>

namespace kardan::app {

struct BuildInfo {
  std::string version;   ///< of the project
  std::string commit;    ///< short hash, "-modified" where the tree was; "unknown" outside a repository
  std::string compiler;  ///< with version
  std::string flags;
};
const BuildInfo& build_info();

/// The lines of `kardan --version`: version, commit, compiler, instruction set, threads, MPI.
std::string version_text();

}  // namespace kardan::app

// The command line of the program `kardan`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kardan/app/isa.hpp"
#include "kardan/app/verify/verify.hpp"
#include "kardan/rigid/rigid_system.hpp"

namespace kardan::app {

/// Exit codes of the program.
enum ExitCode : int { normal_termination = 0, error_termination = 1, bad_input = 2 };

/// When restart files are written; 0 = not so.
struct CheckpointPlan {
  double seconds = 0;       ///< of wall time between two
  std::int64_t cycles = 0;  ///< between two
};

/// What `kardan run` and `kardan check` are told.
struct RunRequest {
  std::filesystem::path deck;
  std::filesystem::path output;      ///< folder of the results; empty: results/<deck name>
  int threads = 1;
  std::optional<double> end_time, dt;
  std::optional<JointHolding> joints;
  std::optional<Isa> isa;            ///< absent: the best this machine has
  std::vector<std::string> without;  ///< keyword families left out at the user's wish
  std::filesystem::path restart;     ///< folder of a run to go on with; empty: a run from t = 0
  std::optional<CheckpointPlan> checkpoint;  ///< absent: as the deck says
  std::vector<std::string> notes;    ///< on LS-DYNA arguments that mean nothing here

  std::filesystem::path results_folder() const {
    if (output.empty() && !restart.empty()) return restart;
    return output.empty() ? std::filesystem::path("results") / deck.stem() : output;
  }
};

struct Command {
  enum class Kind { run, check, verify, keywords, done } kind = Kind::done;
  RunRequest run;            ///< run, check
  verify::Options verify;    ///< verify
  int exit_code = 0;         ///< done: everything was said while parsing (help, version, bad usage)
};

/// Reads the arguments (without the program's name). Takes LS-DYNA's habit `i=deck.k [ncpu=N] [endtime=T] [memory=…]` too.
/// Help and version go to `out`, bad usage to `err`.
Command parse_command_line(std::vector<std::string> arguments, std::ostream& out, std::ostream& err);

}  // namespace kardan::app

// The command line of the program `kardan`.
#pragma once

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

/// What `kardan run` and `kardan check` are told.
struct RunRequest {
  std::filesystem::path deck;
  std::filesystem::path output;      ///< folder of the results; empty: results/<deck name>
  int threads = 1;
  std::optional<double> end_time, dt;
  std::optional<JointHolding> joints;
  std::optional<Isa> isa;            ///< absent: the best this machine has
  std::vector<std::string> without;  ///< keyword families left out at the user's wish
  std::vector<std::string> notes;    ///< on LS-DYNA arguments that mean nothing here

  std::filesystem::path results_folder() const {
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

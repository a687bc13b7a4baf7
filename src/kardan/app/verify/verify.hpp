// `kardan verify`: runs verification cases and compares them with their oracles.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "kardan/app/verify/case.hpp"

namespace kardan::verify {

struct Options {
  std::vector<std::string> names;  ///< cases and groups: their quick figures; with "-long" behind it: those that take
                                   ///< long runs; empty: every group
  std::filesystem::path root;  ///< folder of the groups; empty: the verification/ this program was built beside
  bool list = false;           ///< only say what there is
  bool json = false;           ///< one JSON object a figure and line
  bool markdown = false;       ///< tables for docs/verification.md
};

/// A figure and what came out.
struct Result {
  const Case* of = nullptr;
  const Figure* figure = nullptr;
  double value = 0;  ///< infinite where the run could not be evaluated
  bool pass = false;
  std::string failure;  ///< why there is no value
};

/// Runs the quick figures of a case or those that take long runs. Never throws: what goes wrong is a failed figure.
enum class Selection { quick, slow };
std::vector<Result> evaluate(const Case& of, Selection selection);

/// The command. Returns the exit code: 0 all figures hold, 1 one falls short, 2 unknown names or an unreadable case.
int run(const Options& options, std::ostream& out, std::ostream& log);

}  // namespace kardan::verify

// `kardan verify`: runs verification cases and compares them with their oracles.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "kardan/app/verify/case.hpp"

namespace kardan::verify {

struct Options {
  std::vector<std::string> names;  ///< cases, groups, or "<group>-long"; empty: every group without its long runs
  std::filesystem::path root;      ///< folder of the groups; empty: the verification/ this program was built beside
  bool list = false;               ///< only say what there is
  bool json = false;               ///< one JSON object a figure and line
  bool markdown = false;           ///< tables for docs/verification.md
};

/// A figure and what came out.
struct Result {
  const Case* of = nullptr;
  const Figure* figure = nullptr;
  double value = 0;       ///< infinite where the run could not be evaluated
  bool pass = false;
  std::string failure;    ///< why there is no value
};

/// Runs those figures of a case that `wanted` names: all, only the quick ones or only the long ones. Never throws: what
/// goes wrong is a failed figure.
enum class Selection { all, quick, slow };
std::vector<Result> evaluate(const Case& of, Selection selection);

/// The command. Returns the exit code: 0 all figures hold, 1 one falls short, 2 unknown names or an unreadable case.
int run(const Options& options, std::ostream& out, std::ostream& log);

}  // namespace kardan::verify

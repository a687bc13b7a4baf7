// A verification case: a folder with decks, oracle tables and case.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "kardan/app/verify/measure.hpp"
#include "kardan/rigid/rigid_system.hpp"

namespace kardan::verify {

/// One run of a deck with a constant step of sample / steps, or with the deck's own.
struct Run {
  std::string name;
  std::filesystem::path deck;
  JointHolding joints = JointHolding::exact;
  double sample = 0;       ///< interval at which signals are recorded
  std::int64_t steps = 0;  ///< cycles in one such interval; 0: the step is the deck's, which deformable parts may shorten
  double end = 0;          ///< time of the last sample
  bool is_long = false;    ///< takes too long for every test run: only with "-long" behind the name

  bool free_step() const { return steps == 0; }
  double dt() const { return sample / static_cast<double>(steps); }
};

/// Where the wanted values come from.
struct Oracle {
  std::filesystem::path file;        ///< a table; or
  std::vector<std::string> columns;  ///< (columns of that table)
  std::string run;                   ///< another signal, of this run; or
  nlohmann::json signal;
  std::vector<double> value;           ///< constant components
  double time_factor = 1, factor = 1;  ///< the table says factor * o(t / time_factor) at t
};

/// One number with its limit.
struct Figure {
  std::string name, unit = "1";
  std::vector<std::string> runs;  ///< one; two for an order of convergence (coarse, fine)
  nlohmann::json signal;
  std::optional<Oracle> oracle;
  Comparison comparison;
  double limit = 0;
  bool at_least = false;  ///< the value must reach the limit rather than stay below it
  std::string note;
};

struct Case {
  std::string name, group, title, proves, source;
  std::filesystem::path folder;
  std::map<std::string, Run> runs;
  std::vector<Figure> figures;

  bool is_long(const Figure& figure) const;
};

/// Reads folder/case.json. @throws CaseError naming the file and what is wrong in it.
Case read_case(const std::filesystem::path& folder, const std::string& group);

/// All cases below `root`, one folder a group and in it one a case, sorted by name.
std::vector<Case> read_cases(const std::filesystem::path& root);

}  // namespace kardan::verify

// Cost of the whole step: a model through Solver::step, as `kardan run` does it, in cycles without output.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kardan/model/model.hpp"
#include "options.hpp"

namespace kardan::bench {

/// What one element costs in one cycle, counted: operations of the kernel, bytes to and from the memory that the cycle must move if
/// nothing stays in a cache from one cycle to the next.
struct Work {
  double flops = 0, bytes = 0;
};

struct StepCase {
  std::string name;      ///< "shell", "solid"
  std::string variant;   ///< "MAT_024 yielding" …
  Model model;
  std::size_t elements = 0;
  Work work;
};

struct StepFigures {
  double ns = 0;         ///< per element-cycle; one thread: of its processor time, several: of the wall clock. Median
  double best = 0;       ///< likewise, the fastest sample
};

/// @param seconds about what the timed cycles may take
StepFigures time_step(const StepCase& c, int threads, double seconds);

/// Prints rows: a table, or JSON, and a CSV file if one is asked for.
class StepReport {
 public:
  explicit StepReport(const Options& options);
  ~StepReport();
  StepReport(const StepReport&) = delete;
  StepReport& operator=(const StepReport&) = delete;

  /// Times the case on 1 and 2 threads (if the machine has them) and prints a row for each.
  void add(const StepCase& c, double seconds);

 private:
  struct Row;
  void print(const Row& row);
  const Options& options_;
  std::vector<std::string> csv_;
  double peak_ = 0;
};

}  // namespace kardan::bench

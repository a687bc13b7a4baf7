// Cost of the whole step: a model through Solver::step, as `kardan run` does it, in cycles without output.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kardan/model/model.hpp"
#include "options.hpp"

namespace kardan::bench {

/// What one element costs in one cycle, counted: operations of the kernel, bytes to and from the memory that the cycle must move if
/// nothing stays in a cache from one cycle to the next.
struct Work {
  double flops = 0, bytes = 0;
};

/// Bytes an element beside its history: connectivity and number; the tile's nodes gathered (x, v and, where there are rotations, the
/// angular velocity), their slots written, read and found; the node's own forces, velocities and position read and written, its place
/// and inverse masses read. One node an element.
inline double bytes_of_nodes(int nodes_per_element, double tile_nodes_per_element, int freedoms) {
  const double vector = freedoms * 8.0;
  const double tile = 24 + vector + 2 * vector + 8;
  const double node = 2 * vector + 2 * vector + 2 * 24 + 12 + 8.0 * freedoms / 3;
  return 2.0 * nodes_per_element + tile_nodes_per_element * tile + node;
}

/// The materials of the benches, steel in kg, mm, ms, kN: *MAT_ELASTIC, *MAT_PIECEWISE_LINEAR_PLASTICITY with eight points of hardening
/// that nothing reaches, and with such that everything does.
using MaterialLaw = decltype(Material::law);
std::vector<std::pair<std::string, MaterialLaw>> laws();
/// Values that a point keeps beside its stress.
inline std::size_t law_values(const MaterialLaw& law) { return std::holds_alternative<ElasticMaterial>(law) ? 0 : 2; }

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

  /// Times the case on 1 and 2 threads (as far as asked for and there) and prints a row for each. The speed-up compares the fastest
  /// samples: on a shared machine the others measure who else is waiting for the cores.
  void add(const StepCase& c, double seconds);

 private:
  struct Row;
  void print(const Row& row);
  const Options& options_;
  std::vector<std::string> csv_;
  double peak_ = 0;
};

}  // namespace kardan::bench

// The progress line of a run.
#pragma once

#include <cstdint>
#include <string>

#include "kardan/app/log.hpp"
#include "kardan/app/ticker.hpp"
#include "kardan/base/timer.hpp"
#include "kardan/solver/observer.hpp"
#include "kardan/state/results.hpp"

namespace kardan::app {

/// The figures of one progress line.
struct ProgressFigures {
  double time = 0, end_time = 0, dt = 0;
  std::string governed_by;        ///< "shell 4711", "DTINIT"
  std::int64_t cycle = 0;
  double seconds_per_cycle = 0;   ///< wall time, mean since the last line
  std::int64_t units = 0;         ///< elements computed a cycle, or bodies where there are none
  const char* unit = "element";   ///< "element" or "body"
  double energy_ratio = 1;
};

/// " 42.3%  t 2.1150e-01 of 5.0000e-01  dt 1.000e-06 (DTINIT)  cycle 211500  812 ns/body-cycle  energy 1.000000  ETA 0:12"
std::string progress_line(const ProgressFigures& figures);

/// "deleted so far: 12 shells, 1 solid"
std::string deletion_line(const ElementResults& results);

/// Says how far the run is, and which elements have been deleted: on a terminal a line redrawn several times a second, elsewhere a line every few seconds.
class Progress : public Observer {
 public:
  explicit Progress(Log& log) : log_(log), ticker_(log.terminal() ? 0.2 : 5.0) {}

  /// A line at the next cycle, due or not.
  void ask() { asked_ = true; }

  bool due(const State& state, const StepView& view) override;
  bool reads_nodes() const override { return false; }
  void at(const Model& model, const State& state, const StepView& view) override;

 private:
  Log& log_;
  Stopwatch watch_;
  Ticker ticker_;
  bool asked_ = true;
  double last_seconds_ = 0;
  std::int64_t deleted_ = 0;  ///< elements, when last looked at
  std::int64_t last_cycle_ = -1;
};

}  // namespace kardan::app

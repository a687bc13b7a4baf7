#include "kardan/app/progress.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kardan::app {

namespace {

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

std::string progress_line(const ProgressFigures& f) {
  const double cycles_left = f.dt > 0 ? (f.end_time - f.time) / f.dt : INFINITY;
  std::string line = fmt::format("{:5.1f}%  t {:.4e} of {:.4e}  dt {:.3e} ({})  cycle {}", 100 * f.time / f.end_time, f.time,
                                 f.end_time, f.dt, f.governed_by, f.cycle);
  if (f.seconds_per_cycle > 0 && f.units > 0)
    line += fmt::format("  {:.0f} ns/{}-cycle", 1e9 * f.seconds_per_cycle / static_cast<double>(f.units), f.unit);
  line += fmt::format("  energy {:.6f}", f.energy_ratio);
  if (f.seconds_per_cycle > 0) line += fmt::format("  ETA {}", duration(cycles_left * f.seconds_per_cycle));
  return line;
}

std::string deletion_line(const ElementResults& results) {
  std::string line = "deleted so far:";
  const char* separator = " ";
  const auto add = [&](std::int64_t count, const char* what) {
    if (count == 0) return;
    line += fmt::format("{}{} {}{}", separator, count, what, count == 1 ? "" : "s");
    separator = ", ";
  };
  add(results.deleted_shells, "shell");
  add(results.deleted_solids, "solid");
  add(results.deleted_beams, "beam");
  return line;
}

bool Progress::due(const State&, const StepView&) { return ticker_.due() || asked_; }

void Progress::at(const Model&, const State& state, const StepView& view) {
  asked_ = false;
  const double now = watch_.seconds();
  ProgressFigures figures;
  figures.time = state.clock.time;
  figures.end_time = view.end_time;
  figures.dt = state.clock.dt;
  figures.governed_by = to_string(view.step);
  figures.cycle = state.clock.cycle;
  if (last_cycle_ >= 0 && figures.cycle > last_cycle_)
    figures.seconds_per_cycle = (now - last_seconds_) / static_cast<double>(figures.cycle - last_cycle_);
  const bool elements = view.elements_processed > 0;
  figures.units = elements ? view.elements_processed : static_cast<std::int64_t>(state.bodies.motion.size());
  figures.unit = elements ? "element" : "body";
  figures.energy_ratio = state.energy.ratio();
  const std::string line = progress_line(figures);
  log_.terminal() && !view.last() ? log_.live(line) : log_.line(line);
  const ElementResults& results = state.results;
  const std::int64_t deleted = results.deleted_shells + results.deleted_solids + results.deleted_beams;
  if (deleted > deleted_) log_.line(deletion_line(results));
  deleted_ = deleted;
  last_seconds_ = now;
  last_cycle_ = figures.cycle;
}

}  // namespace kardan::app

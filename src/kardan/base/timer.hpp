// Wall-clock time of the phases of a step.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace kardan {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Adds up the wall time of phases that follow one another. `Phase` is an enum whose last enumerator is `count`. One
/// reading of the clock a phase (about 20 ns) is all it costs, so it stays on in every run.
template <class Phase>
class PhaseTimers {
 public:
  /// The time until the next lap belongs to that lap's phase.
  void start() { mark_ = Clock::now(); }

  /// Ends `phase`: the time since the last start() or lap() is added to it.
  void lap(Phase phase) {
    const Clock::time_point now = Clock::now();
    spent_[static_cast<std::size_t>(phase)] += now - mark_;
    mark_ = now;
  }

  double seconds(Phase phase) const {
    return std::chrono::duration<double>(spent_[static_cast<std::size_t>(phase)]).count();
  }

  double total() const {
    Clock::duration sum{};
    for (const Clock::duration& d : spent_) sum += d;
    return std::chrono::duration<double>(sum).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point mark_ = Clock::now();
  std::array<Clock::duration, static_cast<std::size_t>(Phase::count)> spent_{};
};

}  // namespace kardan

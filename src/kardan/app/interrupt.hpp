// Ctrl-C and SIGTERM: the first one ends the run after the cycle in progress, a second one ends the program.
#pragma once

#include "kardan/solver/solver.hpp"

namespace kardan::app {

/// While it lives, SIGINT and SIGTERM ask `solver` to stop. One at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(Solver& solver);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace kardan::app

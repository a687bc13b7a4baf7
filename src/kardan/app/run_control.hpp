// What happens between two cycles of a run: restart files when they are due, and what the user orders.
#pragma once

#include <filesystem>
#include <optional>

#include "kardan/app/checkpoints.hpp"
#include "kardan/app/log.hpp"
#include "kardan/app/orders.hpp"
#include "kardan/app/progress.hpp"
#include "kardan/app/result_files.hpp"
#include "kardan/app/ticker.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::app {

/// While it lives, signals are orders. All that it is given must outlive it.
class RunControl {
 public:
  RunControl(Solver& solver, ResultFiles& results, Progress& progress, Checkpoints& checkpoints, std::filesystem::path folder, Log& log);

  /// Before each step. A restart file that cannot be written is a message: the run goes on.
  void between_cycles();

 private:
  void obey(const Orders& orders);
  void write_checkpoint();

  Solver& solver_;
  ResultFiles& results_;
  Progress& progress_;
  Checkpoints& checkpoints_;
  std::filesystem::path folder_;
  Log& log_;
  SignalOrders signals_;
  Ticker look_for_file_;
  std::optional<Ticker> due_;        ///< of restart files by wall time
  std::int64_t cycles_ = 0;          ///< since the last restart file that was due by cycles
};

}  // namespace kardan::app

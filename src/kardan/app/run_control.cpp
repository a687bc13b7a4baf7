#include "kardan/app/run_control.hpp"

#include <fmt/format.h>

#include <utility>

namespace kardan::app {

namespace {

constexpr double seconds_between_looks = 0.5;  ///< for a file d3kil

}  // namespace

RunControl::RunControl(Solver& solver, ResultFiles& results, Progress& progress, Checkpoints& checkpoints, std::filesystem::path folder, Log& log)
    : solver_(solver), results_(results), progress_(progress), checkpoints_(checkpoints), folder_(std::move(folder)), log_(log),
      look_for_file_(seconds_between_looks) {
  if (checkpoints_.plan().seconds > 0) due_.emplace(checkpoints_.plan().seconds);
}

void RunControl::between_cycles() {
  if (signals_.pending()) obey(signals_.take());
  if (look_for_file_.due()) {
    if (const Orders orders = take_file_orders(folder_ / "d3kil"); orders.any()) obey(orders);
  }
  bool due = due_ && due_->due();
  if (checkpoints_.plan().cycles > 0 && cycles_++ == checkpoints_.plan().cycles) {
    due = true;
    cycles_ = 1;
  }
  if (due) write_checkpoint();
}

void RunControl::obey(const Orders& orders) {
  if (!orders.unknown.empty())
    log_.line(fmt::format("warning: d3kil: \"{}\" is none of sw1, sw2, sw3, sw4, swa, stop", orders.unknown));
  if (orders.dump) write_checkpoint();
  if (orders.flush) results_.writer().sync();
  if (orders.status) {
    const Clock& clock = solver_.state().clock;
    if (clock.relaxing) log_.line(fmt::format("dynamic relaxation, cycle {}", clock.cycle));
    progress_.ask();
  }
  if (orders.d3plot) results_.ask_for_d3plot();
  if (!orders.stop) return;
  log_.line(orders.dump ? fmt::format("{}: the run ends; kardan run --restart {} goes on with it", orders.by, folder_.string())
                        : fmt::format("{}: the run ends", orders.by));
  solver_.request_stop();
}

void RunControl::write_checkpoint() {
  try {
    log_.line(checkpoints_.write(solver_, results_));
  } catch (const RunError& error) {
    log_.error(fmt::format("warning: no restart file: {}; the last good one stays, and the run goes on", error.what()));
  }
}

}  // namespace kardan::app

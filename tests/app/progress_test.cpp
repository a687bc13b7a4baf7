#include "kardan/app/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace kardan::app {
namespace {

ProgressFigures figures() {
  ProgressFigures f;
  f.time = 0.2115;
  f.end_time = 0.5;
  f.dt = 1e-6;
  f.governed_by = "shell 4711";
  f.cycle = 211500;
  f.seconds_per_cycle = 4e-5;
  f.units = 1000;
  f.energy_ratio = 0.99987;
  return f;
}

TEST(ProgressLine, SaysHowFarAndHowFast) {
  EXPECT_EQ(progress_line(figures()),
            " 42.3%  t 2.1150e-01 of 5.0000e-01  dt 1.000e-06 (shell 4711)  cycle 211500  40 ns/element-cycle  "
            "energy 0.999870  ETA 0:12");
}

TEST(ProgressLine, LeavesOutWhatIsNotKnownYet) {
  ProgressFigures f = figures();
  f.seconds_per_cycle = 0;
  EXPECT_EQ(progress_line(f),
            " 42.3%  t 2.1150e-01 of 5.0000e-01  dt 1.000e-06 (shell 4711)  cycle 211500  energy 0.999870");
  f.seconds_per_cycle = 1;
  f.unit = "body";
  f.units = 4;
  EXPECT_THAT(progress_line(f), testing::HasSubstr("250000000 ns/body-cycle"));
  EXPECT_THAT(progress_line(f), testing::HasSubstr("ETA 80:08:20"));
}

/// Feeds a Progress the cycles of a run that takes no time.
std::string lines_of_a_run(bool terminal) {
  std::ostringstream out, err;
  Log log(out, err, terminal);
  Progress progress(log);
  State state;
  const StepBound step{1e-3, {}, "DTINIT"};
  const PhaseTimers<Phase> timers;
  for (int cycle = 0; cycle <= 1000; ++cycle) {
    state.clock = {cycle, 1e-3 * cycle, 1e-3, 1e-3};
    StepView view{step, timers, 1.0, cycle == 1000 ? StopReason::end_time : StopReason::running, 0};
    if (view.last() || progress.due(state, view)) progress.at({}, state, view);
  }
  return out.str();
}

TEST(Progress, WritesPlainLinesWithoutATerminal) {
  const std::string text = lines_of_a_run(false);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;  // the first and the last state
  EXPECT_THAT(text, testing::HasSubstr("  0.0%"));
  EXPECT_THAT(text, testing::HasSubstr("100.0%"));
}

TEST(Progress, RedrawsOneLineOnATerminalAndLeavesTheLast) {
  const std::string text = lines_of_a_run(true);
  EXPECT_EQ(text[0], '\r');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace kardan::app

// When files are due.
#include "kardan/io/output_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kardan {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

/// Times written when a run steps from 0 to `end` by `step`; the last step is shortened to hit the end.
std::vector<double> written_times(OutputSchedule schedule, double end, double step) {
  std::vector<double> times;
  double t = 0;
  for (int cycle = 0; cycle < 100000; ++cycle) {
    if (schedule.due(t, step)) {
      times.push_back(t);
      schedule.written(t, step);
      EXPECT_FALSE(schedule.due(t, step)) << "twice at " << t;
    }
    if (t >= end) break;
    t = std::min(t + step, end);
  }
  return times;
}

TEST(OutputSchedule, MultiplesOfDtFromZeroToTheEnd) {
  EXPECT_THAT(written_times({0.25, nullptr, 1.0}, 1.0, 0.05),
              Pointwise(DoubleNear(1e-12), std::vector<double>{0, 0.25, 0.5, 0.75, 1.0}));
}

TEST(OutputSchedule, FirstCycleAtOrAfterTheTimeAndNoDriftWhenDtDoesNotDivide) {
  // Steps of 0.03 reach 0.1 at 0.12, 0.2 at 0.21, 0.3 at 0.30 …; the end time is written though no multiple falls on
  // it.
  EXPECT_THAT(written_times({0.1, nullptr, 0.35}, 0.35, 0.03),
              Pointwise(DoubleNear(1e-12), std::vector<double>{0, 0.12, 0.21, 0.3, 0.35}));
}

TEST(OutputSchedule, RoundingOfTheSummedTimeDoesNotDelayOutput) {
  const auto times = written_times({1e-2, nullptr, 1.0}, 1.0, 1e-4);
  ASSERT_EQ(times.size(), 101u);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], 1e-2 * static_cast<double>(k), 1e-9);
}

TEST(OutputSchedule, StepsLongerThanDtWriteEveryCycleOnce) {
  EXPECT_THAT(written_times({0.01, nullptr, 0.5}, 0.5, 0.1),
              Pointwise(DoubleNear(1e-12), std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(OutputSchedule, CurveGivesTheInterval) {
  Curve curve;
  curve.x = {0.0, 0.4, 0.41, 1.0};
  curve.y = {0.2, 0.2, 0.05, 0.05};
  EXPECT_THAT(written_times({0.0, &curve, 0.6}, 0.6, 0.01),
              Pointwise(DoubleNear(1e-9), std::vector<double>{0, 0.2, 0.4, 0.6}));
  curve.x = {0.0, 0.2, 0.21, 1.0};
  EXPECT_THAT(written_times({0.0, &curve, 0.6}, 0.6, 0.01),
              Pointwise(DoubleNear(1e-9), std::vector<double>{0, 0.2, 0.4, 0.45, 0.5, 0.55, 0.6}));
}

TEST(OutputSchedule, CurveAtZeroPausesTheOutputUntilItRises) {
  Curve curve;
  curve.x = {0.0, 0.1, 0.11, 0.5, 0.51, 1.0};
  curve.y = {0.1, 0.1, -0.1, -0.1, 0.2, 0.2};
  // 0.2 is fixed at 0.1, where the interval is 0.1 still; the next is the first cycle at which the curve is above zero.
  const auto times = written_times({0.0, &curve, 1.0}, 1.0, 0.01);
  ASSERT_EQ(times.size(), 7u);
  EXPECT_NEAR(times[1], 0.1, 1e-9);
  EXPECT_NEAR(times[2], 0.2, 1e-9);
  EXPECT_NEAR(times[3], 0.51, 1e-9);
  EXPECT_NEAR(times[4], 0.71, 1e-9);
  EXPECT_NEAR(times[5], 0.91, 1e-9);
  EXPECT_NEAR(times[6], 1.0, 1e-9);
}

TEST(OutputSchedule, ARunWithoutEndTimeIsNotAlwaysAtItsEnd) {
  OutputSchedule schedule(0.5, nullptr, 0.0);
  ASSERT_TRUE(schedule.due(0.0, 0.1));
  schedule.written(0.0, 0.1);
  EXPECT_FALSE(schedule.due(0.1, 0.1));
  EXPECT_TRUE(schedule.due(0.5, 0.1));
}

}  // namespace
}  // namespace kardan

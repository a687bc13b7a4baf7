#include "kardan/solver/time_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace kardan {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StepBound shell(double dt) { return {dt, {TimeStepOwner::Kind::shell, 4711, 1}, nullptr}; }

/// Runs the clock to `end` with a rule; returns the steps taken.
std::vector<double> steps_to_end(const Model& model, const TimeStepRule& rule, const StepBound& stable, double end) {
  std::vector<double> steps;
  Clock clock;
  ClockHand hand;
  while (clock.time < end && steps.size() < 10'000'000) {
    clock.dt = rule.next(model, clock, stable, infinity).dt;
    steps.push_back(clock.dt);
    hand.advance(clock, end);
  }
  EXPECT_EQ(clock.time, end);
  EXPECT_EQ(clock.cycle, static_cast<std::int64_t>(steps.size()));
  return steps;
}

TEST(TimeStep, ConstantStepsNeitherDriftNorLeaveASliver) {
  Model model;
  model.control.time_step.initial = 1e-6;
  const TimeStepRule rule(model, {}, {}, 0.5);
  const auto steps = steps_to_end(model, rule, {}, 0.5);
  EXPECT_EQ(steps.size(), 500'000u);
  for (double dt : steps) ASSERT_EQ(dt, 1e-6);
}

TEST(TimeStep, TimeOfNEqualStepsIsNTimesDtWithinOneUlp) {
  ClockHand hand;
  Clock clock;
  clock.dt = 1e-5;
  for (int n = 1; n <= 1'000'000; ++n) {
    hand.advance(clock, 1e9);
    const double exact = static_cast<double>(static_cast<long double>(n) * static_cast<long double>(clock.dt));
    ASSERT_LE(std::abs(clock.time - exact), std::nextafter(exact, 1e9) - exact) << n;
  }
}

TEST(TimeStep, RemainderIsHalvedInsteadOfLeavingASliver) {
  Model model;
  model.control.time_step.initial = 0.3;
  const TimeStepRule rule(model, {}, {}, 1.0);
  EXPECT_THAT(steps_to_end(model, rule, {}, 1.0),
              testing::ElementsAre(0.3, 0.3, testing::DoubleEq(0.2), testing::DoubleEq(0.2)));
}

TEST(TimeStep, CourantRuleScalesLimitsGrowthAndNamesTheElement) {
  Model model;
  model.control.time_step.scale = 0.8;
  model.control.time_step.initial = 1e-8;
  StepFacts facts;
  facts.deformable = true;
  const TimeStepRule rule(model, facts, {}, 1.0);
  EXPECT_FALSE(rule.constant());
  Clock clock;
  StepBound step = rule.next(model, clock, shell(1e-6), infinity);
  EXPECT_EQ(step.dt, 1e-8);
  EXPECT_EQ(to_string(step), "DTINIT");
  clock = {1, 1e-8, 1e-8, 1e-8};
  step = rule.next(model, clock, shell(1e-6), infinity);
  EXPECT_DOUBLE_EQ(step.dt, 1.1e-8);
  EXPECT_EQ(to_string(step), "growth");
  clock = {500, 1e-3, 8e-7, 8e-7};
  step = rule.next(model, clock, shell(1e-6), infinity);
  EXPECT_DOUBLE_EQ(step.dt, 8e-7);
  EXPECT_EQ(to_string(step), "shell 4711");
}

TEST(TimeStep, OrderOfRulesWhenNothingDeforms) {
  Model model;
  Curve curve;
  curve.id = 7;
  curve.x = {0, 1};
  curve.y = {1e-4, 3e-4};
  model.curves.push_back(curve);
  StepFacts facts;
  facts.rigid_elements = shell(2e-5);
  facts.rigid_default = 5e-5;
  const Clock clock;
  const auto first = [&](const TimeStepRule& rule) { return rule.next(model, clock, {}, infinity).dt; };

  EXPECT_DOUBLE_EQ(first(TimeStepRule(model, facts, {}, 1.0)), 0.9 * 2e-5);
  facts.rigid_elements = {};
  EXPECT_EQ(first(TimeStepRule(model, facts, {}, 1.0)), 5e-5);
  model.control.time_step.limit = 0;
  const TimeStepRule by_curve(model, facts, {}, 1.0);
  EXPECT_EQ(first(by_curve), 1e-4);
  EXPECT_DOUBLE_EQ(by_curve.next(model, {10, 0.5, 0, 1e-4}, {}, infinity).dt, 2e-4);
  EXPECT_THAT(by_curve.reason(), testing::HasSubstr("curve 7 (LCTM"));
  model.control.time_step.initial = 3e-6;
  EXPECT_EQ(first(TimeStepRule(model, facts, {}, 1.0)), 3e-6);
  EXPECT_EQ(first(TimeStepRule(model, facts, 1e-6, 1.0)), 1e-6);
}

TEST(TimeStep, SpringsAndRotationOnlyEverShortenAConstantStep) {
  Model model;
  model.control.time_step.initial = 1e-4;
  const TimeStepRule rule(model, {}, {}, 1.0);
  EXPECT_EQ(rule.next(model, {}, shell(1e-3), infinity).dt, 1e-4);
  EXPECT_DOUBLE_EQ(rule.next(model, {}, shell(1e-5), infinity).dt, 0.9e-5);
  const StepBound turned = rule.next(model, {}, {}, 2e-5);
  EXPECT_EQ(turned.dt, 2e-5);
  EXPECT_EQ(to_string(turned), "rotation");
}

TEST(TimeStep, CommandLineStepCapsDeformableModels) {
  Model model;
  StepFacts facts;
  facts.deformable = true;
  const TimeStepRule rule(model, facts, 2e-7, 1.0);
  EXPECT_EQ(rule.next(model, {}, shell(1e-6), infinity).dt, 2e-7);
  EXPECT_DOUBLE_EQ(rule.next(model, {}, shell(1e-7), infinity).dt, 0.9e-7);
}

}  // namespace
}  // namespace kardan

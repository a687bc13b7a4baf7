// The decks of examples/ run and do what their comments say.
#include <gtest/gtest.h>

#include <cmath>

#include "kardan/io/deck/load.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan {
namespace {

/// The last state of the slider-crank example (0.5 s, a little more than three turns) against the oracle of the RSSP
/// mechanism: position and velocity of the slider from two independent formulations, 15 digits.
void check_slider_crank(JointHolding joints, double dt, double limit) {
  Diagnostics diagnostics;
  const Model model = deck::load_model(KARDAN_SOURCE_DIR "/examples/slider_crank/slider_crank.k", {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << to_string(diagnostics.all().front());
  EXPECT_TRUE(model.unsupported.empty());
  Solver solver(model, {.joints = joints, .dt = dt}, diagnostics);
  solver.run();
  const State& state = solver.state();
  std::size_t slider = 0;
  while (state.bodies.info[slider].id != 3) ++slider;
  constexpr double peak_velocity = 3.74686213, crank_to_end = 0.4;
  EXPECT_NEAR(state.bodies.motion[slider].center.x, 0.2875398619, limit * crank_to_end);
  EXPECT_NEAR(state.bodies.report[slider].velocity.x, -3.510364013, limit * peak_velocity);
  EXPECT_NEAR(state.energy.ratio(), 1, limit);
  EXPECT_NEAR(state.energy.initial, 13.8407258064516, 1e-9);
}

TEST(Example, SliderCrankWithExactJoints) { check_slider_crank(JointHolding::exact, 1e-5, 1e-4); }
TEST(Example, SliderCrankWithPenaltyJoints) { check_slider_crank(JointHolding::penalty, 1e-6, 1e-4); }

}  // namespace
}  // namespace kardan

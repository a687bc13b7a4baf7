// Loads in the whole step.
#include <gtest/gtest.h>

#include <cmath>

#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

TEST(Loads, PressureMovesARigidBlockByNewtonsLawAndItsWorkIsTheKineticEnergy) {
  Bricks b;
  b.column(b.part(RigidMaterial{.density = 100, .youngs_modulus = 1e9, .poissons_ratio = 0.3}), 1, 0.5);
  PressureLoad load;
  load.segments = {{4, 5, 6, 7}};  // the upper face: downward
  load.curve = b.curve({0, 1}, {1, 1});
  load.scale = 40;
  b.model.pressure_loads.push_back(load);
  load.segments = {{1, 2, 6, 6}};  // half of the face x = 0.5: it turns the block too
  b.model.pressure_loads.push_back(load);
  b.model.control.termination.end_time = 0.5;
  Diagnostics diagnostics;
  Solver solver(b.model, {.dt = 1e-4}, diagnostics);
  const State& state = solver.state();
  ASSERT_TRUE(solver.step());
  const double kick = 0.5e-4, mass = 12.5;
  EXPECT_NEAR(norm(state.bodies.motion[0].velocity - Vec3{-40 * 0.125, 0, -40 * 0.25} * (kick / mass)), 0, 1e-18);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  // The moment stands still in the block, whose lumped inertia is m h^2/2 about every axis: the turn is about one axis.
  const double moment = 40 * 0.125 * std::sqrt(2.0) / 12, inertia = mass * 0.125;
  EXPECT_NEAR(norm(state.bodies.motion[0].angular_velocity), moment * (0.5 + kick) / inertia, 1e-9);
  EXPECT_GT(state.energy.kinetic, 1.0);
  EXPECT_NEAR(state.energy.external_work, state.energy.kinetic, 1e-6 * state.energy.kinetic);
}

}  // namespace
}  // namespace kardan

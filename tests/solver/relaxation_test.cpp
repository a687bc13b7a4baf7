// Dynamic relaxation: static equilibrium at t = 0, and no motion after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kardan/solver/relaxation.hpp"
#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

void relax(Model& model, double tolerance) {
  model.control.relaxation.on = true;
  model.control.relaxation.tolerance = tolerance;
}

/// A mass of 2 at the origin on a spring of 800 to a fixed node at x = 1.
Bricks oscillator() {
  Bricks b;
  const PartIndex p = b.part(SpringMaterial{SpringLaw::elastic_spring, {800.0}, {none, none}});
  b.model.sections[0].kind = ElementKind::discrete;
  b.node({0, 0, 0});
  b.node({1, 0, 0});
  b.model.nodes.constrained[1] = dof_all;
  for (NodeIndex n : {0, 1}) b.model.masses.push_back({n + 1, n, 2.0, none});
  DiscreteElements& d = b.model.discretes;
  d.id = {1};
  d.part = {p};
  d.nodes = {{0, 1}};
  d.orientation = {none};
  d.scale = {1};
  d.print = {0};
  d.offset = {0};
  b.model.control.termination.end_time = 1;
  return b;
}

void pull(Bricks& b, double force, Curve::Phase phase) {
  PointLoad load;
  load.nodes = {0};
  load.scale = -force;
  load.curve = b.curve({0, 1}, {1, 1});
  b.model.curves.back().phase = phase;
  b.model.point_loads.push_back(load);
}

/// The relaxation, and the first step after it.
void relax_and_step(Solver& solver) {
  do ASSERT_TRUE(solver.step());
  while (solver.state().clock.relaxing);
  ASSERT_TRUE(solver.step());
}

TEST(Relaxation, MassOnASpringComesToItsStaticPlaceAndStaysThere) {
  Bricks b = oscillator();
  pull(b, 40, Curve::Phase::both);
  relax(b.model, 1e-12);
  Diagnostics diagnostics;
  Solver solver(b.model, {.dt = 1e-3}, diagnostics);
  relax_and_step(solver);
  const State& state = solver.state();
  EXPECT_EQ(state.clock.cycle, 1);
  EXPECT_EQ(state.clock.time, 1e-3);
  EXPECT_EQ(state.clock.relaxing, 0u);
  double farthest = 0;
  do farthest = std::max(farthest, std::abs(state.nodes.x[0].x + 40.0 / 800));
  while (solver.step());
  EXPECT_LT(farthest, 1e-6 * 0.05);
  EXPECT_NEAR(state.energy.initial, 0.5 * 800 * 0.05 * 0.05, 1e-6);
  EXPECT_NEAR(state.energy.ratio(), 1, 1e-9);
}

TEST(Relaxation, CurvesActInTheirPhaseOnlyAndInitialVelocitiesComeAfterIt) {
  Bricks b = oscillator();
  pull(b, 16, Curve::Phase::relaxation);
  pull(b, 8, Curve::Phase::transient);
  InitialVelocity v;
  v.nodes = {0};
  v.velocity = {0.3, 0, 0};
  b.model.initial_velocities.push_back(v);
  relax(b.model, 1e-12);
  Diagnostics diagnostics;
  Solver solver(b.model, {.dt = 1e-4}, diagnostics);
  solver.run();
  // From -16/800 with 0.3, about -8/800, with omega = 20.
  const double t = solver.state().clock.time;
  EXPECT_NEAR(solver.state().nodes.x[0].x, -0.01 - 0.01 * std::cos(20 * t) + 0.3 / 20 * std::sin(20 * t), 1e-6);
}

TEST(Relaxation, BarUnderItsWeightAndAPressureHasTheStaticSolutionAndDoesNotRing) {
  constexpr int count = 20;
  constexpr double h = 0.1, density = 2000, e = 5e7, nu = 0.25, pressure = 1e4;
  const double modulus = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));  // held sideways
  Bricks b;
  b.column(b.part(ElasticMaterial{density, e, nu, 0, 0}), count, h);
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) b.model.nodes.constrained[n] = n < 4 ? dof_translations : dof_x | dof_y;
  PressureLoad load;
  load.segments = {{4 * count, 4 * count + 1, 4 * count + 2, 4 * count + 3}};
  load.scale = pressure;
  load.curve = b.curve({0, 1}, {1, 1});
  b.model.pressure_loads.push_back(load);
  BodyLoad weight;
  weight.axis = 2;
  weight.curve = b.curve({0, 1}, {9.81, 9.81});
  b.model.body_loads.push_back(weight);
  for (Curve& c : b.model.curves) c.phase = Curve::Phase::both;
  b.model.body_loads[0].relaxation_curve = weight.curve;
  b.model.control.termination.end_time = 0.05;  // two and a half periods
  relax(b.model, 1e-10);
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  relax_and_step(solver);
  const State& state = solver.state();
  const auto height = [&] { return state.nodes.x[4 * count].z; };
  // Small strains: u = p L/M + rho g L^2/(2 M). The pressure follows, the strain is logarithmic: both of second order.
  const double length = count * h, u = (pressure + 0.5 * density * 9.81 * length) * length / modulus;
  EXPECT_NEAR(length - height(), u, 1e-3 * u);
  const double start = height();
  double away = 0;
  while (solver.step()) away = std::max(away, std::abs(height() - start));
  EXPECT_LT(away, 1e-4 * u);  // without the relaxation it would be 2 u
  EXPECT_NEAR(state.energy.ratio(), 1, 1e-6);
}

TEST(Relaxation, WatchesTheDistortionAlone) {
  // Two free masses that fly together and apart: 1/2 m (v + w)^2 + 1/2 m (v - w)^2 = m v^2 + m w^2.
  State state;
  state.nodes.resize(2);
  state.nodes.mass = {3, 3};
  state.nodes.x = {{0, 0, 0}, {1, 0, 0}};
  state.nodes.v = {{5 + 2, 0, 1}, {5 - 2, 0, -1}};  // 1: a turn
  const MotionEnergy energy = motion_energy(state);
  EXPECT_NEAR(energy.total, 3 * (25 + 4 + 1), 1e-12);
  EXPECT_NEAR(energy.distortional, 3 * 4, 1e-12);
}

TEST(Relaxation, IsAtRestOnlyWhenTheEnergyStaysLowBetweenTwoChecks) {
  DynamicRelaxation control;
  control.check = 10;
  control.tolerance = 0.01;
  RelaxationWatch watch(control);
  for (int i = 1; i <= 20; ++i) watch.add({i % 10 == 0 ? 0.0 : 1.0, i % 10 == 0 ? 0.0 : 1.0});  // low at the checks only
  EXPECT_FALSE(watch.at_rest());
  for (int i = 1; i <= 10; ++i) watch.add({0.009, 0.009});
  EXPECT_TRUE(watch.at_rest());
  EXPECT_NEAR(watch.ratio(), 0.009, 1e-15);
}

}  // namespace
}  // namespace kardan

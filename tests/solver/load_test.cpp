// Loads in the whole step.
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Damping, RigidBodySlowsByTheFormOfTheHalfStepAndTheLedgerIsClosed) {
  Bricks b;
  const PartIndex p = b.part(RigidMaterial{.density = 100, .youngs_modulus = 1e9, .poissons_ratio = 0.3});
  b.column(p, 2, 0.5);
  InitialVelocity v;
  v.kind = InitialVelocity::Kind::rigid_body;
  v.body_part = p;
  v.velocity = {3, -2, 1};
  v.angular_velocity = {2, 0.1, 3};  // not about a principal axis: it tumbles
  b.model.initial_velocities.push_back(v);
  DampingLaw law;
  law.value = 4;
  b.model.dampings.push_back(law);
  b.model.control.termination.end_time = 0.5;
  Diagnostics diagnostics;
  const double dt = 1e-3;
  Solver solver(b.model, {.dt = dt}, diagnostics);
  const State& state = solver.state();
  const Vec3 momentum = state.bodies.motion[0].angular_momentum;
  EXPECT_EQ(solver.run(), StopReason::end_time);
  const double factor = (2 - 4 * dt / 2) / (2 + 4 * dt / 2) * std::pow((2 - 4 * dt) / (2 + 4 * dt), 500);
  EXPECT_NEAR(norm(state.bodies.motion[0].velocity - Vec3{3, -2, 1} * factor), 0, 1e-13);
  EXPECT_NEAR(norm(state.bodies.motion[0].angular_momentum - momentum * factor), 0, 1e-12 * norm(momentum));
  EXPECT_GT(state.energy.system_damping, 0.9 * state.energy.initial);
  EXPECT_NEAR(state.energy.ratio(), 1, 1e-5);
}

/// Elastic bar of 120 cubes along z, held against all motion but that along `dof`; its lower end moves by a smooth pulse of
/// velocity 1, its upper end is a non-reflecting boundary. @return the largest speed left in the bar once the pulse should be gone.
double speed_left(int dof, bool dilatational, bool shear) {
  constexpr int count = 120;
  constexpr double h = 0.01, density = 2000, e = 5e9, nu = 0.25;
  const double speed = std::sqrt((dof == 3 ? e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) : e / (2 * (1 + nu))) / density);
  Bricks b;
  b.column(b.part(ElasticMaterial{density, e, nu, 0, 0}), count, h);
  const double length = count * h, pulse = 30 * h / speed;
  for (auto& held : b.model.nodes.constrained) held = static_cast<std::uint8_t>(dof_translations & ~(1u << (dof - 1)));
  PrescribedMotion motion;
  motion.nodes = {0, 1, 2, 3};
  motion.dof = dof;
  std::vector<double> t, v;
  for (int i = 0; i <= 60; ++i) {
    t.push_back(pulse * i / 60);
    v.push_back(std::pow(std::sin(M_PI * i / 60), 2));
  }
  motion.curve = b.curve(t, v);
  b.model.prescribed_motions.push_back(motion);
  NonReflectingBoundary boundary;
  boundary.segments = {{4 * count, 4 * count + 1, 4 * count + 2, 4 * count + 3}};
  boundary.dilatational = dilatational;
  boundary.shear = shear;
  b.model.non_reflecting.push_back(boundary);
  b.model.control.termination.end_time = 1.5 * length / speed + pulse / 2;  // what comes back would be in the middle
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.run();
  double largest = 0;
  for (const Vec3& node : solver.state().nodes.v) largest = std::max(largest, norm(node));
  if (dilatational && shear) {
    // All the work of the motion has left: the sum of both is the energy that is still in the bar.
    const EnergyLedger& energy = solver.state().energy;
    EXPECT_NEAR(energy.total(), energy.external_work, 1e-3 * 0.5 * density * h * h * 30 * h);
  }
  return largest;
}

TEST(NonReflecting, PlaneWavesLeaveAndOnlyTheKindsThatMay) {
  EXPECT_LT(speed_left(3, true, true), 0.01);
  EXPECT_LT(speed_left(1, true, true), 0.01);
  EXPECT_GT(speed_left(3, false, true), 0.9);
  EXPECT_GT(speed_left(1, true, false), 0.9);
}

TEST(RigidGroups, SwitchedPartKeepsItsMomentaItsShapeAndItsStresses) {
  Bricks b;
  const NodeIndex first = b.column(b.part(ElasticMaterial{7800, 210e9, 0.3, 0, 0}), 6, 0.1);
  for (NodeIndex n = 0; n < 28; ++n) {
    InitialVelocity v;
    v.nodes = {n};
    const Vec3& x = b.model.nodes.x[static_cast<std::size_t>(n)];
    v.velocity = Vec3{30 * x.z, 5, 0} + cross(Vec3{10, 20, 100}, x);  // shears and turns
    b.model.initial_velocities.push_back(v);
  }
  b.model.rigid_groups.push_back({"part 1", {}, 2e-3, 6e-3, {}});
  for (NodeIndex n = 0; n < 28; ++n) b.model.rigid_groups[0].nodes.push_back(first + n);
  b.model.control.hourglass_type = 4;
  b.model.control.termination.end_time = 8e-3;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  const State& state = solver.state();
  struct Momenta {
    Vec3 linear, angular;
    double size = 0;
  };
  const auto momenta = [&] {
    Momenta m;
    for (std::size_t n = 0; n < 28; ++n) {
      const Vec3 p = state.nodes.v[n] * state.nodes.mass[n];
      m.linear += p;
      m.angular += cross(state.nodes.x[n], p);
      m.size += norm(p);
    }
    return m;
  };
  const auto length = [&] { return norm(state.nodes.x[0] - state.nodes.x[26]); };
  const auto strain = [&](double from) { return std::abs(length() / from - 1); };
  const Momenta start = momenta();
  double at_switch = 0, rigid = 0, soft = 0, turn = 0;
  while (solver.step()) {
    const double time = state.clock.time;
    if (time < 2e-3 + state.clock.dt_previous) at_switch = length();
    if (time < 2e-3) soft = std::max(soft, strain(norm(b.model.nodes.x[0] - b.model.nodes.x[26])));
    if (time > 2e-3 && time < 6e-3) rigid = std::max(rigid, strain(at_switch));
    if (time > 6e-3) turn = std::max(turn, strain(at_switch));
  }
  const Momenta end = momenta();
  EXPECT_LT(norm(end.linear - start.linear), 1e-12 * start.size);
  EXPECT_LT(norm(end.angular - start.angular), 1e-12 * start.size);
  EXPECT_GT(soft, 1e-4);
  EXPECT_LT(rigid, 1e-12);
  EXPECT_GT(turn, 1e-5);  // the stresses were kept: it springs back
}

}  // namespace
}  // namespace kardan

// Rigid walls in the whole step.
#include "kardan/contact/rigid_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

constexpr double density = 7800;

/// A column of elastic cubes of edge 0.1 above the plane z = 0, skewed by `gap`; all nodes have one velocity and are tracked.
Bricks column_over_wall(int count, double gap, const Vec3& velocity, double friction) {
  Bricks b;
  const PartIndex p = b.part(ElasticMaterial{density, 210e9, 0.3, 0, 0});
  b.column(p, count, 0.1, {0, 0, gap});
  b.model.control.hourglass_type = 4;
  b.model.control.time_step.scale = 0.6;
  RigidWall wall;
  wall.id = 7;
  wall.normal = {0, 0, 1};
  wall.friction = friction;
  InitialVelocity initial;
  initial.velocity = velocity;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    wall.nodes.push_back(static_cast<NodeIndex>(n));
    initial.nodes.push_back(static_cast<NodeIndex>(n));
  }
  b.model.rigid_walls.push_back(wall);
  b.model.initial_velocities.push_back(initial);
  return b;
}

Vec3 momentum(const State& s) {
  Vec3 p;
  for (std::size_t n = 0; n < s.nodes.v.size(); ++n) p += s.nodes.v[n] * s.nodes.mass[n];
  return p;
}

struct Watch : Observer {
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& state, const StepView&) override {
    Vec3 p = momentum(state);
    const double kick = state.clock.kick();
    worst_momentum = std::max(worst_momentum, norm(p - before + state.walls[0].force * kick));
    worst_energy = std::max(worst_energy, std::abs(state.energy.total() - state.energy.initial));
    largest_force = std::max(largest_force, state.walls[0].normal_force);
    before = p;
    for (const Vec3& x : state.nodes.x) deepest = std::min(deepest, x.z);
    if (state.walls[0].normal_force > 0) last_contact = state.clock.time;
  }
  Vec3 before;
  double worst_momentum = 0, worst_energy = 0, largest_force = 0, deepest = 1, last_contact = 0;
};

/// An elastic bar meets the wall: stress rho c v times the area, contact during 2 L/c, rebound with nearly its velocity; momentum and
/// energy are accounted for. (One-dimensional only roughly: the bar is free to swell.)
TEST(RigidWall, ElasticBarRebounds) {
  const double speed = 2, length = 2, c = std::sqrt(210e9 / density);
  Bricks b = column_over_wall(20, 0.00137, {0, 0, -speed}, 0);
  b.model.control.termination.end_time = 0.00137 / speed + 4 * length / c;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  Watch watch;
  watch.before = {0, 0, -speed * density * length * 0.01};
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  const double initial = 0.5 * density * length * 0.01 * speed * speed;
  EXPECT_LT(watch.worst_momentum, 1e-12 * norm(momentum(solver.state())));
  EXPECT_LT(watch.worst_energy, 0.01 * initial);
  EXPECT_GE(watch.deepest, -1e-15);
  EXPECT_NEAR(watch.last_contact - 0.00137 / speed, 2 * length / c, 0.1 * 2 * length / c);
  const double rebound = momentum(solver.state()).z / (density * length * 0.01);
  EXPECT_NEAR(rebound, speed, 0.1 * speed);
  // The impact takes the energy of the nodes at the wall only: half of the first element's mass.
  EXPECT_NEAR(solver.state().energy.stonewall, initial / 40, 0.3 * initial / 40);
}

/// Impulse and peak of the wall's force, as it acts and as the files show it.
struct WallHistory : Observer {
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& state, const StepView&) override {
    const WallReport& wall = state.walls[0];
    impulse += wall.force * state.clock.kick();
    eased_impulse += wall.eased_force * state.clock.kick();
    eased_normal_impulse += wall.eased_normal_force * state.clock.kick();
    peak = std::max(peak, wall.normal_force);
    eased_peak = std::max(eased_peak, wall.eased_normal_force);
  }
  Vec3 impulse, eased_impulse;
  double eased_normal_impulse = 0, peak = 0, eased_peak = 0;
};

/// A cube so soft that its weight is all that the wall feels stops at once: a peak of m v/dt, which files show as a tenth of it and its decay, with
/// the same impulse, friction included. With SOFT the length of the impact is the user's, and is shown as it is.
TEST(RigidWall, FilesShowTheImpulsesOfArrivalsHandedOut) {
  for (const int soft_cycles : {0, 5}) {
    Bricks b;
    const PartIndex p = b.part(ElasticMaterial{density, 1e5, 0, 0, 0});
    b.column(p, 1, 0.1, {0, 0, 1e-4});
    RigidWall wall;
    wall.normal = {0, 0, 1};
    wall.friction = 0.25;
    wall.soft_cycles = soft_cycles;
    InitialVelocity initial;
    initial.velocity = {3, 0, -2};
    for (NodeIndex n = 0; n < 8; ++n) {
      wall.nodes.push_back(n);
      initial.nodes.push_back(n);
    }
    b.model.rigid_walls.push_back(wall);
    b.model.initial_velocities.push_back(initial);
    b.model.control.termination.end_time = 2e-6 * 400;
    Diagnostics diagnostics;
    Solver solver(b.model, {.dt = 2e-6}, diagnostics);
    WallHistory history;
    solver.attach(history);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const double arrival = 0.5 * density * 1e-3 * 2;  // the lower nodes'
    EXPECT_NEAR(history.impulse.z, -arrival, 0.06 * arrival);  // and what its little stiffness adds
    EXPECT_NEAR(history.impulse.x, 0.25 * arrival, 0.06 * arrival);
    EXPECT_LT(norm(history.eased_impulse - history.impulse), 1e-12 * arrival);
    EXPECT_NEAR(history.eased_normal_impulse, -history.impulse.z, 1e-12 * arrival);
    if (soft_cycles == 0) {
      EXPECT_GT(history.peak, 0.5 * arrival / 2e-6);
      EXPECT_LT(history.eased_peak, 0.11 * arrival / 2e-6);
    } else {
      EXPECT_EQ(history.eased_peak, history.peak);
    }
  }
}

/// A cube slides on the wall under gravity: it stops after v^2/(2 mu g), goes on without friction, and does not move with FRIC = 1.
TEST(RigidWall, FrictionIsCoulombs) {
  const double speed = 1, gravity = 500;
  for (const double friction : {0.0, 0.25, 1.0}) {
    Bricks b = column_over_wall(1, 0, {speed, 0, 0}, friction);
    BodyLoad load;
    load.axis = 2;
    load.curve = b.curve({0, 1}, {gravity, gravity});
    b.model.body_loads.push_back(load);
    b.model.control.termination.end_time = 0.01;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    double way = 0;
    for (std::size_t n = 0; n < 4; ++n) way += (solver.state().nodes.x[n].x - b.model.nodes.x[n].x) / 4;
    const double expected = friction == 0 ? 0.01 * speed : friction < 1 ? speed * speed / (2 * friction * gravity) : 0.0;
    EXPECT_NEAR(way, expected, (friction < 1 ? 0.03 : 0.1) * 0.004) << friction;  // held, the cube rocks a little
    if (friction == 0.25) {
      EXPECT_NEAR(solver.state().energy.stonewall, 0.5 * density * 0.001 * speed * speed, 0.02 * 3.9);
    }
  }
}

TEST(RigidWall, WarnsOfNodesBehindItAndLeavesRigidBodiesAlone) {
  Bricks b = column_over_wall(2, -0.05, {0, 0, 0}, 0);
  const PartIndex rigid = b.part(RigidMaterial{.density = density, .youngs_modulus = 210e9, .poissons_ratio = 0.3});
  const NodeIndex first = b.column(rigid, 1, 0.1, {1, 0, 0.3});
  for (NodeIndex n = first; n < first + 8; ++n) b.model.rigid_walls[0].nodes.push_back(n);
  b.model.control.termination.end_time = 1e-4;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += d.message + "\n";
  EXPECT_NE(text.find("4 nodes begin behind rigid wall 7"), std::string::npos) << text;
  EXPECT_NE(text.find("does not hold 8 of its nodes"), std::string::npos) << text;
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_EQ(solver.state().nodes.x[0].z, -0.05);  // held where it was, not thrown out
}

}  // namespace
}  // namespace kardan

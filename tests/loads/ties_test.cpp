// Nodes tied to one another: momenta, exactness of the tie, failure of welds.
#include <gtest/gtest.h>

#include <cmath>

#include "kardan/base/rotation.hpp"
#include "loads/bench.hpp"

namespace kardan {
namespace {

/// Five nodes without a pattern, of different masses.
Bench five_nodes(double inertia) {
  Bench b;
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0.2, 0}, Vec3{0.3, 1.1, 0.4}, Vec3{-0.2, 0.5, 1}, Vec3{0.7, 0.6, 0.5}}) b.node(x);
  b.size_state(1.0, inertia);
  for (std::size_t n = 0; n < 5; ++n) b.state.nodes.mass[n] = 1.0 + 0.7 * static_cast<double>(n);
  return b;
}

TEST(CommonMotion, NodesShareTheMeanVelocityByMassAlongTheTiedAxesOnly) {
  Bench b = five_nodes(0.1);
  CommonMotion set;
  set.nodes = {0, 2, 3};
  set.dofs = dof_x | dof_z;
  set.death = 0.25;
  b.model.common_motions.push_back(set);
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  b.stir();
  const Vec3 momentum = b.momentum();
  const Vec3 y_before{b.state.nodes.v[0].y, b.state.nodes.v[2].y, b.state.nodes.v[3].y};
  const double gap = b.state.nodes.x[2].x - b.state.nodes.x[0].x;
  for (int i = 0; i < 2; ++i) b.step(loads, 0.1, [](State& s) { s.nodes.force[3] = {5, 5, 5}; });
  EXPECT_EQ(b.state.nodes.v[0].x, b.state.nodes.v[3].x);
  EXPECT_EQ(b.state.nodes.v[0].z, b.state.nodes.v[2].z);
  EXPECT_NEAR(b.state.nodes.x[2].x - b.state.nodes.x[0].x, gap, 1e-14);
  EXPECT_EQ(b.state.nodes.v[0].y, y_before.x);
  EXPECT_NEAR(norm(b.momentum() - momentum - Vec3{5, 5, 5} * 0.15), 0, 1e-13);
  b.step(loads, 0.1);
  const double x = b.state.nodes.v[0].x;
  b.step(loads, 0.1, [](State& s) { s.nodes.force[0] = {9, 0, 0}; });  // t = 0.3: the set has let go
  EXPECT_NEAR(b.state.nodes.v[0].x, x + 9 * 0.1 / 1.0, 1e-14);
  EXPECT_EQ(b.state.nodes.v[3].x, x);
}

TEST(Weld, KeepsMomentaAndEveryDistanceThroughWholeTurns) {
  Bench b = five_nodes(0.05);
  b.model.rigid_groups.push_back({"weld 7", {0, 1, 2, 3}, 0, 1e20, {}});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  b.stir();
  for (Vec3& v : b.state.nodes.v) v *= 3;
  const Vec3 momentum = b.momentum(), angular = b.angular_momentum();
  const std::vector<Vec3> start = b.state.nodes.x;
  for (int i = 0; i < 2000; ++i) b.step(loads, 0.01);
  EXPECT_GT(norm(b.state.nodes.omega[0]), 1.0);  // some turns
  EXPECT_EQ(b.state.nodes.omega[0], b.state.nodes.omega[3]);
  EXPECT_LT(norm(b.momentum() - momentum), 1e-12 * 30);
  EXPECT_LT(norm(b.angular_momentum() - angular), 1e-12 * 30 * norm(b.state.nodes.x[0]));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR(norm(b.state.nodes.x[i] - b.state.nodes.x[j]), norm(start[i] - start[j]), 1e-11);
  EXPECT_NEAR(b.state.nodes.v[4].x, 3 * std::sin(1 + 28.0), 1e-14);  // not of the weld
}

TEST(Weld, TwoNodesOfSolidsHaveNoInertiaAboutTheirLineAndStillTurn) {
  Bench b;
  b.node({0, 0, 0});
  b.node({0, 0, 2});
  b.size_state(3.0, 1.0);
  b.state.nodes.inertia = {0, 0};
  b.model.rigid_groups.push_back({"weld 1", {0, 1}, 0, 1e20, {}});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.state.nodes.v[0] = {1, 0, 0};
  b.state.nodes.v[1] = {-1, 0, 0};
  const auto step = [&] {  // the bench divides by the inertia
    b.state.clock.dt = 0.01;
    loads.constrain_velocities(b.model, b.state);
    for (std::size_t n = 0; n < 2; ++n) b.state.nodes.x[n] += b.state.nodes.v[n] * 0.01;
  };
  for (int i = 0; i < 300; ++i) step();
  EXPECT_NEAR(norm(b.state.nodes.x[1] - b.state.nodes.x[0]), 2, 1e-12);
  const double angle = 300 * 2 * std::atan(0.5 * 0.01 * norm(b.state.nodes.omega[0]));  // about -y, from the z axis
  EXPECT_NEAR(std::atan2(-b.state.nodes.x[1].x, b.state.nodes.x[1].z - 1), std::remainder(angle, 2 * M_PI), 1e-10);
  EXPECT_NEAR(norm(b.state.nodes.omega[0]), 1, 1e-4);
}

/// A pair along z, pulled apart by `normal` on each node and sheared by `shear`; true if it has parted after two steps.
bool parts(const RigidGroup::Failure& failure, double normal, double shear) {
  Bench b;
  b.node({0, 0, 0});
  b.node({0, 0, 0.1});
  b.size_state(2.0, 1e6);  // inert: the pair does not turn
  b.model.rigid_groups.push_back({"weld 1", {0, 1}, 0, 1e20, failure});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 2; ++i)
    b.step(loads, 1e-3, [&](State& s) {
      s.nodes.force[0] = {shear, 0, -normal};
      s.nodes.force[1] = {-shear, 0, normal};
    });
  return norm(b.state.nodes.v[1] - b.state.nodes.v[0]) > 1e-4;
}

TEST(Weld, FailsByItsTensionAndShear) {
  const RigidGroup::Failure linear{100, 50, 1, 1}, square{100, 50, 2, 2}, tension_only{100, 0, 1, 1};
  EXPECT_FALSE(parts(linear, 99, 0));
  EXPECT_TRUE(parts(linear, 101, 0));
  EXPECT_FALSE(parts(linear, -1e6, 0));  // pressure does not break it
  EXPECT_FALSE(parts(linear, 0, 49.9));
  EXPECT_TRUE(parts(linear, 0, 50.1));
  EXPECT_TRUE(parts(linear, 60, 25));
  EXPECT_FALSE(parts(square, 80, 29.9));  // 0.64 + 0.3576
  EXPECT_TRUE(parts(square, 80, 30.1));
  EXPECT_FALSE(parts(tension_only, 50, 1e6));
}

TEST(LinearEquation, HoldsAndKeepsWhatItsForcesBalance) {
  Bench b = five_nodes(0.1);
  // Two equations that share a node: u0x - u1x = 0, u1x + 2 u2y - 0.5 rot3z = 0, and the first again (redundant).
  b.model.linear_equations.push_back({1, {{0, 1, none, 1}, {1, 1, none, -1}}});
  b.model.linear_equations.push_back({2, {{1, 1, none, 1}, {2, 2, none, 2}, {3, 6, none, -0.5}}});
  b.model.linear_equations.push_back({3, {{0, 1, none, 3}, {1, 1, none, -3}}});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  b.stir();
  double turned = 0;
  const std::vector<Vec3> start = b.state.nodes.x;
  for (int i = 0; i < 50; ++i) {
    b.step(loads, 0.01, [](State& s) { s.nodes.force[0] = {3, 1, 0}; });
    turned += 0.01 * b.state.nodes.omega[3].z;
  }
  const auto u = [&](std::size_t n) { return b.state.nodes.x[n] - start[n]; };
  EXPECT_NEAR(u(0).x - u(1).x, 0, 1e-13);
  EXPECT_NEAR(u(1).x + 2 * u(2).y - 0.5 * turned, 0, 1e-13);
  // The virtual work of the constraint vanishes: against the force 3, both velocities answer by their generalised mass.
  const double before = b.state.nodes.v[0].x;
  b.step(loads, 0.01, [](State& s) { s.nodes.force[0] = {3, 0, 0}; });
  const double mass = 1.0 + 1.7 + 0;  // nodes 0 and 1; then u2y = -u1x/2 + rot/4 adds the least of the rest
  const double rest = 1 / (4 / 2.4 + 0.25 / 0.1);  // of 2 v2 - w3/2 = -v: min 1/2 (m v2^2 + I w^2)
  EXPECT_NEAR(b.state.nodes.v[0].x - before, 3 * 0.01 / (mass + rest), 1e-14);
}

TEST(Interpolation, DependentNodeFollowsARigidTurnExactlyAndMomentaAreKept) {
  Interpolation tie;
  tie.dependent = 4;
  tie.dofs = dof_all;
  Bench free_tie = five_nodes(0.2);
  tie.nodes = {0, 1, 2, 3};
  tie.weight = {1, 2, 0.5, 1};
  free_tie.model.interpolations.push_back(tie);
  LoadSystem loads(free_tie.model, free_tie.state, free_tie.diagnostics);
  ASSERT_TRUE(free_tie.diagnostics.ok());
  free_tie.stir();
  const Vec3 momentum = free_tie.momentum(), angular = free_tie.angular_momentum();
  for (int i = 0; i < 200; ++i) free_tie.step(loads, 0.005);
  EXPECT_LT(norm(free_tie.momentum() - momentum), 1e-12 * 20);
  EXPECT_LT(norm(free_tie.angular_momentum() - angular), 1e-12 * 20);
  // Rigid turn of all five: no forces, so it goes on; the tie must not disturb it although each step turns by a finite angle.
  Bench rigid = five_nodes(0.2);
  rigid.model.interpolations.push_back(tie);
  LoadSystem rigid_loads(rigid.model, rigid.state, rigid.diagnostics);
  const Mat3 turn = to_matrix(from_rotation_vector({0.03, -0.05, 0.04}));
  std::vector<Vec3> wanted = rigid.state.nodes.x;
  for (int i = 0; i < 20; ++i) {
    for (std::size_t n = 0; n < 5; ++n) {
      wanted[n] = turn * wanted[n];
      if (n != 4) rigid.state.nodes.v[n] = (wanted[n] - rigid.state.nodes.x[n]) / 0.01;
    }
    for (std::size_t n = 0; n < 4; ++n) rigid.state.nodes.mass[n] = 1e30;  // driven
    rigid.step(rigid_loads, 0.01);
  }
  EXPECT_LT(norm(rigid.state.nodes.x[4] - wanted[4]), 1e-12);
}

TEST(Interpolation, WeightsGiveTheMeanAndTheForceIsShared) {
  Bench b;
  for (const Vec3& x : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 0}}) b.node(x);
  Interpolation tie;
  tie.dependent = 3;
  tie.dofs = dof_z;
  tie.nodes = {0, 1, 2};
  tie.weight = {1, 1, 2};
  b.model.interpolations.push_back(tie);
  b.size_state(1.0);
  b.state.nodes.mass[3] = 1e-12;
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  b.step(loads, 2.0, [](State& s) { s.nodes.force[3] = {0, 0, 8}; });  // kick 1
  // Centre (0, 1, 0): the force 8 there and the moment of the arm -1 in y, shared as the fit weighs.
  EXPECT_NEAR(b.state.nodes.v[0].z + b.state.nodes.v[1].z + b.state.nodes.v[2].z, 8, 1e-9);
  EXPECT_NEAR(b.state.nodes.v[0].z, 4, 1e-9);
  EXPECT_NEAR(b.state.nodes.v[1].z, 4, 1e-9);
  EXPECT_NEAR(b.state.nodes.v[2].z, 0, 1e-9);  // the dependent node stands on the line of the two others
}

/// Along the local x, at 30 degrees to the global one, the dependent node follows; across it flies on.
TEST(Interpolation, LocalAxesOfTheDependentNode) {
  Bench b;
  for (const Vec3& x : {Vec3{1, 0, 0}, Vec3{-1, 1, 0}, Vec3{-1, -1, 0}, Vec3{0.2, 0.1, 0.3}}) b.node(x);
  const double c = std::cos(0.5), s = std::sin(0.5);
  Frame frame;
  frame.axes = Mat3::columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  b.model.frames.push_back(frame);
  Interpolation tie;
  tie.dependent = 3;
  tie.dofs = dof_x;
  tie.frame = 0;
  tie.nodes = {0, 1, 2};
  tie.weight = {1, 1, 1};
  tie.asks_rotations = true;
  b.model.interpolations.push_back(tie);
  b.size_state(1.0);
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  EXPECT_EQ(b.diagnostics.warning_count(), 1u) << "the nodes have rotary inertia, and IDOF 456 takes no part";
  b.state.nodes.v[3] = {1, 2, 3};
  b.state.clock.dt = 1e-9;
  loads.constrain_velocities(b.model, b.state);
  const auto& v = b.state.nodes.v;
  const Vec3 along{c, s, 0}, across{-s, c, 0};
  // The motion of the three at the place of the fourth: V + W x d; here from the momentum balance.
  EXPECT_NEAR(dot(v[3], across), -s + 2 * c, 1e-12);
  EXPECT_NEAR(v[3].z, 3, 1e-12);
  EXPECT_NEAR(dot(v[0] + v[1] + v[2] + v[3], along), c + 2 * s, 1e-12);
  EXPECT_LT(dot(v[3], along), 0.9 * (c + 2 * s));
}

/// A weld of two masses that are pulled apart: axial and shear force of half the difference, until it breaks; then none.
TEST(Weld, ReportsItsForcesForSwforc) {
  Bench b;
  b.node({0, 0, 0}), b.node({0, 0, 0.5});
  RigidGroup weld;
  weld.name = "weld 7";
  weld.weld = RigidGroup::Weld::spot;
  weld.weld_id = 7;
  weld.nodes = {0, 1};
  weld.failure = RigidGroup::Failure{100, 0, 2, 2};
  b.model.rigid_groups = {weld};
  b.size_state(2.0, 0.0);
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  ASSERT_EQ(b.state.welds.size(), 1u);
  const WeldReport& report = b.state.welds[0];
  EXPECT_EQ(report.id, 7);
  b.state.nodes.inertia = {1.0, 1.0};
  b.step(loads, 1e-3, [](State& s) { s.nodes.force[1] = {0, 0, 60}; });
  EXPECT_NEAR(report.axial, 30, 1e-9);
  EXPECT_NEAR(report.shear, 0, 1e-9);
  EXPECT_EQ(report.length, 0.5);
  b.step(loads, 1e-3, [](State& s) { s.nodes.force[0] = s.nodes.force[1] = {40, 0, 0}; });
  EXPECT_NEAR(report.axial, 0, 1e-9);
  EXPECT_FALSE(report.failed);
  b.step(loads, 1e-3, [](State& s) { s.nodes.force[1] = {0, 0, 300}; });
  EXPECT_TRUE(report.failed);
  EXPECT_NEAR(report.axial, 150, 1e-9);
  EXPECT_NEAR(report.failure_time, 2e-3, 1e-12);
  b.step(loads, 1e-3, [](State& s) { s.nodes.force[1] = {0, 0, 300}; });
  EXPECT_EQ(report.axial, 0);
}

TEST(Ties, RefuseNodesThatAreHeldOrTiedTwice) {
  Bench b = five_nodes(0.1);
  b.model.nodes.constrained[0] = dof_x;
  b.model.common_motions.push_back({1, {0, 1}, dof_y, 1e20});  // another direction than the support: allowed
  b.model.common_motions.push_back({2, {0, 2}, dof_x, 1e20});
  b.model.rigid_groups.push_back({"weld 3", {1, 3}, 0, 1e20, {}});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_EQ(b.diagnostics.error_count(), 2u);
  EXPECT_NE(b.diagnostics.all()[0].message.find("node 1 of constrained node set 2"), std::string::npos);
  EXPECT_NE(b.diagnostics.all()[1].message.find("node 2 of weld 3"), std::string::npos);
}

}  // namespace
}  // namespace kardan

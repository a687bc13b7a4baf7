#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loads/bench.hpp"

namespace kardan {
namespace {

BodyLoad gravity(CurveIndex curve, int axis) {
  BodyLoad load;
  load.axis = axis;
  load.curve = curve;
  return load;
}

TEST(LoadSystem, GravityIsAFreeFallToTheLastDigitsAndItsWorkIsTheKineticEnergy) {
  Bench b;
  b.node({1, 2, 3});
  b.model.body_loads.push_back(gravity(b.curve({0, 1}, {9.81, 9.81}), 2));
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  ASSERT_TRUE(b.diagnostics.ok());
  for (int i = 0; i < 100; ++i) b.step(loads, 0.01);
  EXPECT_NEAR(b.state.nodes.x[0].z, 3 - 0.5 * 9.81 * 1.0, 1e-12);  // leapfrog with half a first kick is exact here
  EXPECT_DOUBLE_EQ(b.state.nodes.x[0].x, 1.0);
  // At t_n the mean of the two half-step velocities is exact: 1/2 m (g t)^2, less the (g dt/2)^2 that the product drops.
  const double t = 0.99, g = 9.81;
  EXPECT_NEAR(b.state.energy.external_work, 0.5 * 2.0 * g * g * t * t, 2.0 * g * g * 1e-4);
}

TEST(LoadSystem, WorkUpToAClosedKickEqualsTheKineticEnergyExactly) {
  Bench b;
  b.node({0, 0, 0});
  PointLoad load;
  load.nodes = {0};
  load.dof = 1;
  load.curve = b.curve({0, 1}, {0, 50});
  b.model.point_loads.push_back(load);
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 50; ++i) b.step(loads, 0.01);
  // One step of length zero force: the last kick's second half is closed by the next account, whose own share is its first half.
  const double energy = b.kinetic_energy_after_kick();
  b.model.curves[0].y = {0, 0};
  b.step(loads, 0.01);
  EXPECT_NEAR(b.state.energy.external_work, energy, 1e-12 * energy);
}

TEST(LoadSystem, CentrifugalForceOnNodesAndOnABodyOfTheSameMasses) {
  Bench b;
  const Vec3 points[] = {{3, 1, 0.5}, {4, -1, 0.2}, {3.5, 0.3, -1}};
  for (const Vec3& p : points) b.node(p);
  BodyLoad load = gravity(b.curve({0, 1}, {7, 7}), 5);
  load.center = {0.5, -0.5, 0};
  b.model.body_loads.push_back(load);
  b.size_state(2.0);
  Vec3 center;
  for (const Vec3& p : points) center += p / 3.0;
  Mat3 j{};
  for (const Vec3& p : points) {
    const Vec3 r = p - center;
    j += (Mat3::identity() * dot(r, r) - outer(r, r)) * 2.0;
  }
  const PrincipalAxes principal = principal_axes(j);
  b.body(6.0, principal.values, center);
  b.state.bodies.motion[0].orientation = from_matrix(principal.axes);
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.state.clock.dt = 1;
  b.clear_forces();
  loads.apply(b.model, b.state);
  Vec3 force, moment;
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3 radial{points[n].x - 0.5, points[n].y + 0.5, 0};
    EXPECT_NEAR(norm(b.state.nodes.force[n] - radial * (2.0 * 49)), 0, 1e-12);
    force += b.state.nodes.force[n];
    moment += cross(points[n] - center, b.state.nodes.force[n]);
  }
  EXPECT_NEAR(norm(b.state.bodies.force[0] - force), 0, 1e-11);
  EXPECT_NEAR(norm(b.state.bodies.moment[0] - moment), 0, 1e-11);
  EXPECT_GT(norm(moment), 1.0);  // the case is not a symmetric one
}

TEST(LoadSystem, BodyLoadOnPartsLeavesTheOthersAlone) {
  Bench b;
  for (int i = 0; i < 8; ++i) b.node({double(i), 0, 0});
  b.model.parts.resize(2);
  for (int p = 0; p < 2; ++p) {
    b.model.shells.id.push_back(p + 1);
    b.model.shells.part.push_back(p);
    b.model.shells.nodes.push_back({4 * p, 4 * p + 1, 4 * p + 2, 4 * p + 3});
  }
  BodyLoad load = gravity(b.curve({0, 1}, {10, 10}), 0);
  load.parts = {1};
  b.model.body_loads.push_back(load);
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.clear_forces();
  loads.apply(b.model, b.state);
  EXPECT_EQ(b.state.nodes.force[3], (Vec3{0, 0, 0}));
  EXPECT_EQ(b.state.nodes.force[4], (Vec3{-20, 0, 0}));
}

TEST(LoadSystem, FollowerForceIsNormalToItsThreeNodesAsTheyMove) {
  Bench b;
  b.node({0, 0, 0});
  b.node({1, 0, 0});
  b.node({0, 1, 0});
  PointLoad load;
  load.nodes = {0};
  load.dof = 4;
  load.curve = b.curve({0, 1}, {3, 3});
  load.m = {0, 1, 2};
  b.model.point_loads.push_back(load);
  load.dof = 8;
  b.model.point_loads.push_back(load);
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.clear_forces();
  loads.apply(b.model, b.state);
  EXPECT_EQ(b.state.nodes.force[0], (Vec3{0, 0, 3}));
  b.state.nodes.x[2] = {0, 0, 2};  // the plane is now x-z, its normal -y
  b.clear_forces();
  loads.apply(b.model, b.state);
  EXPECT_EQ(b.state.nodes.force[0], (Vec3{0, -3, 0}));
  EXPECT_EQ(b.state.nodes.moment[0], (Vec3{0, -3, 0}));
  EXPECT_EQ(b.state.nodes.needed[2], 1);
}

TEST(LoadSystem, LoadOnARigidBodyInALocalFrame) {
  Bench b;
  b.model.parts.resize(1);
  Frame frame;
  frame.axes = Mat3::columns({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  b.model.frames.push_back(frame);
  PointLoad load;
  load.body_part = 0;
  load.dof = 5;
  load.frame = 0;
  load.scale = 4;
  load.curve = b.curve({0, 1}, {1, 1});
  b.model.point_loads.push_back(load);
  b.size_state();
  b.state.bodies.of_part[0] = b.body(1, {1, 1, 1}, {});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  loads.apply(b.model, b.state);
  EXPECT_EQ(b.state.bodies.moment[0], (Vec3{0, 4, 0}));
  EXPECT_EQ(b.state.bodies.force[0], (Vec3{0, 0, 0}));
}

TEST(LoadSystem, PrescribedDisplacementIsExactWithAnyStep) {
  Bench b;
  b.node({1, 0, 0});
  PrescribedMotion motion;
  motion.nodes = {0};
  motion.dof = 2;
  motion.kind = MotionKind::displacement;
  motion.scale = 2;
  motion.curve = b.curve({0, 0.3, 1}, {0, 1, -1});
  b.model.prescribed_motions.push_back(motion);
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 90; ++i) {
    b.step(loads, 0.005 + 0.003 * (i % 3));
    EXPECT_NEAR(b.state.nodes.x[0].y, 2 * b.model.curves[0].value(b.state.clock.time), 1e-14);
  }
  EXPECT_EQ(b.state.nodes.x[0].x, 1.0);
}

TEST(LoadSystem, PrescribedVelocityAndAccelerationFollowTheirIntegrals) {
  Bench b;
  b.node({0, 0, 0});
  b.node({0, 0, 0});
  PrescribedMotion motion;
  motion.nodes = {0};
  motion.kind = MotionKind::velocity;
  motion.curve = b.curve({0, 2}, {0, 2});  // v = t: x = t^2/2
  b.model.prescribed_motions.push_back(motion);
  motion.nodes = {1};
  motion.kind = MotionKind::acceleration;
  motion.curve = b.curve({0, 2}, {3, 3});
  b.model.prescribed_motions.push_back(motion);
  b.size_state();
  b.state.nodes.v[1] = {5, 0, 0};
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 100; ++i) b.step(loads, 0.01);
  EXPECT_NEAR(b.state.nodes.x[0].x, 0.5, 1e-13);
  EXPECT_NEAR(b.state.nodes.x[1].x, 5 + 1.5, 1e-12);
  EXPECT_NEAR(b.state.reactions[1].force.x, 2 * 3, 1e-10);
  // Work of the force 2*3 over the distance at t = 0.99.
  EXPECT_NEAR(b.state.reactions[1].work, 6 * (5 * 0.99 + 1.5 * 0.99 * 0.99), 1e-3);
}

TEST(LoadSystem, RotationAboutAnOffsetAxisKeepsRadiusAndAngle) {
  Bench b;
  b.node({0.5, 3, 1});
  PrescribedMotion motion;
  motion.nodes = {0};
  motion.dof = -9;
  motion.kind = MotionKind::displacement;
  motion.offset_1 = 1;  // y
  motion.offset_2 = 1;  // z
  motion.curve = b.curve({0, 1}, {0, 2 * std::numbers::pi});
  b.model.prescribed_motions.push_back(motion);
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  for (int i = 0; i < 16; ++i) {
    b.step(loads, 1.0 / 16);
    const double angle = 2 * std::numbers::pi * (i + 1) / 16;
    EXPECT_NEAR(b.state.nodes.x[0].y, 1 + 2 * std::cos(angle), 1e-13);
    EXPECT_NEAR(b.state.nodes.x[0].z, 1 + 2 * std::sin(angle), 1e-13);
  }
  EXPECT_EQ(b.state.nodes.x[0].x, 0.5);
}

TEST(LoadSystem, SupportsInSkewFramesHoldTogetherAndReportTheirReactions) {
  Bench b;
  b.node({0, 0, 0});
  b.model.nodes.constrained[0] = dof_x;
  Frame frame;
  const double c = std::cos(0.3), s = std::sin(0.3);
  frame.axes = Mat3::columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  b.model.frames.push_back(frame);
  SinglePointConstraint spc;
  spc.id = 77;
  spc.nodes = {0};
  spc.dofs = dof_x | dof_rz;
  spc.frame = 0;
  b.model.constraints.push_back(spc);
  PointLoad load;
  load.nodes = {0};
  load.dof = 2;
  load.curve = b.curve({0, 1}, {10, 10});
  b.model.point_loads.push_back(load);
  load.dof = 7;
  b.model.point_loads.push_back(load);
  b.size_state();
  b.state.nodes.v[0] = {1, 1, 4};
  LoadSystem loads(b.model, b.state, b.diagnostics);
  EXPECT_EQ(b.state.nodes.v[0].x, 0.0);
  for (int i = 0; i < 10; ++i) b.step(loads, 0.1);
  EXPECT_NEAR(b.state.nodes.x[0].x, 0, 1e-14);
  EXPECT_NEAR(b.state.nodes.x[0].z, 4.0, 1e-13);  // free
  ASSERT_EQ(b.state.reactions.size(), 2u);
  const Vec3 sum = b.state.reactions[0].force + b.state.reactions[1].force;
  EXPECT_NEAR(sum.y, -10, 1e-12);
  EXPECT_NEAR(sum.x, 0, 1e-12);
  EXPECT_NEAR(b.state.reactions[1].moment.z, -10, 1e-12);
  EXPECT_EQ(b.state.reactions[1].id, 77);
}

TEST(LoadSystem, BirthAndDeathOfASupport) {
  Bench b;
  b.node({0, 0, 0});
  SinglePointConstraint spc;
  spc.nodes = {0};
  spc.dofs = dof_x;
  spc.birth = 0.25;
  spc.death = 0.55;
  b.model.constraints.push_back(spc);
  b.model.body_loads.push_back(gravity(b.curve({0, 1}, {-10, -10}), 0));
  b.size_state();
  LoadSystem loads(b.model, b.state, b.diagnostics);
  double held = 0;
  for (int i = 0; i < 10; ++i) {
    const double before = b.state.nodes.x[0].x;
    b.step(loads, 0.1);
    if (b.state.nodes.x[0].x == before) held += 1;
  }
  EXPECT_EQ(held, 3);  // at 0.3, 0.4, 0.5
}

TEST(LoadSystem, NodesOfBodiesAreLeftToTheBodies) {
  Bench b;
  b.node({0, 0, 0});
  b.model.nodes.constrained[0] = dof_all;
  b.model.body_loads.push_back(gravity(b.curve({0, 1}, {10, 10}), 2));
  b.size_state();
  b.state.nodes.body[0] = b.body(3, {1, 1, 1}, {});
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.state.nodes.v[0] = {1, 2, 3};
  b.clear_forces();
  loads.apply(b.model, b.state);
  loads.constrain_velocities(b.model, b.state);
  EXPECT_EQ(b.state.nodes.v[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(b.state.nodes.force[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(b.state.bodies.force[0], (Vec3{0, 0, -30}));
  EXPECT_TRUE(b.state.reactions.empty());
}

TEST(InitialVelocity, LaterOverridesEarlierAndExemptNodesHaveTheirOwn) {
  Bench b;
  for (int i = 0; i < 4; ++i) b.node({double(i), 0, 0});
  InitialVelocity all;
  all.all_nodes = true;
  all.velocity = {1, 0, 0};
  all.exempt = {3};
  all.exempt_velocity = {0, 0, 9};
  b.model.initial_velocities.push_back(all);
  InitialVelocity one;
  one.nodes = {1};
  one.velocity = {0, 2, 0};
  b.model.initial_velocities.push_back(one);
  b.size_state();
  LoadSystem::set_initial_velocities(b.model, b.state, b.diagnostics);
  EXPECT_EQ(b.state.nodes.v[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(b.state.nodes.v[1], (Vec3{0, 2, 0}));
  EXPECT_EQ(b.state.nodes.v[3], (Vec3{0, 0, 9}));
}

TEST(InitialVelocity, GenerationTurnsAPartAboutAnAxis) {
  Bench b;
  for (int i = 0; i < 5; ++i) b.node({double(i), 1, 2});
  b.model.parts.resize(1);
  b.model.shells.id.push_back(1);
  b.model.shells.part.push_back(0);
  b.model.shells.nodes.push_back({0, 1, 2, 3});
  InitialVelocity g;
  g.kind = InitialVelocity::Kind::generation;
  g.parts = {0};
  g.velocity = {0, 0, 1};
  g.omega = 3;
  g.axis_point = {1, 1, 0};
  g.axis_direction = {0, 0, 2};
  b.model.initial_velocities.push_back(g);
  b.size_state();
  LoadSystem::set_initial_velocities(b.model, b.state, b.diagnostics);
  EXPECT_EQ(b.state.nodes.v[3], (Vec3{0, 6, 1}));
  EXPECT_EQ(b.state.nodes.omega[3], (Vec3{0, 0, 3}));
  EXPECT_EQ(b.state.nodes.v[4], (Vec3{0, 0, 0}));
}

TEST(LoadSystem, RefusesWhatCannotBe) {
  Bench b;
  b.node({0, 0, 0});
  b.model.parts.resize(1);
  b.model.parts[0].id = 12;
  PointLoad load;
  load.body_part = 0;
  load.curve = b.curve({0, 1}, {1, 1});
  b.model.point_loads.push_back(load);
  load.body_part = none;
  load.nodes = {0};
  load.dof = 4;
  b.model.point_loads.push_back(load);
  PrescribedMotion motion;
  motion.nodes = {0};
  motion.kind = MotionKind::relative_displacement;
  b.model.prescribed_motions.push_back(motion);
  b.size_state();
  const LoadSystem loads(b.model, b.state, b.diagnostics);
  EXPECT_EQ(b.diagnostics.error_count(), 3u);
  EXPECT_NE(b.diagnostics.all()[0].message.find("part 12"), std::string::npos);
}

}  // namespace
}  // namespace kardan

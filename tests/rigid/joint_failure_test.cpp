// Joints that fail: by time, force, moment and both together; the pieces fly on freely.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

class JointFailureLaw : public testing::TestWithParam<JointHolding> {};

TEST_P(JointFailureLaw, ByTimeAndTheMomentaAreKept) {
  Mechanism m;
  const PartIndex a = m.body(2.0, {-0.5, 0, 0}, skew_inertia({0.1, 0.2, 0.25}), {0.4, -0.3, 0.2}, {0, 0, 3});
  const PartIndex b = m.body(1.0, {0.5, 0, 0}, skew_inertia({0.05, 0.08, 0.1}), {}, {1, 2, 0});
  Joint::Failure failure;
  failure.time = 0.5;
  m.joint(JointKind::spherical, a, b, {{}, {}}).failure = failure;
  Simulation run(m.model, 1e-4, GetParam());
  run.to(0.0);
  const Vec3 p = run.linear_momentum(), l = run.angular_momentum();
  run.to(0.499);
  EXPECT_EQ(run.state.joints[0].failed, 0);
  EXPECT_GT(norm(run.state.joints[0].force), 0.1);
  run.to(0.51);
  EXPECT_EQ(run.state.joints[0].failed, 1);
  EXPECT_EQ(run.state.joints[0].force, (Vec3{}));
  const Vec3 v = run.motion(b).velocity, x = run.motion(b).center, spin = run.motion(b).angular_momentum;
  const double e = run.kinetic_energy();
  run.to(1.51);
  EXPECT_EQ(run.motion(b).velocity, v);  // no force: not a bit of it changes
  EXPECT_EQ(run.motion(b).angular_momentum, spin);
  EXPECT_LT(norm(run.motion(b).center - x - v * 1.0), 1e-11);
  EXPECT_LT(norm(run.linear_momentum() - p), 1e-12 * norm(p));
  EXPECT_LT(norm(run.angular_momentum() - l), 1e-12 * norm(l));
  EXPECT_NEAR(run.kinetic_energy() / e, 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Both, JointFailureLaw, testing::Values(JointHolding::exact, JointHolding::penalty));

/// A body welded to ground by a locking joint at the origin and loaded by a force F and moment M that grow as t.
double time_of_failure(const Joint::Failure& failure, const Vec3& force, const Vec3& moment, const Mat3* axes = nullptr) {
  Mechanism m;
  const PartIndex ground = m.ground(), body = m.body(1.0, {}, Mat3::identity());
  const Vec3 x{1, 0, 0}, y{0, 1, 0};
  Joint& joint = m.joint(JointKind::locking, ground, body, {{}, {}, x, x, y, y});
  joint.failure = failure;
  if (axes) {
    Frame frame;
    frame.axes = *axes;
    m.model.frames.push_back(frame);
    joint.failure->frame = 0;
  }
  Simulation run(m.model, 1e-3);
  run.load = [&](State& s) {
    s.bodies.force[1] = force * s.clock.time;
    s.bodies.moment[1] = moment * s.clock.time;
  };
  for (int n = 1; n <= 1000; ++n) {
    run.to(1e-3 * n);
    if (!run.state.joints[0].failed) continue;
    EXPECT_LT(norm(run.motion(body).center), 1e-14);  // held until then
    run.to(1e-3 * n + 0.1);
    EXPECT_GT(norm(run.motion(body).velocity) + norm(run.motion(body).angular_velocity), 0.1);
    return 1e-3 * n;
  }
  return 0;
}

TEST(JointFailure, ByForceResultant) {
  Joint::Failure f;
  f.limits = {3, 4, 0, 0, 0, 0};  // z takes no part
  EXPECT_NEAR(time_of_failure(f, {6, 0, 100}, {}), 0.5, 1.1e-3);
  EXPECT_NEAR(time_of_failure(f, {-6, 0, 0}, {}), 0.5, 1.1e-3);
  // (6 t / 3)^2 + (8 t / 4)^2 = 1
  EXPECT_NEAR(time_of_failure(f, {6, 8, 0}, {}), std::sqrt(1.0 / 8.0), 1.1e-3);
  EXPECT_EQ(time_of_failure(f, {2.9, 0, 100}, {100, 0, 0}), 0.0);  // never
}

TEST(JointFailure, ByMomentResultant) {
  Joint::Failure f;
  f.limits = {0, 0, 0, 0, 2, 5};
  EXPECT_NEAR(time_of_failure(f, {100, 0, 0}, {100, 4, 0}), 0.5, 1.1e-3);
  EXPECT_NEAR(time_of_failure(f, {}, {0, 4, 10}), std::sqrt(1.0 / 8.0), 1.1e-3);
}

TEST(JointFailure, CouplingAddsForceAndMoment) {
  Joint::Failure f;
  f.limits = {3, 0, 0, 0, 0, 5};
  // Apart: the larger of 2 t and 2 t; together: 8 t^2 = 1.
  EXPECT_NEAR(time_of_failure(f, {6, 0, 0}, {0, 0, 10}), 0.5, 1.1e-3);
  f.coupling = 1;
  EXPECT_NEAR(time_of_failure(f, {6, 0, 0}, {0, 0, 10}), std::sqrt(1.0 / 8.0), 1.1e-3);
}

TEST(JointFailure, ResultantsStandInTheirFrame) {
  Joint::Failure f;
  f.limits = {3, 0, 0, 0, 0, 0};
  const Mat3 axes = to_matrix(normalized(Quat{0.7, -0.2, 0.5, 0.3}));
  EXPECT_NEAR(time_of_failure(f, axes.column(0) * 6.0 + axes.column(1) * 50.0, {}, &axes), 0.5, 1.1e-3);
  EXPECT_EQ(time_of_failure(f, axes.column(2) * 50.0, {}, &axes), 0.0);
}

TEST(JointFailure, OneOfTwoHingesFailsAndTheOtherCarriesAll) {
  Mechanism m;
  const PartIndex post = m.ground();
  const PartIndex door = m.body(20.0, {0.4, 0, 0}, Mat3::diagonal({5, 7, 2}));
  for (double z : {-0.5, 0.5}) m.joint(JointKind::revolute, post, door, {{0, 0, z}, {0, 0, z}, {0, 0, z + 0.1}, {0, 0, z + 0.1}});
  Joint::Failure failure;
  failure.time = 0.05;
  m.model.joints[0].failure = failure;
  Simulation run(m.model, 1e-4);
  run.gravity = {0, 0, -9.81};
  run.to(0.2);
  EXPECT_EQ(run.state.joints[0].failed, 1);
  EXPECT_EQ(run.state.joints[0].force.z, 0.0);
  EXPECT_NEAR(run.state.joints[1].force.z, 20 * 9.81, 1e-3);
  EXPECT_LT(norm(run.motion(door).center - Vec3{0.4, 0, 0}), 1e-12);
}

}  // namespace
}  // namespace kardan::test

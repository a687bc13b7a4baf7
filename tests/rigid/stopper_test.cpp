// *CONSTRAINED_RIGID_BODY_STOPPERS: where bodies stop, when they are free, and what energy the stop takes.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

RigidBodyStopper& stopper(Mechanism& m, PartIndex part, int direction) {
  RigidBodyStopper s;
  s.part = part;
  s.direction = direction;
  m.model.stoppers.push_back(s);
  return m.model.stoppers.back();
}

CurveIndex constant(Mechanism& m, double value) { return m.curve({0, 100}, {value, value}); }

double total(const Simulation& run) { return run.state.energy.kinetic + run.state.energy.stopper; }

TEST(Stopper, LimitsOfCoordinateAndDisplacementBothWays) {
  for (const bool displacement : {false, true})
    for (const double sign : {1.0, -1.0}) {
      Mechanism m;
      const PartIndex b = m.body(2.0, {5, 0, 0}, Mat3::identity(), {3 * sign, 1, 0}, {0, 0, 2});
      RigidBodyStopper& s = stopper(m, b, 1);
      const double way = 0.7 * sign;
      (sign > 0 ? s.maximum : s.minimum) = {constant(m, displacement ? way : 5 + way), displacement};
      Simulation run(m.model, 1e-3);
      run.to(0.1);
      EXPECT_NEAR(run.motion(b).center.x, 5 + 0.3 * sign, 1e-12);  // free until then
      run.to(1.0);
      EXPECT_NEAR(run.motion(b).center.x, 5 + way, 1e-12);
      EXPECT_NEAR(run.motion(b).center.y, 1.0, 1e-12);  // the other directions stay free
      EXPECT_NEAR(run.report(b).angular_velocity.z, 2.0, 1e-12);
      EXPECT_NEAR(run.state.energy.stopper, 0.5 * 2.0 * 9.0, 1e-9);
    }
}

TEST(Stopper, EnergyIsKeptThroughTheStop) {
  // At every t_n, the step of the stop included.
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), {3, 1, 0});
  stopper(m, b, 1).maximum = {constant(m, 0.0155), false};
  Simulation run(m.model, 1e-3);
  for (int n = 0; n < 12; ++n) {
    run.to(1e-3 * n);
    EXPECT_NEAR(total(run), 0.5 * 2.0 * 10.0, 1e-12) << n;
  }
}

TEST(Stopper, RestingOnAStopTakesNoEnergy) {
  // Thrown down on a floor: the stop takes the energy of the fall and nothing while the weight rests on it.
  Mechanism m;
  const PartIndex b = m.body(2.0, {0, 0, 1}, Mat3::identity());
  stopper(m, b, 3).minimum = {constant(m, 0.0), false};
  Simulation run(m.model, 1e-3);
  run.gravity = {0, 0, -9.81};
  run.to(0.5);
  EXPECT_NEAR(run.motion(b).center.z, 0.0, 1e-12);
  const double taken = run.state.energy.stopper;
  EXPECT_NEAR(taken, 2.0 * 9.81 * 1.0, 2.0 * 9.81 * 4.5e-3 / 2);  // the last step may take a part of itself
  run.to(3.0);
  EXPECT_NEAR(run.motion(b).center.z, 0.0, 1e-12);
  EXPECT_NEAR(run.state.energy.stopper, taken, 1e-12);
}

TEST(Stopper, LetsGoAsSoonAsTheForcesPullBack) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), {3, 0, 0});
  stopper(m, b, 1).maximum = {constant(m, 0.3), false};
  Simulation run(m.model, 1e-3);
  run.load = [&](State& s) { s.bodies.force[0].x = s.clock.time < 0.4995 ? 4.0 : -4.0; };
  run.to(0.5);
  EXPECT_NEAR(run.motion(b).center.x, 0.3, 1e-12);
  run.to(1.5);
  EXPECT_NEAR(run.motion(b).center.x, 0.3 - 0.5 * 2 * 1.0, 1e-2);
  EXPECT_NEAR(run.report(b).velocity.x, -2.0, 1e-2);
}

TEST(Stopper, LimitThatMovesPushesTheBody) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {1, 0, 0}, Mat3::identity());
  stopper(m, b, 1).minimum = {m.curve({0, 1}, {0.5, 1.5}), false};  // v = 1, meets the body at t = 0.5
  Simulation run(m.model, 1e-3);
  run.to(0.4);
  EXPECT_EQ(run.motion(b).center.x, 1.0);
  run.to(0.9);
  EXPECT_NEAR(run.motion(b).center.x, 1.4, 1e-12);
  EXPECT_NEAR(run.state.energy.kinetic + run.state.energy.stopper, 0.0, 1e-12);  // what it gives is taken with minus
}

TEST(Stopper, VelocityLimit) {
  for (const double sign : {1.0, -1.0}) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {}, Mat3::identity(), {0, 0, 0.5});
    stopper(m, b, 2).velocity = constant(m, 1.5);
    Simulation run(m.model, 1e-3);
    run.load = [&](State& s) { s.bodies.force[0].y = 4.0 * sign; };  // a = 2: reaches the limit at 0.75
    run.to(0.5);
    EXPECT_NEAR(run.report(b).velocity.y, 1.0 * sign, 1e-12);
    run.to(2.0);
    EXPECT_NEAR(run.report(b).velocity.y, 1.5 * sign, 1e-12);
    // Forces' work 4 N x way, less the kinetic energy: the stopper has the rest.
    const double way = run.motion(b).center.y * sign;
    EXPECT_NEAR(run.state.energy.stopper, 4.0 * way - 0.5 * 2 * 1.5 * 1.5, 2e-2);
    EXPECT_NEAR(run.motion(b).center.z, 1.0, 1e-12);
  }
}

TEST(Stopper, ActsBetweenBirthAndDeathOnly) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), {1, 0, 0});
  RigidBodyStopper& s = stopper(m, b, 1);
  s.maximum = {constant(m, 0.3), false};
  s.birth = 0.6;
  Simulation late(m.model, 1e-3);
  late.to(0.5);
  EXPECT_NEAR(late.motion(b).center.x, 0.5, 1e-12);  // past the limit before the stopper lives
  late.to(1.0);
  EXPECT_NEAR(late.motion(b).center.x, 0.6, 1e-12);  // held where it was then, not thrown back
  EXPECT_NEAR(late.state.energy.stopper, 0.5 * 2.0, 1e-12);
  m.model.stoppers[0].birth = 0;
  m.model.stoppers[0].death = 0.7;
  Simulation dies(m.model, 1e-3);
  dies.load = [](State& state) { state.bodies.force[0].x = 2.0; };
  dies.to(0.6);
  EXPECT_NEAR(dies.motion(b).center.x, 0.3, 1e-12);
  dies.to(1.7);
  EXPECT_NEAR(dies.motion(b).center.x, 0.3 + 0.5, 2e-3);
}

TEST(Stopper, AlongAVector) {
  Mechanism m;
  const Vec3 along = Vec3{1, 2, 2} / 3.0;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), along * 2.0 + Vec3{0, 1, -1});
  DirectionVector v;
  v.head = along * 5.0;
  m.model.vectors.push_back(v);
  RigidBodyStopper& s = stopper(m, b, 4);
  s.vector = 0;
  s.maximum = {constant(m, 0.5), true};
  Simulation run(m.model, 1e-3);
  run.to(1.0);
  EXPECT_LT(norm(run.motion(b).center - (along * 0.5 + Vec3{0, 1, -1})), 1e-12);
}

TEST(Stopper, Rotation) {
  for (const double sign : {1.0, -1.0}) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {}, Mat3::diagonal({1, 1, 0.5}), {1, 0, 0}, {0, 0, 4 * sign});
    RigidBodyStopper& s = stopper(m, b, 7);
    (sign > 0 ? s.maximum : s.minimum) = {constant(m, 1.2 * sign), true};
    Simulation run(m.model, 1e-3);
    run.load = [&](State& state) { state.bodies.moment[0].z = 0.1 * sign; };
    run.to(1.0);
    const Quat q = run.motion(b).orientation * conjugate(run.state.bodies.info[0].initial_orientation);
    EXPECT_NEAR(to_rotation_vector(q).z, 1.2 * sign, 1e-5);
    EXPECT_NEAR(run.report(b).angular_velocity.z, 0.0, 1e-6);
    EXPECT_NEAR(run.motion(b).center.x, 1.0, 1e-12);
    EXPECT_NEAR(run.state.energy.stopper, 0.5 * 0.5 * 16 + 0.1 * 1.2, 2e-3);
  }
}

TEST(Stopper, FollowersStopWithTheLeadWhenTheyAreNear) {
  Mechanism m;
  const PartIndex lead = m.body(2.0, {0, 0, 0}, Mat3::identity(), {1, 0, 0});
  const PartIndex near = m.body(1.0, {-0.2, 1, 0}, Mat3::identity(), {1, 0, 1});
  const PartIndex far = m.body(1.0, {-5, 2, 0}, Mat3::identity(), {1, 0, 0});
  const PartIndex always = m.body(1.0, {-9, 3, 0}, Mat3::identity(), {1, 0, 0});
  RigidBodyStopper& s = stopper(m, lead, 1);
  s.maximum = {constant(m, 0.4), false};
  s.followers_maximum = {{near, 0.5}, {far, 0.5}, {always, 0.0}};
  Simulation run(m.model, 1e-3);
  run.to(1.0);
  EXPECT_NEAR(run.motion(lead).center.x, 0.4, 1e-12);
  EXPECT_NEAR(run.motion(near).center.x, 0.2, 2e-3);
  EXPECT_NEAR(run.motion(near).center.z, 1.0, 1e-12);
  EXPECT_NEAR(run.motion(far).center.x, -4.0, 1e-12);
  EXPECT_NEAR(run.motion(always).center.x, -8.6, 2e-3);
  EXPECT_NEAR(run.state.energy.stopper, 0.5 * (2 + 1 + 1), 1e-9);
}

TEST(Stopper, WorkOfAMotionIsNotCountedAsTheStops) {
  // A motion drives y, a stopper ends x: the stop's energy is the stopper's, the motion has done no work in x.
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), {3, 0, 0});
  stopper(m, b, 1).maximum = {constant(m, 0.5), false};
  PrescribedMotion motion;
  motion.body_part = b;
  motion.dof = 2;
  motion.kind = MotionKind::acceleration;
  motion.curve = constant(m, 2.0);
  m.model.prescribed_motions.push_back(motion);
  Simulation run(m.model, 1e-3);
  run.to(1.0);
  EXPECT_NEAR(run.state.energy.stopper, 0.5 * 2 * 9.0, 1e-9);
  EXPECT_NEAR(run.state.energy.external_work, 0.5 * 2 * 4.0, 2e-6);  // (a h)^2 m / 8: half a kick
}

}  // namespace
}  // namespace kardan::test

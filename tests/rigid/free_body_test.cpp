// Free bodies: Euler's equations and the conservation laws.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

TEST(FreeBody, TumblingTopKeepsMomentumAndEnergy) {
  Mechanism m;
  const PartIndex top = m.body(2.0, {1, 2, 3}, skew_inertia({1e-3, 2e-3, 3e-3}), {0.1, -0.2, 0.3}, {4, 3, 2});
  Simulation run(m.model, 1e-3);
  const Vec3 l0 = run.motion(top).angular_momentum;
  run.to(0.0);
  const double e0 = run.kinetic_energy();
  run.to(20.0);
  const Vec3 l1 = run.motion(top).angular_momentum;
  EXPECT_EQ(l0, l1);  // no force: not a bit of it changes
  EXPECT_NEAR(run.kinetic_energy() / e0, 1.0, 1e-12);
  EXPECT_NEAR(run.motion(top).center.x, 1 + 0.1 * 20, 1e-11);
}

TEST(FreeBody, EnergyIsExactAtAnyStep) {
  // P J^-1 P / 2 is an invariant of the implicit midpoint rule however coarse the step (here h|w| = 0.2).
  Mechanism m;
  m.body(1.0, {}, Mat3::diagonal({1, 2, 3}), {}, {0.3, 1.0, 0.2});
  Simulation run(m.model, 0.2);
  run.to(0.2);
  const double e0 = run.kinetic_energy();
  run.to(200.0);
  EXPECT_NEAR(run.kinetic_energy() / e0, 1.0, 1e-12);
}

TEST(FreeBody, PrecessionOfTheSymmetricTop) {
  // diag(a, a, c): w turns about the symmetry axis at (c - a) w3 / a in the body.
  const double a = 2.0, c = 3.0, w1 = 0.7, w3 = 5.0, t = 2.0;
  Mechanism m;
  const PartIndex top = m.body(1.0, {}, Mat3::diagonal({a, a, c}), {}, {w1, 0, w3});
  Simulation run(m.model, 1e-4);
  run.to(t);
  const Mat3 turned = to_matrix(run.motion(top).orientation) * transpose(to_matrix(run.state.bodies.info[0].initial_orientation));
  const Vec3 body_w = transpose(turned) * run.report(top).angular_velocity;
  const double rate = (c - a) / a * w3;
  EXPECT_NEAR(body_w.x, w1 * std::cos(rate * t), 2e-6);
  EXPECT_NEAR(body_w.y, w1 * std::sin(rate * t), 2e-6);
  EXPECT_NEAR(body_w.z, w3, 1e-8);
}

TEST(FreeBody, FreeFallIsExactWithTheHalfKickAtTheStart) {
  Mechanism m;
  const PartIndex b = m.body(3.0, {0, 0, 10}, Mat3::identity(), {1, 0, 2});
  Simulation run(m.model, 0.01);
  run.gravity = {0, 0, -9.81};
  run.to(1.0);
  EXPECT_NEAR(run.motion(b).center.z, 10 + 2 - 0.5 * 9.81, 1e-12);
  EXPECT_NEAR(run.report(b).velocity.z, 2 - 9.81, 1e-12);
  EXPECT_NEAR(run.report(b).acceleration.z, -9.81, 1e-10);
}

TEST(FreeBody, FixedAxisRotationWithSkewInertia) {
  // Only rotation about z is free: I_zz counts, whatever the products of inertia.
  Mechanism m;
  const PartIndex b = m.body(1.0, {0.5, 0, 0}, skew_inertia({1, 2, 3}));
  RigidMaterial hinge;
  hinge.cmo = 1;
  hinge.con1 = 7;
  hinge.con2 = 4;  // x and y rotation
  m.model.materials.push_back({3, "hinge", hinge});
  m.model.parts[0].material = 2;
  Simulation run(m.model, 1e-3);
  run.load = [&](State& s) { s.bodies.moment[0] = {5, -3, 2}; };
  run.to(1.0);
  const double izz = m.model.parts[0].inertia->inertia[2][2];
  EXPECT_NEAR(run.report(b).angular_velocity.z, 2.0 / izz, 1e-6);
  EXPECT_EQ(run.report(b).angular_velocity.x, 0.0);
  EXPECT_EQ(run.motion(b).center, (Vec3{0.5, 0, 0}));
}

TEST(FreeBody, AbsurdRotationIsNamed) {
  Mechanism m;
  m.body(1.0, {}, Mat3::identity(), {}, {0, 0, 200});
  Simulation run(m.model, 0.01);
  try {
    run.to(1.0);
    FAIL() << "2 rad a step went unnoticed";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("body 1"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace kardan::test

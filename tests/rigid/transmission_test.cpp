// Joints that transmit: gears between axes at any angle, rack, screw, constant-velocity and universal joint.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

/// A shaft through `at` on a revolute about `axis`.
PartIndex shaft(Mechanism& m, PartIndex ground, const Vec3& at, const Vec3& axis, double inertia, double omega = 0) {
  const PartIndex p = m.body(1.0, at, Mat3::identity() * inertia, {}, axis * omega);
  m.joint(JointKind::revolute, ground, p, {at, at, at + axis, at + axis});
  return p;
}

double rate(const Simulation& run, PartIndex p, const Vec3& axis) { return dot(run.report(p).angular_velocity, axis); }

TEST(Transmission, GearsOnAxesAtAnAngle) {
  // Bevel gears: axes at 90 and at 130 degrees; the axes' senses differ past 120 degrees (dot < -1/2).
  for (const double angle : {0.5 * M_PI, 130.0 / 180 * M_PI}) {
    const Vec3 a{0, 0, 1}, b{std::sin(angle), 0, std::cos(angle)}, at{3, 0, 0};
    const double ratio = 2.5, ia = 2.0, ib = 5.0, moment = 4.0;
    Mechanism m;
    const PartIndex ground = m.ground(), first = shaft(m, ground, {}, a, ia), second = shaft(m, ground, at, b, ib);
    m.joint(JointKind::gears, first, second, {{}, at, a, at + b}).parameter = ratio;
    Simulation run(m.model, 1e-3);
    run.load = [&](State& s) { s.bodies.moment[static_cast<std::size_t>(run.body(first))] = a * moment; };
    run.to(1.0);
    const double wa = rate(run, first, a), wb = rate(run, second, b);
    EXPECT_NEAR(wa, moment / (ia + ib / (ratio * ratio)), 1e-6);
    EXPECT_NEAR(wb, (angle < 2 ? -1 : 1) * wa / ratio, 1e-6);
    EXPECT_NEAR(run.kinetic_energy(), 0.5 * moment * wa, 1e-5);  // angle = w t / 2
  }
}

TEST(Transmission, RackMovesByTheAngleTimesItsRadius) {
  const double h = 0.3, inertia = 0.5, mass = 2.0, moment = 1.5;
  Mechanism m;
  const Vec3 z{0, 0, 1}, x{1, 0, 0}, y{0, 1, 0}, touch{0, -0.3, 0};
  const PartIndex ground = m.ground(), pinion = shaft(m, ground, {}, z, inertia);
  const PartIndex rack = m.body(mass, touch, Mat3::identity());
  m.joint(JointKind::translational, ground, rack, {touch, touch, touch + x, touch + x, touch + y, touch + y});
  m.joint(JointKind::rack_and_pinion, pinion, rack, {{}, touch, z, touch + x}).parameter = h;
  Simulation run(m.model, 1e-3);
  run.load = [&](State& s) { s.bodies.moment[static_cast<std::size_t>(run.body(pinion))].z = moment; };
  run.to(1.0);
  const double acceleration = moment / (inertia + mass * h * h);
  const BodyInfo& info = run.state.bodies.info[static_cast<std::size_t>(run.body(pinion))];
  const double angle = to_rotation_vector(run.motion(pinion).orientation * conjugate(info.initial_orientation)).z;
  EXPECT_NEAR(run.motion(rack).center.x, h * angle, 1e-12);
  EXPECT_NEAR(angle, 0.5 * acceleration, 1e-6);
}

TEST(Transmission, ScrewAdvancesByItsPitch) {
  // The nut is kept from turning; the spindle turns: way = parameter x angle of the spindle.
  const double pitch = 0.02, inertia = 0.01, mass = 3.0, moment = 0.4;
  const Vec3 axis = normalized(Vec3{1, 2, 2}), o{0.1, 0.2, 0.3}, side = o + normalized(cross(axis, {1, 0, 0}));
  Mechanism m;
  const PartIndex ground = m.ground(), spindle = shaft(m, ground, o, axis, inertia);
  const PartIndex nut = m.body(mass, o, Mat3::identity());
  m.joint(JointKind::translational, ground, nut, {o, o, o + axis, o + axis, side, side});
  m.joint(JointKind::screw, spindle, nut, {o, o, o + axis, o + axis}).parameter = pitch;
  Simulation run(m.model, 1e-3);
  run.load = [&](State& s) { s.bodies.moment[static_cast<std::size_t>(run.body(spindle))] = axis * moment; };
  run.to(0.5);
  const double angular = moment / (inertia + mass * pitch * pitch);
  const double turned = 0.5 * angular * 0.25;
  EXPECT_NEAR(dot(run.motion(nut).center - o, axis), pitch * turned, 1e-4 * pitch * turned);
  EXPECT_NEAR(dot(run.report(nut).velocity, axis), pitch * rate(run, spindle, axis), 2e-5);  // (h w)^2 / 12
  EXPECT_LT(norm(cross(run.motion(nut).center - o, axis)), 1e-12);
}

/// Two shafts at 20 degrees, each on its revolute, joined where their axes meet. @return the largest |w_out / w_in - 1|.
double rate_error(JointKind kind, double& angle_error) {
  const double bend = 20.0 / 180 * M_PI;
  const Vec3 a{1, 0, 0}, b{std::cos(bend), std::sin(bend), 0}, z{0, 0, 1}, out = cross(z, b);
  Mechanism m;
  const PartIndex ground = m.ground();
  const PartIndex input = shaft(m, ground, -1.0 * a, a, 0.4, 10.0), output = shaft(m, ground, b, b, 0.3, 10.0);
  if (kind == JointKind::universal) {
    m.joint(kind, input, output, {{}, {}, z, out});
  } else {
    m.joint(kind, input, output, {{}, {}, a, b, z, z});
  }
  Simulation run(m.model, 1e-4);
  double worst = 0, angle_a = 0, angle_b = 0;
  angle_error = 0;
  for (int n = 1; n <= 40; ++n) {
    run.to(0.02 * n);
    worst = std::max(worst, std::abs(rate(run, output, b) / rate(run, input, a) - 1.0));
    const auto turned = [&](PartIndex p, const Vec3& axis) {
      const BodyInfo& info = run.state.bodies.info[static_cast<std::size_t>(run.body(p))];
      return dot(axis, to_rotation_vector(run.motion(p).orientation * conjugate(info.initial_orientation)));
    };
    angle_a = turned(input, a);
    angle_b = turned(output, b);
    angle_error = std::max(angle_error, std::abs(std::remainder(angle_a - angle_b, 2 * M_PI)));
  }
  return worst;
}

TEST(Transmission, ConstantVelocityJointIsHomokineticTheUniversalJointIsNot) {
  double angle_error = 0;
  EXPECT_LT(rate_error(JointKind::constant_velocity, angle_error), 1e-6);
  EXPECT_LT(angle_error, 1e-11);
  // Hooke's joint: w_out / w_in runs between cos(bend) and 1 / cos(bend).
  EXPECT_NEAR(rate_error(JointKind::universal, angle_error), 1 / std::cos(20.0 / 180 * M_PI) - 1, 2e-3);
  EXPECT_GT(angle_error, 0.02);
}

}  // namespace
}  // namespace kardan::test

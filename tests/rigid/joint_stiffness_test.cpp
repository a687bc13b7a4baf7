// *CONSTRAINED_JOINT_STIFFNESS: moments and forces against closed forms, their energy, and the momenta of free pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

constexpr double pi = 3.14159265358979323846;

Index frame(Mechanism& m, const Mat3& axes, const Vec3& origin = {}) {
  Frame f;
  f.axes = axes;
  f.origin = origin;
  m.model.frames.push_back(f);
  return static_cast<Index>(m.model.frames.size()) - 1;
}

JointStiffness& stiffness(Mechanism& m, JointStiffnessKind kind, PartIndex a, PartIndex b, Index frame_a, Index frame_b = none) {
  JointStiffness s;
  s.id = static_cast<UserId>(m.model.joint_stiffnesses.size()) + 1;
  s.kind = kind;
  s.part_a = a;
  s.part_b = b;
  s.frame_a = frame_a;
  s.frame_b = frame_b;
  m.model.joint_stiffnesses.push_back(s);
  return m.model.joint_stiffnesses.back();
}

CurveIndex linear(Mechanism& m, double slope) { return m.curve({-1e3, 1e3}, {-1e3 * slope, 1e3 * slope}); }

/// A frame turned arbitrarily in space.
Mat3 skew_axes() { return to_matrix(normalized(Quat{0.7, -0.2, 0.5, 0.3})); }

/// Ground and a wheel of inertia `inertia` on a revolute along `axes`' column `axis`, turning at `omega`.
struct Wheel {
  Mechanism m;
  PartIndex frame_part, wheel;
  Vec3 axis;
  Index frame_index;
  Wheel(double inertia, double omega, const Mat3& axes = skew_axes(), std::size_t column = 2) {
    axis = axes.column(column);
    const Vec3 center{0.3, -0.2, 0.1};
    frame_part = m.ground();
    wheel = m.body(1.0, center, Mat3::identity() * inertia, {}, axis * omega);
    m.joint(JointKind::revolute, frame_part, wheel, {center, center, center + axis, center + axis});
    frame_index = frame(m, axes);
  }
  double angle(const Simulation& run) const {
    const BodyInfo& info = run.state.bodies.info[static_cast<std::size_t>(run.body(wheel))];
    return dot(axis, to_rotation_vector(run.motion(wheel).orientation * conjugate(info.initial_orientation)));
  }
  double rate(const Simulation& run) const { return dot(axis, run.report(wheel).angular_velocity); }
};

TEST(GeneralizedStiffness, TorsionalOscillator) {
  // J phi'' = -k phi: phi = (w0 / w) sin w t, w = sqrt(k / J). Second order in h.
  const double inertia = 0.5, k = 50.0, w0 = 4.0, w = std::sqrt(k / inertia);
  double error[2], drift[2];
  for (int n = 0; n < 2; ++n) {
    Wheel c(inertia, w0);
    stiffness(c.m, JointStiffnessKind::generalized, c.frame_part, c.wheel, c.frame_index).coordinate[2].moment = linear(c.m, k);
    Simulation run(c.m.model, n ? 1e-3 : 2e-3);
    run.to(1.3);
    error[n] = std::abs(c.angle(run) - w0 / w * std::sin(w * 1.3));
    drift[n] = std::abs((run.kinetic_energy() + run.state.energy.joint) / (0.5 * inertia * w0 * w0) - 1.0);
    EXPECT_NEAR(run.state.joint_stiffnesses[0].coordinate[2], c.angle(run), 1e-12);
    EXPECT_NEAR(run.state.joint_stiffnesses[0].total[2], k * c.angle(run), 1e-9);
  }
  EXPECT_LT(error[1], 2e-5);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
  EXPECT_LT(drift[1], 3e-5);
}

TEST(GeneralizedStiffness, DampingCurveGivesTheLogarithmicDecrement) {
  // J phi'' + c phi' + k phi = 0, zeta = 0.05.
  const double inertia = 0.5, k = 50.0, w0 = 4.0, w = std::sqrt(k / inertia), zeta = 0.05, c = 2 * zeta * w * inertia;
  Wheel wheel(inertia, w0);
  JointStiffness& s = stiffness(wheel.m, JointStiffnessKind::generalized, wheel.frame_part, wheel.wheel, wheel.frame_index);
  s.coordinate[2].moment = linear(wheel.m, k);
  s.coordinate[2].damping = linear(wheel.m, c);
  Simulation run(wheel.m.model, 5e-4);
  const double damped = w * std::sqrt(1 - zeta * zeta), period = 2 * pi / damped;
  run.to(0.25 * period);
  const double first = wheel.angle(run), t1 = run.state.clock.time;
  run.to(3.25 * period);
  const double last = wheel.angle(run), t2 = run.state.clock.time;
  const auto exact = [&](double t) { return w0 / damped * std::exp(-zeta * w * t) * std::sin(damped * t); };
  EXPECT_NEAR(std::log(first / last), std::log(exact(t1) / exact(t2)), 1e-4);
  EXPECT_NEAR(run.kinetic_energy() + run.state.energy.joint, 0.5 * inertia * w0 * w0, 1e-4 * 0.5 * inertia * w0 * w0);
}

TEST(GeneralizedStiffness, FrictionSticksBelowItsLimitAndSlipsAbove) {
  const double inertia = 0.5, limit = 2.0, elastic = 2000;
  for (const double moment : {1.5, 3.0}) {
    Wheel c(inertia, 0.0);
    JointStiffness::Coordinate& q =
        stiffness(c.m, JointStiffnessKind::generalized, c.frame_part, c.wheel, c.frame_index).coordinate[2];
    q.elastic = elastic;
    q.friction = limit;
    Simulation run(c.m.model, 1e-4);
    // Laid on slowly, so that the spring of the friction does not overshoot.
    run.load = [&](State& s) { s.bodies.moment[1] = c.axis * (moment * std::min(1.0, s.clock.time / 0.5)); };
    run.to(1.0);
    if (moment < limit) {
      EXPECT_LT(std::abs(c.angle(run)), 1.1 * moment / elastic);
      EXPECT_NEAR(run.state.joint_stiffnesses[0].elastic[2], moment, 0.02 * moment);
    } else {
      // Slips from t1, where M t / 0.5 = limit: w = integral of (M(t) - limit) / J.
      const double t1 = 0.5 * limit / moment;
      const double impulse = 0.5 * (moment - limit) * (0.5 - t1) + (moment - limit) * 0.5;
      EXPECT_NEAR(c.rate(run), impulse / inertia, 5e-3 * impulse / inertia);
      EXPECT_NEAR(run.state.joint_stiffnesses[0].elastic[2], limit, 1e-12);
    }
  }
}

TEST(GeneralizedStiffness, FrictionBrakesAWheelToRest) {
  // w0 J / limit until it stands; the energy is all friction's.
  Wheel c(0.5, 4.0);
  JointStiffness::Coordinate& q =
      stiffness(c.m, JointStiffnessKind::generalized, c.frame_part, c.wheel, c.frame_index).coordinate[2];
  q.elastic = 2000;
  q.friction = 2.0;
  Simulation run(c.m.model, 1e-4);
  run.to(0.5);
  EXPECT_NEAR(c.rate(run), 4.0 - 2.0 / 0.5 * 0.5, 4e-3);
  run.to(1.5);
  EXPECT_NEAR(c.angle(run), 4.0 * 4.0 * 0.5 / (2 * 2.0), 4e-3);
  EXPECT_NEAR(run.state.energy.joint + run.kinetic_energy(), 0.5 * 0.5 * 16, 1e-3);
}

TEST(GeneralizedStiffness, StopsBothWaysInAnyFrame) {
  // Free flight to the stop, half a period of the stop's spring, and back at the same rate.
  for (const double sign : {1.0, -1.0})
    for (std::size_t column = 0; column < 3; ++column) {
      const double inertia = 0.5, w0 = 4.0, elastic = 5e3, gap = sign > 0 ? 0.8 : 0.5;
      Wheel c(inertia, w0 * sign, skew_axes(), column);
      JointStiffness::Coordinate& q =
          stiffness(c.m, JointStiffnessKind::generalized, c.frame_part, c.wheel, c.frame_index).coordinate[column];
      q.elastic = elastic;
      q.stop_positive = 0.8;
      q.stop_negative = -0.5;
      Simulation run(c.m.model, 1e-4);
      const double contact = pi * std::sqrt(inertia / elastic);
      run.to(gap / w0 + contact + 0.05);
      EXPECT_NEAR(c.rate(run), -w0 * sign, 1e-3 * w0);
      EXPECT_NEAR(c.angle(run), sign * (gap - 0.05 * w0), 2e-3);
      EXPECT_NEAR(run.state.energy.joint, 0.0, 2e-3 * 0.5 * inertia * w0 * w0);
    }
}

TEST(GeneralizedStiffness, CountsSeveralTurns) {
  for (const int jntf : {0, 1}) {
    Wheel c(0.5, 12.0);
    c.m.model.control.rigid.jntf = jntf;
    stiffness(c.m, JointStiffnessKind::generalized, c.frame_part, c.wheel, c.frame_index).coordinate[2].moment = linear(c.m, 0.05);
    Simulation run(c.m.model, 1e-3);
    for (const double t : {1.0, 2.0, 3.0, 4.9}) {
      run.to(t);
      const double w = std::sqrt(0.05 / 0.5), exact = 12.0 / w * std::sin(w * t);  // up to six turns
      EXPECT_NEAR(run.state.joint_stiffnesses[0].coordinate[2], exact, 1e-3) << jntf << " at " << t;
    }
  }
}

TEST(GeneralizedStiffness, FreePairKeepsItsMomentaAndEnergy) {
  for (const int jntf : {0, 1}) {
    Mechanism m;
    m.model.control.rigid.jntf = jntf;
    const PartIndex a = m.body(2.0, {-0.6, 0.3, 0.2}, skew_inertia({0.1, 0.2, 0.25}), {0.4, -0.3, 0.2}, {1.0, -2.0, 1.5});
    const PartIndex b = m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {0.5, -1.0, 2.0});
    JointStiffness& s = stiffness(m, JointStiffnessKind::generalized, a, b, frame(m, skew_axes()), none);
    for (int i = 0; i < 3; ++i) s.coordinate[static_cast<std::size_t>(i)].moment = linear(m, 2.0 + i);
    Simulation run(m.model, 1e-4);
    run.to(0.0);
    const Vec3 p = run.linear_momentum(), l = run.angular_momentum();
    run.to(1.0);
    EXPECT_LT(norm(run.linear_momentum() - p), 1e-12 * norm(p));
    EXPECT_LT(norm(run.angular_momentum() - l), 1e-12 * norm(l));
  }
}

/// A wheel on ground's spherical joint bent and twisted by hand: B's frame is A's turned by `q` (components of A's frame).
struct Bent {
  Mechanism m;
  PartIndex ground, body;
  Bent(const Vec3& rotation) {
    ground = m.ground();
    body = m.body(1.0, {}, Mat3::identity());
    const Index a = frame(m, skew_axes()), b = frame(m, skew_axes() * to_matrix(from_rotation_vector(rotation)));
    stiffness(m, JointStiffnessKind::flexion_torsion, ground, body, a, b);
  }
  JointStiffness& deck() { return m.model.joint_stiffnesses[0]; }
  /// Moment on the body at t = 0, in the axes of A.
  Vec3 moment(JointStiffnessReport* report = nullptr) {
    Simulation run(m.model, 1e-4);
    run.to(0.0);
    if (report) *report = run.state.joint_stiffnesses[0];
    return transpose(skew_axes()) * run.state.bodies.moment[1];
  }
};

TEST(FlexionTorsion, PureBendIsResistedAboutTheCommonNormal) {
  for (const double gamma : {0.0, 0.9, -2.5}) {
    const double alpha = 0.6;
    // z tilts towards gamma: a rotation about (-sin gamma, cos gamma, 0).
    const Vec3 normal{-std::sin(gamma), std::cos(gamma), 0};
    Bent c(normal * alpha);
    c.deck().coordinate[0].moment = linear(c.m, 10.0);
    c.deck().coordinate[2].moment = linear(c.m, 3.0);
    JointStiffnessReport report;
    EXPECT_LT(norm(c.moment(&report) + normal * (10.0 * alpha)), 1e-12);
    EXPECT_NEAR(report.coordinate[0], alpha, 1e-12);
    EXPECT_NEAR(report.coordinate[1], gamma, 1e-12);
    EXPECT_NEAR(report.coordinate[2], 0.0, 1e-12);
  }
}

TEST(FlexionTorsion, PureTwistIsResistedAboutTheAxis) {
  Bent c({0, 0, -1.1});
  c.deck().coordinate[0].moment = linear(c.m, 10.0);
  c.deck().coordinate[2].moment = linear(c.m, 3.0);
  JointStiffnessReport report;
  EXPECT_LT(norm(c.moment(&report) - Vec3{0, 0, 3.3}), 1e-12);
  EXPECT_NEAR(report.coordinate[2], -1.1, 1e-12);
}

TEST(FlexionTorsion, TwistAfterABendIsTheTwistAlone) {
  const Quat bend = from_rotation_vector({-0.3, 0.4, 0}), twist = from_rotation_vector({0, 0, 0.7});
  Bent c(to_rotation_vector(bend * twist));
  c.deck().coordinate[2].moment = linear(c.m, 3.0);
  JointStiffnessReport report;
  const Vec3 moment = c.moment(&report);
  EXPECT_NEAR(report.coordinate[0], 0.5, 1e-12);
  EXPECT_NEAR(report.coordinate[2], 0.7, 1e-12);
  EXPECT_LT(norm(moment + (to_matrix(bend) * Vec3{0, 0, 1}) * 2.1), 1e-12);
}

TEST(FlexionTorsion, DirectionOfTheBendScalesItsMoment) {
  const double alpha = 0.5, gamma = 1.2;
  const Vec3 normal{-std::sin(gamma), std::cos(gamma), 0};
  Bent c(normal * alpha);
  c.deck().coordinate[0].moment = linear(c.m, 10.0);
  c.deck().moment_scale = c.m.curve({-pi, 0, pi}, {1, 2, 4});
  const double factor = 2 + 2 * gamma / pi;
  JointStiffnessReport report;
  EXPECT_LT(norm(c.moment(&report) + normal * (factor * 10.0 * alpha)), 1e-12);
  EXPECT_NEAR(report.elastic[1], factor, 1e-12);
}

TEST(FlexionTorsion, BendOscillatesLikeATorsionalSpring) {
  const double inertia = 0.5, k = 50.0, w0 = 4.0, w = std::sqrt(k / inertia);
  Wheel c(inertia, w0, skew_axes(), 0);  // turns about x of the frame: bends z towards -y
  stiffness(c.m, JointStiffnessKind::flexion_torsion, c.frame_part, c.wheel, c.frame_index).coordinate[0].moment = linear(c.m, k);
  Simulation run(c.m.model, 1e-3);
  run.to(1.0);
  EXPECT_NEAR(c.angle(run), w0 / w * std::sin(w), 1e-4);
  EXPECT_NEAR(run.kinetic_energy() + run.state.energy.joint, 0.5 * inertia * w0 * w0, 1e-3);
}

TEST(TranslationalStiffness, Oscillator) {
  // A slider on a skew rail: frames at rest a way d0 apart along the rail, which draws the spring from the start.
  const double mass = 2.0, k = 300.0, d0 = 0.1, w = std::sqrt(k / mass);
  Mechanism m;
  const Mat3 axes = skew_axes();
  const Vec3 x = axes.column(0), o{0.1, 0.2, 0.3};
  const PartIndex ground = m.ground(), slider = m.body(mass, o, skew_inertia({1, 2, 2.5}));
  m.joint(JointKind::translational, ground, slider, {o, o, o + x, o + x, o + axes.column(1), o + axes.column(1)});
  JointStiffness& s = stiffness(m, JointStiffnessKind::translational, ground, slider, frame(m, axes, o), frame(m, axes, o + x * d0));
  s.coordinate[0].moment = linear(m, k);
  Simulation run(m.model, 5e-4);
  for (const double t : {0.5, 1.7}) {
    run.to(t);
    EXPECT_NEAR(dot(run.motion(slider).center - o, x), d0 * (std::cos(w * t) - 1), 1e-5);
    // The energy counts from t = 0: what the spring gives shows as minus.
    EXPECT_NEAR(run.kinetic_energy() + run.state.energy.joint, 0.0, 1e-4);
    EXPECT_NEAR(run.state.energy.joint, -0.5 * k * d0 * d0 * std::pow(std::sin(w * t), 2.0), 5e-4);
  }
}

TEST(TranslationalStiffness, FrictionOfFramesApartStartsAtRest) {
  Mechanism m;
  const PartIndex ground = m.ground(), slider = m.body(2.0, {}, Mat3::identity());
  const Vec3 x{1, 0, 0}, y{0, 1, 0};
  m.joint(JointKind::translational, ground, slider, {{}, {}, x, x, y, y});
  JointStiffness::Coordinate& q = stiffness(m, JointStiffnessKind::translational, ground, slider, frame(m, Mat3::identity()),
                                            frame(m, Mat3::identity(), x * 0.3)).coordinate[0];
  q.elastic = 1000;
  q.friction = 5.0;
  Simulation run(m.model, 1e-4);
  run.to(0.5);
  EXPECT_NEAR(run.motion(slider).center.x, 0.0, 1e-14);  // nothing pulls: nothing moves
}

TEST(TranslationalStiffness, FreePairKeepsMomentaAndEnergy) {
  double drift[2];
  for (int n = 0; n < 2; ++n) {
    Mechanism m;
    const PartIndex a = m.body(2.0, {-0.6, 0.3, 0.2}, skew_inertia({0.1, 0.2, 0.25}), {0.4, -0.3, 0.2}, {1.0, -2.0, 1.5});
    const PartIndex b = m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {0.5, 1.0, -2.0});
    JointStiffness& s = stiffness(m, JointStiffnessKind::translational, a, b, frame(m, skew_axes(), {0, 0.1, 0.3}),
                                  frame(m, skew_axes(), {0.2, 0.1, 0.3}));
    for (int i = 0; i < 3; ++i) s.coordinate[static_cast<std::size_t>(i)].moment = linear(m, 5.0 + 10 * i);
    Simulation run(m.model, n ? 1e-4 : 2e-4);
    run.to(0.0);
    const Vec3 p = run.linear_momentum(), l = run.angular_momentum();
    const double e = run.kinetic_energy() + run.state.energy.joint;
    run.to(1.0);
    EXPECT_LT(norm(run.linear_momentum() - p), 1e-12 * norm(p));
    EXPECT_LT(norm(run.angular_momentum() - l), 1e-12 * norm(l));
    drift[n] = std::abs((run.kinetic_energy() + run.state.energy.joint) / e - 1.0);
    EXPECT_GT(std::abs(run.kinetic_energy() / e - 1.0), 0.05);  // the springs hold a good part
  }
  EXPECT_LT(drift[1], 1e-6);
}

TEST(CylindricalStiffness, RadialSpring) {
  // Released off the axis at rest it swings through it along the same line.
  const double mass = 2.0, k = 300.0, w = std::sqrt(k / mass);
  Mechanism m;
  const Mat3 axes = skew_axes();
  const Vec3 side = axes.column(0) * 0.03 + axes.column(1) * 0.04;
  const PartIndex ground = m.ground(), body = m.body(mass, side, Mat3::identity(), axes.column(2) * 0.2);
  JointStiffness& s = stiffness(m, JointStiffnessKind::cylindrical, ground, body, frame(m, axes), frame(m, axes, side));
  s.coordinate[0].moment = linear(m, k);
  Simulation run(m.model, 5e-4);
  run.to(0.1);
  EXPECT_LT(norm(run.motion(body).center - side * std::cos(w * 0.1) - axes.column(2) * 0.02), 1e-6);
  EXPECT_NEAR(run.state.joint_stiffnesses[0].coordinate[0], 0.05 * std::abs(std::cos(w * 0.1)), 1e-6);
  EXPECT_NEAR(run.state.joint_stiffnesses[0].coordinate[2], 0.02, 1e-12);
  run.to(1.1);
  EXPECT_LT(norm(run.motion(body).center - side * std::cos(w * 1.1) - axes.column(2) * 0.22), 2e-5);
}

TEST(CylindricalStiffness, CircularOrbitKeepsItsRadius) {
  const double mass = 2.0, k = 300.0, w = std::sqrt(k / mass), radius = 0.05;
  Mechanism m;
  const PartIndex ground = m.ground();
  const PartIndex body = m.body(mass, {radius, 0, 0}, Mat3::identity(), {0, radius * w, 0});
  JointStiffness& s = stiffness(m, JointStiffnessKind::cylindrical, ground, body, frame(m, Mat3::identity()),
                                frame(m, Mat3::identity(), {radius, 0, 0}));
  s.coordinate[0].moment = linear(m, k);
  Simulation run(m.model, 5e-4);
  run.to(2.0);
  EXPECT_NEAR(norm(run.motion(body).center), radius, 1e-5);
}

TEST(JointForceFriction, BlockOnASlideSticksBelowMuAndSlipsAbove) {
  // Weight across the slide, a pull along it: Coulomb's law with the joint's force.
  const double mass = 2.0, g = 9.81, mu_static = 0.4, mu_dynamic = 0.3;
  for (const double pull : {0.35, 0.6}) {
    Mechanism m;
    const Vec3 x{1, 0, 0}, y{0, 1, 0};
    const PartIndex ground = m.ground(), slider = m.body(mass, {}, Mat3::identity());
    const UserId joint = m.joint(JointKind::translational, ground, slider, {{}, {}, x, x, y, y}).id;
    JointStiffness& s = stiffness(m, JointStiffnessKind::translational, ground, slider, frame(m, Mat3::identity()));
    s.joint = joint;
    s.coordinate[0].static_coefficient = mu_static;
    s.coordinate[0].dynamic_coefficient = mu_dynamic;
    Simulation run(m.model, 1e-4);
    run.gravity = {0, 0, -g};
    run.load = [&](State& state) { state.bodies.force[1].x = pull * mass * g; };
    run.to(0.5);
    if (pull < mu_static) {
      EXPECT_NEAR(run.motion(slider).center.x, 0.0, 1e-9);
      EXPECT_NEAR(run.state.joint_stiffnesses[0].total[0], pull * mass * g, 1e-6);
    } else {
      EXPECT_NEAR(run.report(slider).velocity.x, (pull - mu_dynamic) * g * 0.5, 1e-2);
      EXPECT_NEAR(run.state.joint_stiffnesses[0].total[0], mu_dynamic * mass * g, 1e-4);  // rounding of the positions over h^2
    }
  }
}

TEST(JointForceFriction, SpringThatSlipsStaysAtTheLowerLimit) {
  // With ES the friction is a spring: drawn to FS |N| it slips, and goes on slipping at FD |N| without catching again.
  const double mass = 2.0, g = 9.81, mu_static = 0.4, mu_dynamic = 0.2;
  Mechanism m;
  const Vec3 x{1, 0, 0}, y{0, 1, 0};
  const PartIndex ground = m.ground(), slider = m.body(mass, {}, Mat3::identity(), {3, 0, 0});
  const UserId joint = m.joint(JointKind::translational, ground, slider, {{}, {}, x, x, y, y}).id;
  JointStiffness& s = stiffness(m, JointStiffnessKind::translational, ground, slider, frame(m, Mat3::identity()));
  s.joint = joint;
  s.coordinate[0].elastic = 1e6;
  s.coordinate[0].static_coefficient = mu_static;
  s.coordinate[0].dynamic_coefficient = mu_dynamic;
  Simulation run(m.model, 1e-4);
  run.gravity = {0, 0, -g};
  run.to(1.0);
  EXPECT_NEAR(run.report(slider).velocity.x, 3.0 - mu_dynamic * g, 1e-3);
}

TEST(JointStiffness, DeformablePartIsAnError) {
  Mechanism m;
  const PartIndex a = m.body(1.0, {}, Mat3::identity());
  stiffness(m, JointStiffnessKind::generalized, a, none, none);
  EXPECT_THROW(Simulation(m.model, 1e-3), std::runtime_error);
}

}  // namespace
}  // namespace kardan::test

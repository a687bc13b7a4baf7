// Every joint holds what it should and nothing else.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

struct Kind {
  JointKind kind;
  int held;          ///< degrees of freedom it takes away
  std::vector<Vec3> points;
};

/// Points of a joint of each kind in a skew frame.
std::vector<Kind> all_kinds() {
  const Mat3 r = to_matrix(normalized(Quat{0.7, -0.2, 0.5, 0.3}));
  const Vec3 o{0.1, 0.2, -0.1};
  const Vec3 x = o + r.column(0), y = o + r.column(1), z = o + r.column(2);
  return {{JointKind::spherical, 3, {o, o}},
          {JointKind::revolute, 5, {o, o, x, x}},
          {JointKind::cylindrical, 4, {o, o, x, x}},
          {JointKind::planar, 3, {o, o, x, x}},
          {JointKind::universal, 4, {o, o, x, y}},
          {JointKind::translational, 5, {o, o, x, x, y, y}},
          {JointKind::locking, 6, {o, o, x, x, y, y}},
          {JointKind::constant_velocity, 4, {o, o, x, x, y, y}},
          {JointKind::gears, 1, {x, y, x + r.column(2), y + r.column(2), o, o}},
          {JointKind::pulley, 1, {x, y, x + r.column(2), y + r.column(2), o, o}},
          {JointKind::rack_and_pinion, 1, {o, z, x, z + r.column(1)}},
          {JointKind::screw, 1, {o, o, x, x}}};
}

std::string name(const testing::TestParamInfo<std::tuple<int, int>>& info) {
  return std::string(to_string(all_kinds()[static_cast<std::size_t>(std::get<0>(info.param))].kind)) +
         (std::get<1>(info.param) ? "_penalty" : "_exact");
}

class JointLaw : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  Kind kind() const { return all_kinds()[static_cast<std::size_t>(std::get<0>(GetParam()))]; }
  JointHolding holding() const { return std::get<1>(GetParam()) ? JointHolding::penalty : JointHolding::exact; }
};

TEST_P(JointLaw, FreeFlightKeepsMomentaAndHoldsTheJoint) {
  const Kind k = kind();
  Mechanism m;
  m.body(2.0, {-0.6, 0.3, 0.2}, skew_inertia({0.1, 0.2, 0.25}), {0.4, -0.3, 0.2}, {1.0, -2.0, 1.5});
  m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {-0.5, 1.0, 2.0});
  m.joint(k.kind, 0, 1, k.points).parameter = 1.7;
  Simulation run(m.model, 1e-4, holding());
  run.to(0.0);
  const Vec3 p0 = run.linear_momentum(), l0 = run.angular_momentum();
  const double e0 = run.kinetic_energy();
  run.to(1.0);
  EXPECT_LT(norm(run.linear_momentum() - p0), 1e-12 * norm(p0));
  // Gears and pulleys pass moments between axes apart from each other; the forces go through the bearings in a frame,
  // which is not there, so alone they do not keep the angular momentum of the pair.
  const bool through_frame = k.kind == JointKind::gears || k.kind == JointKind::pulley;
  if (!through_frame) {
    EXPECT_LT(norm(run.angular_momentum() - l0), 1e-12 * norm(l0));
    EXPECT_NEAR(run.kinetic_energy() / e0, 1.0, holding() == JointHolding::exact ? 2e-7 : 1e-4);
  }
  const auto separation = run.system->largest_separation();
  EXPECT_LT(separation.distance, holding() == JointHolding::exact ? 1e-12 : 1e-5);
}

TEST_P(JointLaw, TakesAwayExactlyItsDegreesOfFreedom) {
  // The velocities that random impulses leave, projected by the joint, span 12 - held dimensions.
  const Kind k = kind();
  Eigen::MatrixXd reached(12, 12);
  for (int i = 0; i < 12; ++i) {
    Vec3 unit[4] = {};
    unit[i / 3][static_cast<std::size_t>(i % 3)] = 1.0;
    Mechanism m;
    m.body(2.0, {-0.6, 0.3, 0.2}, skew_inertia({0.1, 0.2, 0.25}), unit[0], unit[1]);
    m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), unit[2], unit[3]);
    m.joint(k.kind, 0, 1, k.points).parameter = 1.7;
    const Simulation run(m.model, 1e-4, holding());
    for (int b = 0; b < 2; ++b)
      for (std::size_t c = 0; c < 3; ++c) {
        reached(6 * b + static_cast<int>(c), i) = run.state.bodies.motion[static_cast<std::size_t>(b)].velocity[c];
        reached(6 * b + 3 + static_cast<int>(c), i) = run.state.bodies.motion[static_cast<std::size_t>(b)].angular_velocity[c];
      }
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(reached);
  svd.setThreshold(1e-9);
  EXPECT_EQ(svd.rank(), 12 - k.held);
}

TEST_P(JointLaw, GroundedSideStaysAndPowerlessJointKeepsEnergy) {
  const Kind k = kind();
  Mechanism m;
  m.ground({-0.6, 0.3, 0.2});
  m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {-0.5, 1.0, 2.0});
  m.joint(k.kind, 0, 1, k.points).parameter = 1.7;
  Simulation run(m.model, 1e-4, holding());
  run.to(0.0);
  const double e0 = run.kinetic_energy();
  run.to(1.0);
  EXPECT_EQ(run.motion(0).center, (Vec3{-0.6, 0.3, 0.2}));
  if (k.held < 6) {
    EXPECT_NEAR(run.kinetic_energy() / e0, 1.0, holding() == JointHolding::exact ? 1e-6 : 1e-3);
  }
  EXPECT_LT(run.system->largest_separation().distance, holding() == JointHolding::exact ? 1e-12 : 1e-4);
}

TEST_P(JointLaw, MassRatioOfAMillion) {
  const Kind k = kind();
  Mechanism m;
  m.body(1e6, {-0.6, 0.3, 0.2}, skew_inertia({1e5, 2e5, 2.5e5}), {0.4, -0.3, 0.2}, {0.3, -0.2, 0.1});
  m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {-0.5, 1.0, 2.0});
  m.joint(k.kind, 0, 1, k.points).parameter = 1.7;
  Simulation run(m.model, 1e-4, holding());
  run.to(0.5);
  EXPECT_LT(run.system->largest_separation().distance, holding() == JointHolding::exact ? 1e-12 : 1e-4);
}

TEST_P(JointLaw, TwiceTheSameJointHoldsAsOnce) {
  // The second joint repeats the first in every row: the motion is that of one, and the pair shares the force.
  const Kind k = kind();
  const auto make = [&](int copies) {
    Mechanism m;
    m.body(2.0, {-0.6, 0.3, 0.2}, skew_inertia({0.1, 0.2, 0.25}), {0.4, -0.3, 0.2}, {1.0, -2.0, 1.5});
    m.body(1.0, {0.7, -0.1, 0.4}, skew_inertia({0.05, 0.08, 0.1}), {-0.2, 0.5, 0.1}, {-0.5, 1.0, 2.0});
    for (int i = 0; i < copies; ++i) m.joint(k.kind, 0, 1, k.points).parameter = 1.7;
    return m;
  };
  const Mechanism once = make(1), twice = make(2);
  Simulation one(once.model, 1e-4, holding()), two(twice.model, 1e-4, holding());
  one.to(0.5);
  two.to(0.5);
  const bool exact = holding() == JointHolding::exact;
  EXPECT_LT(norm(one.motion(0).center - two.motion(0).center), exact ? 1e-10 : 1e-5);
  EXPECT_LT(norm(one.motion(1).center - two.motion(1).center), exact ? 1e-10 : 1e-5);
  EXPECT_LT(two.system->largest_separation().distance, exact ? 1e-12 : 1e-5);
  if (exact) {
    EXPECT_LT(norm(two.state.joints[0].force - two.state.joints[1].force), 1e-3 * (1e-3 + norm(one.state.joints[0].force)));
  }
}

INSTANTIATE_TEST_SUITE_P(All, JointLaw, testing::Combine(testing::Range(0, 12), testing::Values(0, 1)), name);

TEST(Joints, RedundantFourBarMovesAsThePlanarOne) {
  // Parallelogram of three moving links with four revolutes: three redundant rows. Its links translate and turn as one
  // pendulum: theta'' = -g/L sin theta ... with uniform rods and a coupler: (2 I + m_c L^2) theta'' = -(m_r + m_c) g L sin theta.
  const double length = 0.5, rod = 1.0, coupler = 2.0, base = 0.8;
  Mechanism m;
  const PartIndex frame = m.ground();
  const double theta0 = 0.5;
  const Vec3 down{length * std::sin(theta0), 0, -length * std::cos(theta0)};
  const Mat3 rod_inertia = Mat3::identity() * (rod * length * length / 12);
  const Vec3 a{0, 0, 0}, b{base, 0, 0}, y{0, 0.1, 0};
  const PartIndex left = m.body(rod, 0.5 * down, rod_inertia), right = m.body(rod, b + 0.5 * down, rod_inertia);
  const PartIndex middle = m.body(coupler, down + Vec3{0.5 * base, 0, 0}, Mat3::identity() * 0.01);
  const auto hinge = [&](PartIndex p, PartIndex q, const Vec3& at) { m.joint(JointKind::revolute, p, q, {at, at, at + y, at + y}); };
  hinge(frame, left, a);
  hinge(frame, right, b);
  hinge(left, middle, down);
  hinge(right, middle, b + down);
  Simulation run(m.model, 1e-4);
  bool named = false;
  for (const Diagnostic& d : run.diagnostics.all()) named |= d.message.find("redundant") != std::string::npos;
  EXPECT_TRUE(named);
  run.gravity = {0, 0, -9.81};
  run.to(1.0);
  // Independent integration of the pendulum's equation by a fine Runge-Kutta scheme.
  const double k = (rod + coupler) * 9.81 * length / (2 * rod * length * length / 3 + coupler * length * length);
  double th = theta0, w = 0;
  const double h = 1e-4;
  for (int i = 0; i < 10000; ++i) {
    const auto f = [&](double q) { return -k * std::sin(q); };
    const double k1 = w, l1 = f(th), k2 = w + h / 2 * l1, l2 = f(th + h / 2 * k1), k3 = w + h / 2 * l2, l3 = f(th + h / 2 * k2);
    const double k4 = w + h * l3, l4 = f(th + h * k3);
    th += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    w += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  EXPECT_NEAR(run.motion(left).center.x, 0.5 * length * std::sin(th), 1e-7);
  EXPECT_LT(run.system->largest_separation().distance, 1e-12);
}

TEST(Joints, DoorOnTwoHingesSharesItsWeight) {
  Mechanism m;
  const PartIndex post = m.ground();
  const PartIndex door = m.body(20.0, {0.4, 0, 0}, Mat3::diagonal({5, 7, 2}));
  for (double z : {-0.5, 0.5}) m.joint(JointKind::revolute, post, door, {{0, 0, z}, {0, 0, z}, {0, 0, z + 0.1}, {0, 0, z + 0.1}});
  Simulation run(m.model, 1e-4);
  run.gravity = {0, 0, -9.81};
  run.to(0.1);
  EXPECT_NEAR(run.state.joints[0].force.z, 0.5 * 20 * 9.81, 1e-4);  // rounding of the positions over h^2
  EXPECT_NEAR(run.state.joints[1].force.z, 0.5 * 20 * 9.81, 1e-4);  // rounding of the positions over h^2
}

TEST(Joints, PenaltyIsStableOnACrowdedBody) {
  // Thirty joints of different kinds between a light hub and heavy spokes, another ring between the spokes, and a step at
  // which only the springs limit: springs that were too stiff for their neighbours would blow up within a few steps.
  Mechanism m;
  const PartIndex hub = m.body(0.01, {0, 0, 0}, Mat3::diagonal({1e-5, 2e-5, 2.5e-5}), {}, {0, 0, 0.5});
  const int spokes = 15;
  std::vector<PartIndex> ring;
  std::vector<Vec3> at;
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2 * M_PI * i / spokes;
    const Vec3 out{std::cos(angle), std::sin(angle), 0.1 * (i % 3)};
    at.push_back(out);
    ring.push_back(m.body(10.0, out, skew_inertia({1, 2, 2.5}), cross({0, 0, 0.5}, out), {0, 0, 0.5}));
    const Vec3 p = 0.1 * out, q = p + Vec3{0, 0, 0.1};
    m.joint(JointKind::spherical, hub, ring.back(), {p, p});
    m.joint(JointKind::revolute, hub, ring.back(), {2.0 * p, 2.0 * p, q, q});
  }
  for (int i = 0; i < spokes; ++i) {
    const Vec3 middle = 0.5 * (at[i] + at[(i + 1) % spokes]);
    m.joint(JointKind::spherical, ring[i], ring[(i + 1) % spokes], {middle, middle});
  }
  Simulation run(m.model, 1e-3, JointHolding::penalty);
  run.to(0.0);
  const double e0 = run.kinetic_energy();
  const Vec3 l0 = run.angular_momentum();
  run.to(2.0);
  EXPECT_NEAR(run.kinetic_energy() / e0, 1.0, 0.05);
  EXPECT_LT(norm(run.angular_momentum() - l0), 1e-10 * norm(l0));
  EXPECT_LT(run.system->largest_separation().distance, 0.1);
}

TEST(Joints, GearsTurnAgainstAndPulleysTurnWith) {
  for (const auto& [kind, sign] : {std::pair{JointKind::gears, -1.0}, {JointKind::pulley, 1.0}}) {
    Mechanism m;
    const PartIndex frame = m.ground();
    const PartIndex a = m.body(1.0, {}, Mat3::diagonal({1, 1, 2}), {}, {0, 0, 3}), b = m.body(1.0, {3, 0, 0}, Mat3::diagonal({1, 1, 5}));
    const Vec3 z{0, 0, 1}, c{3, 0, 0};
    m.joint(JointKind::revolute, frame, a, {{}, {}, z, z});
    m.joint(JointKind::revolute, frame, b, {c, c, c + z, c + z});
    m.joint(kind, a, b, {{}, c, z, c + z}).parameter = 2.0;  // R2 / R1
    Simulation run(m.model, 1e-3);
    run.load = [&](State& s) { s.bodies.moment[static_cast<std::size_t>(run.body(a))].z = 4.0; };
    run.to(1.0);
    const double wa = run.report(a).angular_velocity.z, wb = run.report(b).angular_velocity.z;
    EXPECT_NEAR(wb, sign * wa / 2.0, 2e-6);  // the angles agree to rounding, the half-step rates to (h w)^2 / 12
    // (I_a + I_b / ratio^2) w' = M, after the jump of the initial velocity: w0 = 3 I_a / (I_a + I_b / 4).
    EXPECT_NEAR(wa, (3 * 2.0 + 4.0) / (2.0 + 5.0 / 4.0), 1e-6);
  }
}

TEST(Joints, SliderMotorPushesAlongItsAxis) {
  Mechanism m;
  const PartIndex frame = m.ground();
  const PartIndex slider = m.body(2.0, {0.1, 0.2, 0.3}, skew_inertia({1, 2, 3}));
  const Vec3 o{0.1, 0.2, 0.3}, axis = normalized(Vec3{1, 2, 2}), x = o + axis, side = o + cross(axis, {1, 0, 0});
  m.joint(JointKind::translational, frame, slider, {o, o, x, x, side, side});
  Joint& motor = m.joint(JointKind::translational_motor, frame, slider, {o, o, x, x});
  motor.curve = m.curve({0, 10}, {0, 5});  // way 0.5 t
  motor.motor_type = 2;
  Simulation run(m.model, 1e-3);
  run.gravity = {0, 0, -9.81};
  run.to(1.0);
  EXPECT_LT(norm(run.motion(slider).center - (o + axis * 0.5)), 1e-12);
  EXPECT_NEAR(dot(run.state.joints[1].force, axis), 2.0 * 9.81 * axis.z, 1e-6);  // carries the weight along the slope
}

TEST(Joints, MotorsFollowTheirCurve) {
  Mechanism m;
  const PartIndex frame = m.ground();
  const PartIndex wheel = m.body(1.0, {}, Mat3::diagonal({1, 1, 2}));
  const Vec3 z{0, 0, 1};
  m.joint(JointKind::revolute, frame, wheel, {{}, {}, z, z});
  Joint& motor = m.joint(JointKind::rotational_motor, frame, wheel, {{}, {}, z, z});
  motor.curve = m.curve({0, 1, 2}, {0, 10, 10});
  motor.motor_type = 0;
  Simulation run(m.model, 1e-3);
  run.to(2.0);
  EXPECT_NEAR(run.report(wheel).angular_velocity.z, 10.0, 1e-4);
  const Quat q = run.motion(wheel).orientation * conjugate(run.state.bodies.info[1].initial_orientation);
  const double turned = 2 * std::atan2(q.z, q.w);
  EXPECT_NEAR(std::remainder(turned - 15.0, 2 * M_PI), 0.0, 1e-9);
  // Work of the motor = kinetic energy of the wheel.
  EXPECT_NEAR(run.kinetic_energy(), 0.5 * 2 * 100.0, 5e-3);
  EXPECT_NEAR(run.state.energy.external_work, 0.5 * 2 * 100.0, 5e-3);
}

}  // namespace
}  // namespace kardan::test

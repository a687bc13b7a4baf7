// *BOUNDARY_PRESCRIBED_MOTION on bodies: every kind and direction, windows of time, reactions and their work.
#include <gtest/gtest.h>

#include <cmath>

#include "rigid/mechanism.hpp"

namespace kardan::test {
namespace {

constexpr double pi = 3.14159265358979323846;

PrescribedMotion& prescribe(Mechanism& m, PartIndex body, int dof, MotionKind kind, CurveIndex curve, double scale = 1.0) {
  PrescribedMotion motion;
  motion.id = static_cast<UserId>(m.model.prescribed_motions.size()) + 1;
  motion.body_part = body;
  motion.dof = dof;
  motion.kind = kind;
  motion.curve = curve;
  motion.scale = scale;
  m.model.prescribed_motions.push_back(motion);
  return m.model.prescribed_motions.back();
}

Index vector(Mechanism& m, const Vec3& head) {
  DirectionVector v;
  v.head = head;
  m.model.vectors.push_back(v);
  return static_cast<Index>(m.model.vectors.size()) - 1;
}

/// Samples of f on 0 … end, fine enough that only the motion's own error counts.
CurveIndex sampled(Mechanism& m, double end, double (*f)(double), int points = 2001) {
  std::vector<double> x, y;
  for (int i = 0; i < points; ++i) {
    x.push_back(end * i / (points - 1));
    y.push_back(f(x.back()));
  }
  return m.curve(x, y);
}

/// Rotation of a body since t = 0 as a rotation vector.
Vec3 turned(const Simulation& run, PartIndex p) {
  const BodyInfo& info = run.state.bodies.info[static_cast<std::size_t>(run.body(p))];
  return to_rotation_vector(run.motion(p).orientation * conjugate(info.initial_orientation));
}

TEST(BodyMotion, VelocityKindAlongEachAxis) {
  for (int dof = 1; dof <= 3; ++dof) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {1, 2, 3}, skew_inertia({1, 2, 2.5}), {0.3, 0.4, 0.5});
    prescribe(m, b, dof, MotionKind::velocity, m.curve({0, 1}, {0, 4}), 0.5);  // v = 2 t
    Simulation run(m.model, 1e-3);
    run.to(1.0);
    Vec3 expected = Vec3{1, 2, 3} + Vec3{0.3, 0.4, 0.5};  // the other directions are free
    expected[static_cast<std::size_t>(dof - 1)] = static_cast<double>(dof) + 1.0;
    EXPECT_LT(norm(run.motion(b).center - expected), 1e-12);  // the midpoint rule sums v = 2 t exactly
  }
}

TEST(BodyMotion, AccelerationKindGivesForceMassTimesAcceleration) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {1, 2, 3}, skew_inertia({1, 2, 2.5}), {0, 0.4, 0});
  prescribe(m, b, 2, MotionKind::acceleration, m.curve({0, 1}, {3, 3}));
  Simulation run(m.model, 1e-3);
  run.gravity = {0, -9.81, 0};  // the motion carries the weight
  run.to(0.9);
  EXPECT_NEAR(run.motion(b).center.y, 2 + 0.4 * 0.9 + 1.5 * 0.81, 1e-12);
  EXPECT_NEAR(run.report(b).velocity.y, 0.4 + 2.7, 1e-12);
  EXPECT_NEAR(run.state.reactions.at(0).force.y, 2.0 * (3 + 9.81), 1e-9);
  EXPECT_EQ(run.state.reactions[0].body, run.body(b));
}

TEST(BodyMotion, DisplacementKindIsExactAtEveryStep) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {1, 2, 3}, skew_inertia({1, 2, 2.5}), {}, {0, 0, 0.4});
  const CurveIndex wave = sampled(m, 2.0, [](double t) { return 0.3 * std::sin(5 * t); });
  prescribe(m, b, 1, MotionKind::displacement, wave);
  Simulation run(m.model, 0.01);
  for (int n = 1; n <= 200; n += 7) {
    run.to(0.01 * n);
    EXPECT_NEAR(run.motion(b).center.x, 1 + m.model.curves[static_cast<std::size_t>(wave)].value(0.01 * n), 1e-12);
  }
}

TEST(BodyMotion, VelocityAgainstDisplacement) {
  // v = 2 - x: x = 2 (1 - exp(-t)).
  Mechanism m;
  const PartIndex b = m.body(2.0, {5, 0, 0}, Mat3::identity());
  prescribe(m, b, 1, MotionKind::velocity_versus_displacement, m.curve({0, 2}, {2, 0}));
  Simulation run(m.model, 1e-4);
  run.to(1.0);
  EXPECT_NEAR(run.motion(b).center.x, 5 + 2 * (1 - std::exp(-1.0)), 1e-4);
}

TEST(BodyMotion, AlongAVectorWithTheOtherDirectionsFreeOrHeld) {
  for (const int dof : {4, -4}) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {}, skew_inertia({1, 2, 2.5}));
    const Vec3 head{2, 2, 1}, along = head / 3.0;
    prescribe(m, b, dof, MotionKind::displacement, m.curve({0, 1}, {0, 0.6})).vector = vector(m, head);
    Simulation run(m.model, 1e-3);
    run.gravity = {0, 0, -9.81};
    run.to(1.0);
    EXPECT_NEAR(dot(run.motion(b).center, along), 0.6, 1e-12);
    const Vec3 across = run.motion(b).center - along * 0.6;
    const Vec3 g{0, 0, -9.81}, fall = (g - along * dot(g, along)) * 0.5;
    EXPECT_LT(norm(across - (dof == 4 ? fall : Vec3{})), 1e-11);
  }
}

TEST(BodyMotion, RotationAboutEachAxisIsExactInDisplacementAndRate) {
  for (int dof = 5; dof <= 7; ++dof)
    for (const MotionKind kind : {MotionKind::displacement, MotionKind::velocity, MotionKind::acceleration}) {
      Mechanism m;
      const PartIndex b = m.body(2.0, {1, 2, 3}, skew_inertia({1, 2, 2.5}));
      // The other two rotations are held, so that the axis stays.
      for (int other = 5; other <= 7; ++other)
        if (other != dof) prescribe(m, b, other, MotionKind::velocity, m.curve({0, 1}, {0, 0}));
      const std::vector<double> y = kind == MotionKind::displacement ? std::vector<double>{0, 2.5}
                                    : kind == MotionKind::velocity   ? std::vector<double>{0, 5}
                                                                     : std::vector<double>{5, 5};
      prescribe(m, b, dof, kind, m.curve({0, 1}, y));
      Simulation run(m.model, 1e-3);
      run.to(1.0);
      Vec3 axis;
      axis[static_cast<std::size_t>(dof - 5)] = 1.0;
      // The angle of velocity and acceleration kinds is that of steps 2 atan(h w / 2): (h w)^2 / 12 short.
      const double tolerance = kind == MotionKind::displacement ? 1e-12 : 1e-5;
      EXPECT_LT(norm(turned(run, b) - axis * 2.5), tolerance) << dof;
      EXPECT_LT(norm(run.motion(b).center - Vec3{1, 2, 3}), 1e-13);
    }
}

TEST(BodyMotion, RotationAboutAVectorAndThroughManyTurns) {
  for (const int dof : {8, -8}) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {1, 2, 3}, Mat3::identity() * 0.5);
    const Vec3 head{1, 2, 2};
    prescribe(m, b, dof, MotionKind::displacement, m.curve({0, 1}, {0, 10 * pi + 1})).vector = vector(m, head);
    Simulation run(m.model, 1e-3);
    run.load = [&](State& s) { s.bodies.moment[0] = {0.2, 0, -0.1}; };  // square to the vector
    run.to(1.0);
    if (dof == -8) {
      EXPECT_LT(norm(turned(run, b) - head / 3.0), 1e-11);
    } else {
      // The two free rotations take the moment: w = M t / J.
      EXPECT_LT(norm(run.report(b).angular_velocity - head / 3.0 * dot(run.report(b).angular_velocity, head) / 3.0 -
                     Vec3{0.4, 0, -0.2}), 1e-9);
    }
  }
}

TEST(BodyMotion, LocalAxesTurnWithTheBody) {
  // A car that drives ahead at v and turns at w runs on a circle of radius v / w.
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity());
  RigidMaterial car;
  Frame frame;
  frame.axes = to_matrix(from_rotation_vector({0, 0, 0.7}));
  m.model.frames.push_back(frame);
  car.output_frame = 0;
  m.model.materials.push_back({3, "car", car});
  m.model.parts[0].material = 2;
  prescribe(m, b, 1, MotionKind::velocity, m.curve({0, 1}, {3, 3})).local = true;
  prescribe(m, b, 2, MotionKind::velocity, m.curve({0, 1}, {0, 0})).local = true;
  prescribe(m, b, 7, MotionKind::velocity, m.curve({0, 1}, {2, 2}));
  for (const int other : {5, 6}) prescribe(m, b, other, MotionKind::velocity, m.curve({0, 1}, {0, 0}));
  double error[2];
  for (int k = 0; k < 2; ++k) {
    Simulation run(m.model, k ? 1e-3 : 2e-3);
    run.to(1.0);
    const double radius = 1.5;
    const Vec3 expected{radius * (std::sin(2.7) - std::sin(0.7)), -radius * (std::cos(2.7) - std::cos(0.7)), 0};
    error[k] = norm(run.motion(b).center - expected);
  }
  EXPECT_LT(error[1], 2e-6);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.2);  // second order: the axes are those of the middle of the step
}

TEST(BodyMotion, FreeBeforeBirthAndAfterDeath) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity(), {1, 0, 0});
  PrescribedMotion& motion = prescribe(m, b, 1, MotionKind::velocity, m.curve({0, 10}, {5, 5}));
  motion.birth = 0.5;
  motion.death = 1.5;
  Simulation run(m.model, 0.01);
  run.load = [](State& s) { s.bodies.force[0].x = 4.0; };  // a = 2
  run.to(0.4);
  EXPECT_NEAR(run.report(b).velocity.x, 1 + 0.8, 1e-12);
  EXPECT_NEAR(run.motion(b).center.x, 0.4 + 0.16, 1e-12);
  EXPECT_EQ(run.state.reactions[0].force.x, 0.0);
  run.to(1.0);
  EXPECT_NEAR(run.report(b).velocity.x, 5.0, 1e-12);
  EXPECT_NEAR(run.state.reactions[0].force.x, -4.0, 1e-9);
  run.to(2.0);
  EXPECT_NEAR(run.report(b).velocity.x, 5.0 + 2 * 0.5, 0.011);  // the step in which it dies is counted by one side
  EXPECT_EQ(run.state.reactions[0].force.x, 0.0);
  run.to(3.0);
  EXPECT_NEAR(run.report(b).velocity.x, 5.0 + 2 * 1.5, 0.011);
}

TEST(BodyMotion, BeforeBirthAReactionIsNotThatOfTheBodysOtherConstraints) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity());
  RigidMaterial floor;
  floor.cmo = 1;
  floor.con1 = 3;  // z held
  m.model.materials.push_back({3, "floor", floor});
  m.model.parts[0].material = 2;
  prescribe(m, b, 1, MotionKind::velocity, m.curve({0, 10}, {5, 5})).birth = 0.5;
  Simulation run(m.model, 0.01);
  run.gravity = {0, 0, -9.81};
  run.to(0.25);
  EXPECT_EQ(run.motion(b).center.z, 0.0);
  EXPECT_EQ(run.state.reactions[0].force, (Vec3{}));
}

TEST(BodyMotion, WorkOfTheReactionIsTheKineticEnergy) {
  double error[2];
  for (int k = 0; k < 2; ++k) {
    Mechanism m;
    const PartIndex b = m.body(2.0, {1, 2, 3}, skew_inertia({1, 2, 2.5}));
    prescribe(m, b, 1, MotionKind::displacement, sampled(m, 1.0, [](double t) { return t * t * t; }, 4001));
    prescribe(m, b, 7, MotionKind::velocity, m.curve({0, 1}, {0, 3}));
    Simulation run(m.model, k ? 5e-4 : 1e-3);
    run.to(0.8);
    const double kinetic = run.kinetic_energy();
    EXPECT_GT(kinetic, 3.0);
    error[k] = std::abs(run.state.energy.external_work / kinetic - 1.0);
  }
  EXPECT_LT(error[1], 1e-6);
}

TEST(BodyMotion, TwoMotionsOnOneBodyShareOneReaction) {
  Mechanism m;
  const PartIndex b = m.body(2.0, {}, Mat3::identity());
  prescribe(m, b, 1, MotionKind::displacement, m.curve({0, 2}, {0, 2}));
  prescribe(m, b, 2, MotionKind::acceleration, m.curve({0, 2}, {3, 3}));
  Simulation run(m.model, 1e-3);
  run.to(1.0);
  EXPECT_LT(norm(run.motion(b).center - Vec3{1, 1.5, 0}), 1e-12);
  EXPECT_NEAR(run.report(b).velocity.y, 3.0, 1e-11);
  EXPECT_NEAR(run.state.reactions[0].force.y, 6.0, 1e-9);
  // v_x = 1 stands from t = 0 on and costs nothing; the rest is the work of the acceleration.
  EXPECT_NEAR(run.state.energy.external_work, 0.5 * 2 * 9.0, 3e-6);  // (a h)^2 m / 8: half a kick
}

TEST(BodyMotion, MotionOfANodeSetMovesItsBodies) {
  Mechanism m;
  const PartIndex a = m.body(2.0, {}, Mat3::identity()), b = m.body(1.0, {3, 0, 0}, Mat3::identity());
  PrescribedMotion motion;
  motion.nodes = {m.node(a, {1, 0, 0}), m.node(b, {3, 1, 0}), m.node(a, {0, 1, 0})};
  motion.dof = 3;
  motion.kind = MotionKind::displacement;
  motion.curve = m.curve({0, 1}, {0, 0.7});
  m.model.prescribed_motions.push_back(motion);
  Simulation run(m.model, 1e-3);
  run.to(1.0);
  EXPECT_LT(norm(run.motion(a).center - Vec3{0, 0, 0.7}), 1e-12);
  EXPECT_LT(norm(run.motion(b).center - Vec3{3, 0, 0.7}), 1e-12);
  EXPECT_EQ(run.state.reactions.size(), 2u);  // one a body
  int notices = 0;
  for (const Diagnostic& d : run.diagnostics.all()) notices += d.message.find("becomes a motion of the body") != std::string::npos;
  EXPECT_EQ(notices, 2);
}

TEST(BodyMotion, RotationAboutAnOffsetAxis) {
  // DOF 11: about an axis parallel to z through (OFFSET1, OFFSET2) = (x, y).
  Mechanism m;
  const PartIndex b = m.body(2.0, {3, 1, 0}, Mat3::identity());
  PrescribedMotion& motion = prescribe(m, b, 11, MotionKind::velocity, m.curve({0, 1}, {2, 2}));
  motion.offset_1 = 1;
  motion.offset_2 = 1;
  Simulation run(m.model, 1e-3);
  run.to(1.0);  // the radius is kept at any step
  EXPECT_LT(norm(run.motion(b).center - Vec3{1 + 2 * std::cos(2.0), 1 + 2 * std::sin(2.0), 0}), 2e-6);  // the angle of steps 2 atan(h w / 2)
  EXPECT_NEAR(norm(run.motion(b).center - Vec3{1, 1, 0}), 2.0, 1e-12);
}

TEST(BodyMotion, MotionOfADeformablePartIsAnError) {
  Mechanism m;
  m.body(2.0, {}, Mat3::identity());
  m.model.materials.push_back({3, "elastic", ElasticMaterial{}});
  Part part;
  part.id = 44;
  part.material = 2;
  m.model.parts.push_back(part);
  prescribe(m, 1, 1, MotionKind::velocity, m.curve({0, 1}, {1, 1}));
  try {
    Simulation run(m.model, 1e-3);
    FAIL() << "part 44 is no body";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("part 44"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace kardan::test

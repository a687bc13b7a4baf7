#include <numbers>

#include "elements/bench.hpp"

namespace kardan {
namespace {

using test::Bench;

SpringMaterial law(SpringLaw kind, std::array<double, 6> p, std::array<CurveIndex, 2> curve = {none, none}) {
  SpringMaterial m;
  m.law = kind;
  m.p = p;
  m.curve = curve;
  return m;
}

TEST(DiscreteForces, OscillatorKeepsItsFrequencyAndEnergy) {
  Bench b;
  const double k = 400, m1 = 2, m2 = 3, reduced = m1 * m2 / (m1 + m2);
  b.mass(b.node({0, 0, 0}), m1);
  b.mass(b.node({1, 2, 2}), m2);
  b.spring(b.spring_part(law(SpringLaw::elastic_spring, {k})), 0, 1);
  b.start();
  const Vec3 e = Vec3{1, 2, 2} / 3.0;
  b.state.nodes.v[0] = e * (-0.3 / m1);
  b.state.nodes.v[1] = e * (0.3 / m2);
  const double omega = std::sqrt(k / reduced), initial = 0.5 * reduced * std::pow(0.3 / m1 + 0.3 / m2, 2);
  const double dt = 0.02 / omega;
  // Leapfrog's own frequency: sin(W dt / 2) = w dt / 2.
  const double own = 2 / dt * std::asin(0.5 * omega * dt);
  double worst = 0, energy_error = 0;
  for (int i = 0; i < 3000; ++i) {
    if (i == 1) {
      EXPECT_NEAR(b.elements->stable_time_step(), 2 / omega, 1e-12);
      EXPECT_EQ(b.elements->governing().element, 500);
      EXPECT_EQ(b.elements->governing().kind, ElementKind::discrete);
    }
    const Vec3 before = b.state.nodes.v[1] - b.state.nodes.v[0];
    b.step(dt);
    const Vec3 after = b.state.nodes.v[1] - b.state.nodes.v[0];
    const double t = b.state.clock.time;  // x is now at t
    const double elongation = norm(b.state.nodes.x[1] - b.state.nodes.x[0]) - 3.0;
    const double amplitude = (0.3 / m1 + 0.3 / m2) * dt / std::sin(own * dt);
    worst = std::max(worst, std::abs(elongation - amplitude * std::sin(own * t)) / amplitude);
    if (i > 0) {
      energy_error = std::max(energy_error, std::abs(0.5 * reduced * dot(before, after) + b.state.energy.spring_damper - initial));
    }
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(energy_error, 1e-3 * initial);
}

TEST(DiscreteForces, DamperDecaysAsTheLaggedRecursionSays) {
  Bench b;
  b.node({0, 0, 0});
  b.mass(b.node({1, 0, 0}), 2.0);
  b.model.nodes.constrained[0] = dof_all;
  b.spring(b.spring_part(law(SpringLaw::viscous_damper, {5.0})), 0, 1);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  b.state.nodes.v[1] = {0.1, 0, 0};
  const double dt = 1e-3;
  for (int i = 0; i < 400; ++i) b.step(dt);
  EXPECT_NEAR(b.state.nodes.v[1].x, 0.1 * std::exp(-2.5 * 0.4), 0.1 * 2e-3);
  EXPECT_NEAR(b.state.energy.spring_damper, 0.5 * 2 * 0.01 * (1 - std::exp(-5 * 0.4)), 0.5 * 2 * 0.01 * 3e-3);
  EXPECT_NEAR(b.elements->stable_time_step(), 2 * 2.0 / 5.0, 1e-12);
}

TEST(DiscreteForces, TorsionalSpringTurnsBackAndReportsItsMoment) {
  Bench b;
  b.mass(b.node({0, 0, 0}), 1, 0.5);
  b.mass(b.node({0, 0, 0}), 1, 0.25);
  DiscreteSection torsion;
  torsion.dro = 1;
  SdOrientation o;
  o.iop = 0;
  o.vector = {0, 0, 3};
  b.model.sd_orientations.push_back(o);
  b.spring(b.spring_part(law(SpringLaw::elastic_spring, {30.0}), torsion), 0, 1, 0, 2.0, 0.1);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  b.step(1e-4);
  EXPECT_NEAR(b.state.discretes[0].force, 2 * 30 * 0.1, 1e-12);
  EXPECT_NEAR(b.state.nodes.moment[0].z, 6.0, 1e-12);   // positive relative rotation: node 1 is turned after node 2
  EXPECT_NEAR(b.state.nodes.moment[1].z, -6.0, 1e-12);
  const double omega = std::sqrt(60.0 * (1 / 0.5 + 1 / 0.25)), dt = 1e-4;
  double angle = 0.1;
  while (angle > 0) {
    b.step(dt);
    angle = b.state.discretes[0].elongation;
  }
  EXPECT_NEAR(b.state.clock.time, 0.5 * std::numbers::pi / omega, 3 * dt);  // a quarter of the period
}

TEST(DiscreteForces, OrientedSpringPullsAlongItsVectorOnly) {
  Bench b;
  b.mass(b.node({0, 0, 0}), 1);
  b.mass(b.node({0, 0, 0}), 1);
  SdOrientation o;
  o.vector = {2, 0, 0};
  b.model.sd_orientations.push_back(o);
  o.iop = 1;
  b.model.sd_orientations.push_back(o);
  const PartIndex p = b.spring_part(law(SpringLaw::elastic_spring, {10.0}));
  b.spring(p, 0, 1, 0);
  b.spring(p, 0, 1, 1);
  b.start();
  b.state.clock.dt_previous = 0.1;
  b.state.nodes.x[1] = {0.3, 0.4, 0.0};
  b.forces();
  EXPECT_NEAR(b.state.discretes[0].force, 3, 1e-14);
  EXPECT_NEAR(norm(b.state.discretes[0].global_force - Vec3{-3, 0, 0}), 0, 1e-14);
  EXPECT_NEAR(b.state.discretes[1].force, 4, 1e-14);
  EXPECT_NEAR(norm(b.state.nodes.force[0] - Vec3{3, 4, 0}), 0, 1e-14);
}

TEST(DiscreteForces, MovingDirectionFollowsItsNodes) {
  Bench b;
  b.mass(b.node({0, 0, 0}), 1);
  b.mass(b.node({1, 0, 0}), 1);
  b.node({0, 0, 0});
  b.node({0, 1, 0});
  SdOrientation o;
  o.iop = 2;
  o.nodes = {2, 3};
  b.model.sd_orientations.push_back(o);
  b.spring(b.spring_part(law(SpringLaw::elastic_spring, {10.0})), 0, 1, 0, 1.0, 0.5);
  b.start();
  b.state.clock.dt_previous = 0.1;
  b.forces();
  EXPECT_EQ(b.state.nodes.force[0], (Vec3{0, 5, 0}));
  b.state.nodes.x[3] = {0, 0, 2};
  b.forces();
  EXPECT_NEAR(norm(b.state.nodes.force[0] - Vec3{0, 0, 5}), 0, 1e-14);
}

TEST(DiscreteForces, FailureClearanceAndMagnification) {
  Bench b;
  for (int i = 0; i < 4; ++i) b.mass(b.node({double(i), 0, 0}), 1);
  DiscreteSection fails, clearance, dynamic;
  fails.fd = 0.2;
  clearance.cl = 0.1;
  dynamic.kd = 0.5;
  dynamic.v0 = 2.0;
  const SpringMaterial k = law(SpringLaw::elastic_spring, {100.0});
  b.spring(b.spring_part(k, fails), 0, 1);
  b.spring(b.spring_part(k, clearance), 1, 2);
  b.spring(b.spring_part(k, dynamic), 2, 3);
  b.start();
  b.state.clock.dt_previous = 0.1;
  b.state.nodes.x[1].x = 1.15;  // 0-1: 0.15; 1-2: -0.15; 2-3: 0
  b.forces();
  EXPECT_NEAR(b.state.discretes[0].force, 15, 1e-12);
  EXPECT_NEAR(b.state.discretes[1].force, -5, 1e-12);
  b.state.nodes.x[1].x = 1.25;
  b.forces();
  EXPECT_EQ(b.state.discretes[0].force, 0.0);
  b.state.nodes.x[1].x = 1.1;
  b.state.nodes.x[3].x = 3.1;  // rate 1
  b.forces();
  EXPECT_EQ(b.state.discretes[0].force, 0.0);  // failed for good
  EXPECT_NEAR(b.state.discretes[2].force, 10 * (1 + 0.5 * 1.0 / 2.0), 1e-12);
}

TEST(DiscreteForces, StopKeepsNearlyToItsLimit) {
  Bench b;
  b.node({0, 0, 0});
  b.mass(b.node({1, 0, 0}), 2.0);
  b.model.nodes.constrained[0] = dof_all;
  DiscreteSection stop;
  stop.tdl = 0.1;
  b.spring(b.spring_part(law(SpringLaw::elastic_spring, {1.0}), stop), 0, 1);
  b.start();
  b.state.nodes.v[1] = {1, 0, 0};
  double furthest = 0;
  for (int i = 0; i < 1000; ++i) {
    b.step(1e-3);
    furthest = std::max(furthest, b.state.nodes.x[1].x - 1);
  }
  EXPECT_GT(furthest, 0.1);
  EXPECT_LT(furthest, 0.1 + 3e-3);  // three steps of its velocity
}

TEST(DiscreteForces, EffectiveMassOfABodyBoundsTheStep) {
  Bench b;
  b.node({0, 1, 0});
  b.node({2, 1, 0});
  SpringMaterial k = law(SpringLaw::elastic_spring, {100.0});
  b.model.nodal_rigid_bodies.emplace_back();
  b.model.nodal_rigid_bodies[0].nodes = {0};
  b.model.nodes.constrained[1] = dof_all;
  b.spring(b.spring_part(k), 0, 1);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  BodyInfo info;
  info.mass = 4;
  info.principal_inertia = {9, 9, 0.5};
  b.state.bodies.info.push_back(info);
  b.state.bodies.motion.push_back({});
  b.state.nodes.body[0] = 0;
  b.forces();
  // force along x at (0, 1, 0): 1/m + 1 * 1/Jz
  EXPECT_NEAR(b.elements->stable_time_step(), 2 / std::sqrt(100 * (0.25 + 2.0)), 1e-14);
}

TEST(DiscreteForces, SaysWhatIsMissing) {
  Bench b;
  b.node({0, 0, 0});
  b.node({0, 0, 0});
  b.spring(b.spring_part(law(SpringLaw::nonlinear_elastic_spring, {})), 0, 1);
  b.spring(b.spring_part(law(SpringLaw::elastic_spring, {1.0})), 0, 1);
  b.spring(b.spring_part(law(SpringLaw::general_nonlinear_spring, {1.0}, {b.curve({0, 1}, {0, 1}), none})), 0, 1);
  b.start();
  std::string all;
  for (const Diagnostic& d : b.diagnostics.all()) all += to_string(d) + "\n";
  EXPECT_NE(all.find("material 100"), std::string::npos) << all;
  EXPECT_NE(all.find("two nodes in one place"), std::string::npos) << all;
  EXPECT_NE(all.find("BETA"), std::string::npos) << all;
  EXPECT_NE(all.find("which has no mass"), std::string::npos) << all;
}

}  // namespace
}  // namespace kardan

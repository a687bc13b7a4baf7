// The laws that every beam formulation keeps: rigid motion, momentum, closed forms of the element, stable step, equal bits.
#include <omp.h>

#include <gmock/gmock.h>

#include <random>

#include "elements/beam_bench.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/base/rotation.hpp"

namespace kardan {
namespace {

using namespace test;

constexpr double e_modulus = 210e9, nu = 0.3, density = 7800, shear_modulus = e_modulus / 2.6;
const Vec3 side{0.3, 5.0, 0.1};

PiecewisePlasticMaterial steel(double yield, double tangent) {
  PiecewisePlasticMaterial m;
  m.density = density;
  m.youngs_modulus = e_modulus;
  m.poissons_ratio = nu;
  m.yield_stress = yield;
  m.tangent_modulus = tangent;
  return m;
}

std::vector<BeamSection> all_sections() {
  BeamSection fine = rectangle(0.02, 0.05);
  fine.rule = 5;
  return {rectangle(0.02, 0.05), fine, tube(0.05, 0.03), resultant(0.02, 0.05), resultant(0.02, 0.05, 0.0008), truss_section(0.001)};
}

TEST(Beam, RigidRotationCarriesTheResultantsAlongForManyTurns) {
  for (const BeamSection& section : all_sections()) {
    BeamBench b;
    const bool plastic = section.elform == beam_elform::hughes_liu;
    const PartIndex p = plastic ? b.beam_part(section, steel(50e6, 1e9)) : b.beam_part(section, density, e_modulus, nu);
    const std::vector<NodeIndex> n = b.line(p, {0, 0, 0}, {0.3, 0.2, -0.1}, 3, side);
    b.start();
    ASSERT_TRUE(b.diagnostics.ok());
    const double dt = b.state.clock.dt_previous = 1e-4;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
    for (const NodeIndex k : n) {
      b.state.nodes.v[k] = vector() * 0.5;
      b.state.nodes.omega[k] = vector() * 20.0;
      b.state.nodes.x[k] += b.state.nodes.v[k] * dt;
    }
    b.forces();
    b.elements->account(b.model, b.state);
    const std::vector<Vec3> x0 = b.state.nodes.x, f0 = b.state.nodes.force, m0 = b.state.nodes.moment;
    const BeamResults r0 = b.state.results.beam;
    const double energy = b.state.energy.internal;
    ASSERT_GT(energy, 0);
    const int steps = 500;
    const Vec3 w = Vec3{2, -3, 1} * (2 * std::numbers::pi / (std::sqrt(14.0) * steps * dt));  // one turn
    const auto step = hughes_winget(w * (dt * std::tan(std::numbers::pi / steps) / (std::numbers::pi / steps)));
    Quat turned;
    for (int i = 0; i < steps; ++i) {
      turned = normalized(step * turned);
      for (const NodeIndex k : n) {
        const Vec3 x = to_matrix(turned) * x0[k];
        b.state.nodes.v[k] = (x - b.state.nodes.x[k]) / dt;
        b.state.nodes.omega[k] = w * (std::tan(std::numbers::pi / steps) / (std::numbers::pi / steps));
        b.state.nodes.x[k] = x;
      }
      b.forces();
    }
    b.elements->account(b.model, b.state);
    double force = 0, moment = 1e-12;
    for (const NodeIndex k : n) force = std::max(force, norm(f0[k])), moment = std::max(moment, norm(m0[k]));
    for (const NodeIndex k : n) {
      EXPECT_LT(norm(b.state.nodes.x[k] - x0[k]), 1e-12);  // a full turn
      EXPECT_LT(norm(b.state.nodes.force[k] - f0[k]), 1e-9 * force) << section.elform;
      EXPECT_LT(norm(b.state.nodes.moment[k] - m0[k]), 1e-9 * moment) << section.elform;
    }
    EXPECT_NEAR(b.state.energy.internal, energy, 1e-9 * energy) << section.elform;
    for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(b.state.results.beam.axial[e], r0.axial[e], 1e-9 * force) << section.elform;
  }
}

TEST(Beam, BentShaftKeepsItsTorqueAndItsSectionTurnsWithItForManyTurns) {
  for (const BeamSection& section : {rectangle(0.02, 0.05), resultant(0.02, 0.05)}) {
    BeamBench b;
    const PartIndex p = b.beam_part(section, density, e_modulus, nu);
    const NodeIndex n1 = b.node({0, 0, 0}), n2 = b.node({0.2, 0, 0});
    b.beam(p, n1, n2, b.node({0, 1, 0}));
    b.start();
    const int turns = 20, steps = 2000;
    const double dt = b.state.clock.dt_previous = 1e-4, tilt = 0.1;
    for (int i = 0; i < 50; ++i) {  // node 2 is tilted about z
      b.state.nodes.omega[n2] = {0, 0, tilt / (50 * dt)};
      b.forces();
    }
    b.elements->account(b.model, b.state);
    const Vec3 moment = b.state.nodes.moment[n2];
    const double bending = b.state.results.beam.bending[0][1];
    const double spin = 2 * std::tan(std::numbers::pi / steps) / dt;  // each node about its own axis
    double largest = 0;
    for (int i = 0; i < turns * steps; ++i) {
      b.state.nodes.omega[n1] = {spin, 0, 0};
      b.state.nodes.omega[n2] = Vec3{std::cos(tilt), std::sin(tilt), 0} * spin;
      b.forces();
      b.elements->account(b.model, b.state);
      largest = std::max(largest, std::abs(b.state.results.beam.torsion[0]));
    }
    // Without the correction: pi tilt^2 a turn, 0.63 rad. What is left is of fourth order.
    const double stiffness = shear_modulus * (beam_moments(section).ss + beam_moments(section).tt) / 0.2;
    EXPECT_LT(largest, 0.01 * turns * std::numbers::pi * tilt * tilt * stiffness) << section.elform;
    // The section, weak and strong, is back where it was against the bend.
    EXPECT_NEAR(b.state.results.beam.bending[0][1], bending, 0.02 * bending) << section.elform;
    EXPECT_LT(norm(b.state.nodes.moment[n2] - moment), 0.05 * norm(moment)) << section.elform;
  }
}

TEST(Beam, InternalForcesConserveLinearAndAngularMomentumAndTheirPowerIsTheEnergy) {
  for (const BeamSection& section : all_sections()) {
    BeamBench b;
    const PartIndex p = b.beam_part(section, density, e_modulus, nu);
    const std::vector<NodeIndex> n = b.line(p, {0, 0, 0}, {1, 0.4, 0.3}, 5, side);
    b.start();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
    const double dt = b.state.clock.dt_previous = 1e-6;
    double work = 0;
    std::vector<Vec3> f(b.state.nodes.force), m(b.state.nodes.moment);
    for (int cycle = 0; cycle < 5; ++cycle) {
      for (const NodeIndex k : n) {
        b.state.nodes.v[k] = vector() * 10.0;
        b.state.nodes.omega[k] = vector() * 100.0;
        b.state.nodes.x[k] += b.state.nodes.v[k] * dt;
      }
      b.forces();
      Vec3 force, moment;
      double size = 0;
      for (const NodeIndex k : n) {
        const Vec3 &fk = b.state.nodes.force[k], &mk = b.state.nodes.moment[k];
        force += fk;
        moment += cross(b.state.nodes.x[k], fk) + mk;
        size = std::max(size, norm(fk));
        work -= 0.5 * dt * (dot(f[k] + fk, b.state.nodes.v[k]) + dot(m[k] + mk, b.state.nodes.omega[k]));
      }
      EXPECT_LT(norm(force), 1e-12 * size);
      EXPECT_LT(norm(moment), 1e-11 * size);
      f = b.state.nodes.force;
      m = b.state.nodes.moment;
    }
    b.elements->account(b.model, b.state);
    EXPECT_NEAR(b.state.energy.internal, work, 1e-4 * std::abs(work)) << section.elform;  // of second order in the rotation of a step
  }
}

/// Forces of one element along x (s along y, t along z) of length `l` under velocities of its second node.
struct OneElement {
  BeamBench b;
  NodeIndex n1, n2;
  double dt = 1e-9;
  explicit OneElement(const BeamSection& section, double l = 0.2) {
    const PartIndex p = b.beam_part(section, density, e_modulus, nu);
    n1 = b.node({0, 0, 0});
    n2 = b.node({l, 0, 0});
    b.beam(p, n1, n2, b.node({0, 1, 0}));
    b.start();
    b.state.clock.dt_previous = dt;
  }
  void move(const Vec3& v2, const Vec3& w1, const Vec3& w2) {
    b.state.nodes.v[n2] = v2;
    b.state.nodes.omega[n1] = w1;
    b.state.nodes.omega[n2] = w2;
    b.forces();
  }
  Vec3 force() const { return b.state.nodes.force[n2] * (-1 / dt); }
  Vec3 moment(NodeIndex n) const { return b.state.nodes.moment[n] * (-1 / dt); }
};

TEST(Beam, ResultantStiffnessIsThatOfTheCubicBeamWithShear) {
  const double l = 0.2, width = 0.02, height = 0.05, area = width * height, shear = 0.0008;
  for (const double shear_area : {0.0, shear}) {
    const BeamSection s = resultant(width, height, shear_area);
    const double ei = e_modulus * s.iss, phi = shear_area > 0 ? 12 * ei / (shear_modulus * shear_area * l * l) : 0.0;
    const double k = ei / (l * (1 + phi));
    OneElement e(s);
    e.move({1, 0, 0}, {}, {});
    EXPECT_NEAR(e.force().x, e_modulus * area / l, 1e-6 * e.force().x);
    OneElement t(s);
    t.move({}, {}, {1, 0, 0});
    EXPECT_NEAR(t.moment(t.n2).x, shear_modulus * s.j / l, 1e-9 * t.moment(t.n2).x);
    OneElement r(s);  // end rotation about s = y
    r.move({}, {}, {0, 1, 0});
    EXPECT_NEAR(r.moment(r.n2).y, (4 + phi) * k, 1e-9 * k);
    EXPECT_NEAR(r.moment(r.n1).y, (2 - phi) * k, 1e-9 * k);
    EXPECT_NEAR(r.force().z, 6 * k / l, 1e-9 * k / l);
    OneElement v(s);  // deflection along t = z
    v.move({0, 0, 1}, {}, {});
    EXPECT_NEAR(v.force().z, 12 * k / (l * l), 1e-6 * k / (l * l));
    OneElement w(s);  // and along s, bending about t
    w.move({0, 1, 0}, {}, {});
    EXPECT_NEAR(w.force().y / v.force().z, s.itt * (1 + phi) / (s.iss * (1 + phi * s.itt / s.iss)), 1e-6);
  }
}

TEST(Beam, IntegratedSectionsHaveTheirAreaMomentsAndShear) {
  const double l = 0.2;
  for (int rule = 2; rule <= 5; ++rule) {
    for (BeamSection s : {rectangle(0.02, 0.05), tube(0.05, 0.03)}) {
      s.rule = rule;
      const double area = beam_area(s), iss = beam_moments(s).ss, itt = beam_moments(s).tt;
      // 3x3 Lobatto integrates t^2 exactly too; 9 and 16 points on a circle likewise.
      OneElement e(s);
      e.move({1, 0, 0}, {}, {});
      EXPECT_NEAR(e.force().x, e_modulus * area / l, 1e-6 * e.force().x);
      OneElement m(s);
      m.move({}, {0, -1, -1}, {0, 1, 1});
      EXPECT_NEAR(m.moment(m.n2).y, e_modulus * iss * 2 / l, 1e-9 * m.moment(m.n2).y);
      EXPECT_NEAR(m.moment(m.n2).z, e_modulus * itt * 2 / l, 1e-9 * m.moment(m.n2).y);
      EXPECT_NEAR(m.force().z, 0, 1e-9 * m.moment(m.n2).y);
      OneElement v(s);
      v.move({0, 0, 1}, {}, {});
      EXPECT_NEAR(v.force().z, s.shrf * shear_modulus * area / l, 1e-6 * v.force().z);
      OneElement t(s);
      t.move({}, {}, {1, 0, 0});
      EXPECT_NEAR(t.moment(t.n2).x, shear_modulus * (iss + itt) / l, 1e-9 * t.moment(t.n2).x);
    }
  }
}

TEST(Beam, ElementsOwnSizesAndTheThirdNodeOrVectorTurnTheSection) {
  BeamBench b;
  const PartIndex p = b.beam_part(rectangle(0.02, 0.05), density, e_modulus, nu);
  const NodeIndex n1 = b.node({0, 0, 0}), n2 = b.node({0.2, 0, 0}), n3 = b.node({0, 0, 1});
  const Index e = b.beam(p, n1, n2, n3);
  b.model.beams.orientation[e] = {0.5, 2, 0};  // in place of the third node: s = y
  b.model.beams.sizes[e] = {0.03, 0.03, 0.04, 0.04, 0};
  b.start();
  b.state.clock.dt_previous = 1e-9;
  b.state.nodes.omega[n2] = {0, 1, 0};
  b.forces();
  const double iss = 0.03 * std::pow(0.04, 3) / 12, area = 0.03 * 0.04;
  const double expected = (e_modulus * iss / 0.2 + 5.0 / 6 * shear_modulus * area * 0.05) * 1e-9;
  EXPECT_NEAR(b.state.nodes.moment[n2].y, -expected, 1e-9 * expected);
  EXPECT_NEAR(b.state.nodes.mass[n1], 0.5 * density * area * 0.2, 1e-12);
  EXPECT_NEAR(b.state.nodes.inertia[n1], 0.5 * density * area * 0.2 * (0.04 * 0.04 / 12 + 0.04 / 8), 1e-12);
}

TEST(Beam, StableStepIsStableForTenThousandCyclesOfAFreeBeam) {
  for (const double length : {0.6, 0.1, 0.02}) {  // slender to stubby elements of a section of 20 x 50 mm
    for (const BeamSection& section : all_sections()) {
      BeamBench b;
      const PartIndex p = b.beam_part(section, density, e_modulus, nu);
      const std::vector<NodeIndex> n = b.line(p, {0, 0, 0}, {6 * length, 0, 0}, 6, {0, 1, 0});
      b.start();
      std::mt19937 random(5);
      std::uniform_real_distribution<double> uniform(-1, 1);
      for (const NodeIndex k : n) {  // small motions of all modes
        b.state.nodes.v[k] = Vec3{uniform(random), uniform(random), uniform(random)} * 1e-3;
        if (b.state.nodes.inertia[k] > 0) b.state.nodes.omega[k] = Vec3{uniform(random), uniform(random), uniform(random)} * (1e-3 / length);
      }
      const double start = b.kinetic_energy();
      b.forces();
      const double dt = 0.9 * b.elements->stable_time_step();
      ASSERT_TRUE(std::isfinite(dt));
      for (int i = 0; i < 10000; ++i) b.step(dt);
      b.elements->account(b.model, b.state);
      // At 0.9 of the limit the discrete energy swings by 1/(1 - 0.81) at most; an unstable mode would have grown beyond all bounds.
      EXPECT_LT(b.kinetic_energy() + b.state.energy.internal, 6 * start) << section.elform << " " << length;
      const double longest = length / std::sqrt(e_modulus / density);
      EXPECT_LE(dt, 0.9001 * longest);
    }
  }
}

TEST(Beam, StableStepIsSharp) {
  for (const BeamSection& section : all_sections()) {
    for (const double length : {0.6, 0.02}) {
      BeamBench b;
      const PartIndex p = b.beam_part(section, density, e_modulus, nu);
      const std::vector<NodeIndex> n = b.line(p, {0, 0, 0}, {length, 0, 0}, 1, {0, 1, 0});
      b.start();
      b.state.nodes.v[n[1]] = {1e-6, 1e-6, 1e-6};
      const double start = b.kinetic_energy();
      b.forces();
      const double dt = 1.03 * b.elements->stable_time_step();
      for (int i = 0; i < 60; ++i) b.step(dt);
      EXPECT_GT(b.kinetic_energy(), 1e6 * start) << section.elform << " " << length;
    }
  }
}

TEST(Beam, SlenderResultantBeamsHaveTheStepOfTheStretch) {
  OneElement e(resultant(0.01, 0.01), 1.0);
  EXPECT_NEAR(e.b.elements ? (e.b.forces(), e.b.elements->stable_time_step()) : 0, 1.0 / std::sqrt(e_modulus / density), 1e-9);
}

TEST(Beam, StubbyResultantBeamsHaveTheBendingBoundOfTheTheoryManual) {
  const double l = 0.02, width = 0.02, height = 0.05;
  OneElement e(resultant(width, height), l);
  e.b.forces();
  const double area = width * height, i = area * height * height / 12, c = std::sqrt(e_modulus / density);
  const double bound = 0.5 * l / (c * std::sqrt(3 * i * (3 / (12 * i + area * l * l) + 1 / (area * l * l))));
  EXPECT_NEAR(e.b.elements->stable_time_step(), bound, 1e-9 * bound);
  EXPECT_LT(bound, l / c);
}

std::uint64_t hash_after_cycles(const BeamSection& section, int level, int threads) {
  set_kernel_level(level);
  omp_set_num_threads(threads);
  BeamBench b;
  const bool plastic = section.elform != beam_elform::belytschko_schwer;
  const PartIndex p = plastic ? b.beam_part(section, steel(50e6, 1e9)) : b.beam_part(section, density, e_modulus, nu);
  const std::vector<NodeIndex> n = b.line(p, {0, 0, 0}, {3, 0.4, 0.3}, 1300, side);  // three tiles
  b.start();
  for (const NodeIndex k : n) {
    const double x = b.model.nodes.x[k].x;
    b.state.nodes.v[k] = {3 * std::sin(x), 2 * std::cos(5 * x), 4 * std::sin(3 * x)};
    b.state.nodes.omega[k] = {2 * std::cos(x), 30 * std::sin(7 * x), 20 * std::cos(9 * x)};
  }
  b.forces();
  const double dt = 0.9 * b.elements->stable_time_step();
  for (int i = 0; i < 30; ++i) b.step(dt);
  set_kernel_level(0);
  omp_set_num_threads(1);
  return b.state.registry.hash();
}

TEST(Beam, BitsDependNeitherOnThreadsNorOnTheInstructionSet) {
  for (const BeamSection& section : {rectangle(0.02, 0.05), tube(0.05, 0.03), resultant(0.02, 0.05), truss_section(0.001)}) {
    const std::uint64_t expected = hash_after_cycles(section, lowest_kernel_level, 1);
    for (int level = lowest_kernel_level; level <= std::min(native_level(), highest_kernel_level); ++level) {
      EXPECT_EQ(hash_after_cycles(section, level, 1), expected) << section.elform << " level " << level;
      EXPECT_EQ(hash_after_cycles(section, level, 3), expected) << section.elform << " threads";
    }
  }
}

TEST(Beam, WhatIsNotComputedIsRefusedByName) {
  const auto errors = [](const BeamSection& section, const auto& law, bool third) {
    BeamBench b;
    const PartIndex p = b.beam_part(section, law);
    b.beam(p, b.node({0, 0, 0}), b.node({1, 0, 0}), third ? b.node({0.5, 0, 0}) : none);  // a third node on the axis does not help
    b.start();
    std::string text;
    for (const Diagnostic& d : b.diagnostics.all()) text += d.message + "\n";
    return text;
  };
  const ElasticMaterial elastic{density, e_modulus, nu, 0, 0};
  EXPECT_EQ(errors(tube(0.05, 0.03), elastic, false), "");
  EXPECT_EQ(errors(rectangle(0.05, 0.05), elastic, true), "");
  EXPECT_THAT(errors(rectangle(0.02, 0.05), elastic, false), ::testing::HasSubstr("no direction across its axis"));
  EXPECT_THAT(errors(rectangle(0.02, 0.05), elastic, true), ::testing::HasSubstr("no direction across its axis"));
  EXPECT_THAT(errors(resultant(0.02, 0.05), steel(1e8, 0), false), ::testing::HasSubstr("ELFORM = 2 and a material other than"));
  BeamSection other = rectangle(0.02, 0.02);
  other.elform = 5;
  EXPECT_THAT(errors(other, elastic, false), ::testing::HasSubstr("ELFORM = 5"));
  other.elform = 1;
  other.cst = 2;
  EXPECT_THAT(errors(other, elastic, false), ::testing::HasSubstr("CST = 2"));
}

}  // namespace
}  // namespace kardan

// Structures of beams against closed forms: deflection, frequency, large rotation, plasticity, trusses.
#include <gmock/gmock.h>

#include "elements/beam_bench.hpp"

namespace kardan {
namespace {

using namespace test;

constexpr double e_modulus = 210e9, nu = 0.3, density = 7800, shear_modulus = e_modulus / 2.6;

PiecewisePlasticMaterial steel(double yield, double tangent) {
  PiecewisePlasticMaterial m;
  m.density = density;
  m.youngs_modulus = e_modulus;
  m.poissons_ratio = nu;
  m.yield_stress = yield;
  m.tangent_modulus = tangent;
  return m;
}

/// A cantilever of 1 m along x with a section of 20 x 50 mm (s = y), its first node held.
struct Cantilever : BeamBench {
  std::vector<NodeIndex> n;
  double dt = 0;
  Cantilever(const BeamSection& section, int count, double length = 1) {
    const PartIndex p = beam_part(section, density, e_modulus, nu);
    n = line(p, {0, 0, 0}, {length, 0, 0}, count, {0, 1, 0});
    start();
    forces();
    dt = 0.9 * elements->stable_time_step();
  }
  /// Static solution under `load`, by velocities that are reduced so that the first mode is about critically damped.
  template <class Load>
  void relax(double circular_frequency, double time, Load load) {
    const double factor = 1 - 2 * circular_frequency * dt;
    for (int i = 0; i < static_cast<int>(time / dt); ++i) {
      step(dt, load, [&] {
        clamp(n.front());
        slow_down(factor);
      });
    }
  }
};

/// First circular frequency of a cantilever, bending stiffness ei, mass per length m.
double first_frequency(double ei, double m, double length) { return 3.5160 * std::sqrt(ei / m) / (length * length); }

TEST(BeamStructure, TipDeflectionOfACantileverConvergesToTimoshenkos) {
  const double load = 100, area = 0.001, shear = 5.0 / 6 * area;
  for (const bool integrated : {true, false}) {
    for (const bool strong : {true, false}) {
      const auto error = [&](int count) {
        const BeamSection section = integrated ? rectangle(0.02, 0.05) : resultant(0.02, 0.05, shear);
        const double i = strong ? beam_moments(section).ss : beam_moments(section).tt, ei = e_modulus * i;
        Cantilever c(section, count);
        const double w = first_frequency(ei, density * area, 1);
        c.relax(w, 20 / w, [&] { c.state.nodes.force[c.n.back()] += strong ? Vec3{0, 0, load} : Vec3{0, load, 0}; });
        const Vec3 tip = c.state.nodes.x[c.n.back()];
        return (strong ? tip.z : tip.y) / (load / (3 * ei) + load / (shear * shear_modulus)) - 1;
      };
      const double coarse = error(5), fine = error(10);
      if (integrated) {  // one point of integration along the element: 1/(4 count^2) of the bending part
        EXPECT_NEAR(coarse, -0.01, 1e-3);
        EXPECT_NEAR(fine, -0.0025, 3e-4);
      } else {  // exact at the nodes
        EXPECT_NEAR(coarse, 0, 3e-4);
        EXPECT_NEAR(fine, 0, 3e-4);
      }
    }
  }
}

TEST(BeamStructure, FirstFrequencyOfACantileverConverges) {
  const double area = 0.02 * 0.02, ei = e_modulus * area * 0.02 * 0.02 / 12, w = first_frequency(ei, density * area, 1);
  for (const BeamSection& section : {rectangle(0.02, 0.02), resultant(0.02, 0.02), tube(0.02, 0.0)}) {
    // A round bar is softer: its frequency goes with the radius of gyration.
    const double exact = section.cst == 1 ? w * std::sqrt(12.0) / 4 : w;
    const auto error = [&](int count) {
      Cantilever c(section, count);
      c.relax(exact, 12 / exact, [&] { c.state.nodes.force[c.n.back()] += Vec3{0, 0, 1}; });
      std::fill(c.state.nodes.v.begin(), c.state.nodes.v.end(), Vec3{});
      std::fill(c.state.nodes.omega.begin(), c.state.nodes.omega.end(), Vec3{});
      std::vector<double> crossings;
      double before = c.state.nodes.x[c.n.back()].z;
      while (crossings.size() < 7) {
        c.step(c.dt, [] {}, [&] { c.clamp(c.n.front()); });
        const double z = c.state.nodes.x[c.n.back()].z;
        if (z * before < 0) crossings.push_back(c.state.clock.time - c.dt * z / (z - before));
        before = z;
      }
      return std::numbers::pi * 6 / (crossings.back() - crossings.front()) / exact - 1;
    };
    const double coarse = error(5), fine = error(20);
    EXPECT_LT(std::abs(fine), 0.01) << section.elform << " " << section.cst;
    EXPECT_LT(std::abs(fine), 0.25 * std::abs(coarse));
  }
}

TEST(BeamStructure, EndMomentRollsACantileverUpToACircle) {
  for (const BeamSection& section : {rectangle(0.02, 0.02), resultant(0.02, 0.02)}) {
    Cantilever c(section, 16);
    const double ei = e_modulus * 0.02 * std::pow(0.02, 3) / 12, w = first_frequency(ei, density * 4e-4, 1), ramp = 30 / w;
    c.relax(w, 45 / w, [&] {
      const double moment = 2 * std::numbers::pi * ei * std::min(1.0, c.state.clock.time / ramp);
      c.state.nodes.moment[c.n.back()] += Vec3{0, -moment, 0};
    });
    // A closed polygon of 16 sides whose length is that of the beam: each element turns by 1/16.
    const double across = 1.0 / 16 / std::sin(std::numbers::pi / 16);
    EXPECT_LT(norm(c.state.nodes.x[c.n.back()]), 1e-3) << section.elform;
    EXPECT_NEAR(norm(c.state.nodes.x[c.n[8]]), across, 1e-3 * across);
    EXPECT_NEAR(c.state.results.beam.bending[8][0], -2 * std::numbers::pi * ei, 1e-3 * 2 * std::numbers::pi * ei);
  }
}

/// A bend of 45 degrees and radius 100, section 1 x 1, under 600 at its end out of its plane.
/// Source of the numbers: Simo and Vu-Quoc 1986, Comput. Meth. Appl. Mech. Eng. 58, 79-116, table 3 (eight elements); the problem is
/// Bathe and Bolourchi's, 1979, Int. J. Numer. Meth. Eng. 14, 961-986, who give (15.9, 47.2, 53.4).
TEST(BeamStructure, BendOf45DegreesGoesWhereThePublishedOneGoes) {
  for (const BeamSection& section : {rectangle(1, 1), resultant(1, 1)}) {
    BeamBench b;
    const double modulus = 1e7, rho = 2.6e-4, radius = 100, load = 600;
    const PartIndex p = b.beam_part(section, rho, modulus, 0);
    std::vector<NodeIndex> n;
    for (int i = 0; i <= 8; ++i) {
      const double angle = i * std::numbers::pi / 32;
      n.push_back(b.node({radius * (1 - std::cos(angle)), radius * std::sin(angle), 0}));
    }
    const NodeIndex third = b.node({radius, 0, 0});
    for (std::size_t i = 0; i < 8; ++i) b.beam(p, n[i], n[i + 1], third);
    b.start();
    b.forces();
    const double dt = 0.9 * b.elements->stable_time_step();
    const double w = first_frequency(modulus / 12, rho, radius * std::numbers::pi / 4), ramp = 10 / w;
    for (int i = 0; i < static_cast<int>(30 / (w * dt)); ++i) {
      b.step(dt, [&] { b.state.nodes.force[n[8]].z += load * std::min(1.0, b.state.clock.time / ramp); },
             [&] {
               b.clamp(n[0]);
               b.slow_down(1 - 2 * w * dt);
             });
    }
    EXPECT_LT(norm(b.state.nodes.x[n[8]] - Vec3{15.79, 47.23, 53.37}), 0.01 * 60) << section.elform;
  }
}

TEST(BeamStructure, FreeFlightOfABentBeamKeepsEnergyAndBothMomenta) {
  for (const BeamSection& section : {rectangle(0.02, 0.05), resultant(0.02, 0.05)}) {
    Cantilever c(section, 12);
    for (const NodeIndex k : c.n) {
      const double x = c.model.nodes.x[k].x - 0.5;
      c.state.nodes.v[k] = {2, 30 * x, 40 * std::cos(3 * x)};  // turns, flies and bends
      c.state.nodes.omega[k] = {0, 0, 30};
    }
    const auto momenta = [&] {
      std::pair<Vec3, Vec3> sum;
      for (const NodeIndex k : c.n) {
        const Vec3 p = c.state.nodes.v[k] * c.state.nodes.mass[k];
        sum.first += p;
        sum.second += cross(c.state.nodes.x[k], p) + c.state.nodes.omega[k] * c.state.nodes.inertia[k];
      }
      return sum;
    };
    const auto start = momenta();
    const double energy = c.kinetic_energy();
    double largest = 0;
    c.dt *= 0.5;
    for (int i = 0; i < 20000; ++i) {
      c.step(c.dt);
      if (i % 100 == 99) largest = std::max(largest, std::abs(c.kinetic_energy() + c.state.energy.internal - energy));
    }
    const auto end = momenta();
    EXPECT_LT(norm(end.first - start.first), 1e-10 * norm(start.first));
    EXPECT_LT(norm(end.second - start.second), 1e-9 * norm(start.second)) << section.elform;
    EXPECT_LT(largest, 0.01 * energy) << section.elform;
    double bent = 0;
    for (const auto& m : c.state.results.beam.bending) bent = std::max(bent, std::abs(m[0]));
    EXPECT_GT(bent, 100);  // it did bend
  }
}

TEST(BeamStructure, TrussFollowsTheCurveOfItsMaterial) {
  const double area = 0.001, length = 2;
  const auto force = [&](const auto& law, double strain) {
    BeamBench b;
    const PartIndex p = b.beam_part(truss_section(area), law);
    const NodeIndex n1 = b.node({0, 0, 0}), n2 = b.node({length, 0, 0});
    b.beam(p, n1, n2);
    b.start();
    EXPECT_TRUE(b.diagnostics.ok());
    const int steps = 400;
    b.state.clock.dt_previous = 1e-3;
    for (int i = 1; i <= steps; ++i) {
      const Vec3 x{length * std::exp(strain * i / steps), 0, 0};
      b.state.nodes.v[n2] = (x - b.state.nodes.x[n2]) / 1e-3;
      b.state.nodes.x[n2] = x;
      b.forces();
    }
    EXPECT_EQ(norm(b.state.nodes.moment[n2]), 0);
    EXPECT_EQ(b.state.nodes.inertia[n2], 0);
    return -b.state.nodes.force[n2].x;
  };
  EXPECT_NEAR(force(ElasticMaterial{density, e_modulus, nu, 0, 0}, 0.1), area * e_modulus * 0.1, 1e-6 * area * e_modulus * 0.1);
  const double yield = 300e6, tangent = 2e9, strain = 0.05, stress = yield + tangent * (strain - yield / e_modulus);
  EXPECT_NEAR(force(steel(yield, tangent), strain), area * stress, 1e-6 * area * stress);
  EXPECT_NEAR(force(steel(yield, tangent), -strain), -area * stress, 1e-6 * area * stress);
  FieldMaterial kinematic;
  kinematic.number = 3;
  kinematic.density = density;
  kinematic.youngs_modulus = e_modulus;
  kinematic.poissons_ratio = nu;
  kinematic.values = {{"sigy", yield}, {"etan", tangent}, {"beta", 0.0}};
  EXPECT_NEAR(force(kinematic, strain), area * stress, 1e-6 * area * stress);
}

TEST(BeamStructure, PlasticMomentOfARectangleIsThatOfItsPoints) {
  const double width = 0.02, height = 0.05, yield = 300e6;
  for (const auto& [rule, lever] : {std::pair{2, 0.5 / std::sqrt(3.0)}, std::pair{5, 0.5 * (0.3478548451374538 * 0.8611363115940526 + 0.6521451548625461 * 0.3399810435848563)}}) {
    BeamBench b;
    BeamSection s = rectangle(width, height);
    s.rule = rule;
    const PartIndex p = b.beam_part(s, steel(yield, 0));
    const NodeIndex n1 = b.node({0, 0, 0}), n2 = b.node({0.1, 0, 0});
    b.beam(p, n1, n2, b.node({0, 1, 0}));
    b.start();
    b.state.clock.dt_previous = 1e-3;
    for (int i = 0; i < 200; ++i) {
      b.state.nodes.omega[n1] = {0, -0.5, 0};
      b.state.nodes.omega[n2] = {0, 0.5, 0};
      b.forces();
    }
    // 0.2 rad over 0.1 m: 25 times the yield curvature. Moment = yield stress * sum of the points' areas times their levers.
    EXPECT_NEAR(-b.state.nodes.moment[n2].y, yield * width * height * height * lever, 1e-6 * yield * width * height * height);
    b.elements->account(b.model, b.state);
    const double plastic = yield * width * height * height * lever * 0.2;
    EXPECT_NEAR(b.state.energy.internal, plastic, 0.05 * plastic);
    EXPECT_LT(b.state.energy.internal, plastic);
  }
}

}  // namespace
}  // namespace kardan

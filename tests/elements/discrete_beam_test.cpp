// Discrete beams (ELFORM 6) and spot welds (ELFORM 9).
#include <gmock/gmock.h>

#include <random>

#include "elements/beam_bench.hpp"
#include "kardan/base/rotation.hpp"

namespace kardan {
namespace {

using namespace test;

FieldMaterial fields(int number, std::map<std::string, double, std::less<>> values) {
  FieldMaterial m;
  m.number = number;
  m.keyword = "*MAT";
  m.density = 1000;
  m.values = std::move(values);
  m.youngs_modulus = m.value("e");
  m.poissons_ratio = m.value("pr");
  return m;
}

BeamSection discrete_section(int scoor) {
  BeamSection s;
  s.elform = beam_elform::discrete;
  s.scoor = scoor;
  s.volume = 1e-3;
  s.inertia = 2e-2;
  return s;
}

/// Two nodes of 0.5 kg, 0.01 kg m^2 each.
struct Pair : BeamBench {
  NodeIndex n1, n2;
  Pair(const BeamSection& section, const FieldMaterial& law, const Vec3& arm = {}, const Vec3& third = {}) {
    const PartIndex p = beam_part(section, law);
    n1 = node({1, 2, 3});
    n2 = node(Vec3{1, 2, 3} + arm);
    beam(p, n1, n2, norm(third) > 0 ? node(Vec3{1, 2, 3} + third) : none);
    start();
  }
};

const std::map<std::string, double, std::less<>> six_stiffnesses{{"tkr", 1e4}, {"tks", 2e4}, {"tkt", 3e4}, {"rkr", 100}, {"rks", 200}, {"rkt", 300}};

TEST(DiscreteBeam, EachStiffnessDampingAndPreloadActsInItsDirection) {
  const double dt = 1e-6;
  const auto forces = [&](const FieldMaterial& law) {
    Pair p(discrete_section(0), law);
    EXPECT_TRUE(p.diagnostics.ok());
    EXPECT_NEAR(p.state.nodes.mass[p.n1], 0.5, 1e-15);
    EXPECT_NEAR(p.state.nodes.inertia[p.n1], 1e-2, 1e-15);
    p.state.clock.dt_previous = dt;
    p.state.nodes.v[p.n2] = {1, 2, 3};
    p.state.nodes.omega[p.n2] = {4, 5, 6};
    p.forces();
    EXPECT_EQ(norm(p.state.nodes.force[p.n2] + p.state.nodes.force[p.n1]), 0);
    EXPECT_EQ(norm(p.state.nodes.moment[p.n2] + p.state.nodes.moment[p.n1]), 0);
    return std::pair{p.state.nodes.force[p.n1], p.state.nodes.moment[p.n1]};
  };
  // The axes turn by some 1e-6 in the step.
  const auto elastic = forces(fields(66, six_stiffnesses));
  EXPECT_LT(norm(elastic.first - Vec3{1e4, 4e4, 9e4} * dt), 1e-5 * norm(elastic.first));
  EXPECT_LT(norm(elastic.second - Vec3{400, 1000, 1800} * dt), 1e-5 * norm(elastic.second));
  const auto rest = forces(fields(66, {{"tds", 5.0}, {"rdt", 7.0}, {"for_", 11.0}, {"mos", 13.0}}));
  EXPECT_LT(norm(rest.first - Vec3{11, 10, 0}), 1e-5 * norm(rest.first));
  EXPECT_LT(norm(rest.second - Vec3{0, 13, 42}), 1e-5 * norm(rest.second));
}

TEST(DiscreteBeam, TorsionalPendulumOfZeroLengthHasItsFrequencyAndEnergy) {
  Pair p(discrete_section(0), fields(66, six_stiffnesses));
  p.state.nodes.omega[p.n2] = {0.5, 0, 0};
  const double start = p.kinetic_energy(), w = std::sqrt(100 * 2 / 1e-2);  // two equal inertias, relative motion
  p.forces();
  const double dt = 0.02 / w;
  EXPECT_LT(dt, p.elements->stable_time_step());
  const int period = static_cast<int>(std::lround(2 * std::numbers::pi / (w * dt)));
  for (int i = 0; i < 10 * period; ++i) p.step(dt);
  p.elements->account(p.model, p.state);
  EXPECT_NEAR(p.kinetic_energy() + p.state.energy.internal, start, 0.03 * start);
  EXPECT_NEAR(p.state.nodes.omega[p.n2].x, 0.5 * 0.5 * (1 + std::cos(w * 10 * period * dt)), 0.01);
}

TEST(DiscreteBeam, RigidRotationCarriesTheForcesAlong) {
  for (const int scoor : {-13, -12, -3, -2, 2, 3, 12, 13, 0, 1, -1}) {
    const bool extended = std::abs(scoor) > 1;
    Pair p(discrete_section(scoor), fields(66, six_stiffnesses), extended ? Vec3{0.2, 0.1, -0.1} : Vec3{}, extended ? Vec3{0, 1, 0} : Vec3{});
    ASSERT_TRUE(p.diagnostics.ok());
    const double dt = p.state.clock.dt_previous = 1e-3;
    if (extended) {
      p.state.nodes.v[p.n2] = {1, 2, -3};
      p.state.nodes.x[p.n2] += p.state.nodes.v[p.n2] * dt;
    }
    p.state.nodes.omega[p.n2] = {4, -5, 6};
    p.forces();
    p.elements->account(p.model, p.state);
    const Vec3 x1 = p.state.nodes.x[p.n1], x2 = p.state.nodes.x[p.n2];
    const std::vector<Vec3> f0 = p.state.nodes.force, m0 = p.state.nodes.moment;
    const double energy = p.state.energy.internal, scale = norm(m0[p.n2]);
    ASSERT_GT(scale, 0);
    const Vec3 w{200, -300, 100};
    Quat turned;
    for (int i = 0; i < 300; ++i) {
      turned = normalized(hughes_winget(w * dt) * turned);
      const Vec3 x = x1 + to_matrix(turned) * (x2 - x1);
      p.state.nodes.v[p.n1] = {};
      p.state.nodes.v[p.n2] = (x - p.state.nodes.x[p.n2]) / dt;
      p.state.nodes.omega[p.n1] = p.state.nodes.omega[p.n2] = w;
      p.state.nodes.x[p.n2] = x;
      p.forces();
    }
    p.elements->account(p.model, p.state);
    for (const NodeIndex n : {p.n1, p.n2}) {
      EXPECT_LT(norm(p.state.nodes.force[n] - to_matrix(turned) * f0[n]), 1e-9 * std::max(norm(f0[n]), scale)) << scoor;
      EXPECT_LT(norm(p.state.nodes.moment[n] - to_matrix(turned) * m0[n]), 1e-9 * scale) << scoor;
    }
    EXPECT_NEAR(p.state.energy.internal, energy, 1e-9 * energy) << scoor;
  }
}

TEST(DiscreteBeam, ForcesBalanceInForceAndMoment) {
  for (const int scoor : {-3, -2, 2, 3}) {
    Pair p(discrete_section(scoor), fields(66, six_stiffnesses), {0.3, 0.1, 0.2}, {0, 1, 0});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
    const double dt = p.state.clock.dt_previous = 1e-3;
    for (int i = 0; i < 10; ++i) {
      for (const NodeIndex n : {p.n1, p.n2}) {
        p.state.nodes.v[n] = vector() * 10.0;
        p.state.nodes.omega[n] = vector() * 100.0;
        p.state.nodes.x[n] += p.state.nodes.v[n] * dt;
      }
      p.forces();
      Vec3 force, moment;
      for (const NodeIndex n : {p.n1, p.n2}) {
        force += p.state.nodes.force[n];
        moment += cross(p.state.nodes.x[n], p.state.nodes.force[n]) + p.state.nodes.moment[n];
      }
      EXPECT_LT(norm(force), 1e-12 * norm(p.state.nodes.force[p.n1]));
      EXPECT_LT(norm(moment), 1e-11 * norm(p.state.nodes.force[p.n1]));
    }
  }
}

TEST(DiscreteBeam, StableStepIsStableForTenThousandCycles) {
  for (const int scoor : {0, -2, 3}) {
    auto values = six_stiffnesses;
    values["rkt"] = 1e5;
    values["tds"] = 20;
    Pair p(discrete_section(scoor), fields(66, values), std::abs(scoor) > 1 ? Vec3{0.4, 0, 0} : Vec3{}, std::abs(scoor) > 1 ? Vec3{0, 1, 0} : Vec3{});
    p.state.nodes.v[p.n2] = {1e-3, 2e-3, -1e-3};
    p.state.nodes.omega[p.n2] = {1e-2, 1e-2, 2e-2};
    const double start = p.kinetic_energy();
    p.forces();
    const double dt = 0.9 * p.elements->stable_time_step();
    for (int i = 0; i < 10000; ++i) p.step(dt);
    p.elements->account(p.model, p.state);
    EXPECT_LT(p.kinetic_energy(), 6 * start) << scoor;
  }
}

TEST(DiscreteBeam, CurvesGiveForceAndFailure) {
  FieldMaterial law = fields(67, {{"ffailr", 30.0}});
  BeamBench b;
  law.curves["lcidtr"] = b.curve({0, 0.01, 0.02}, {0, 10, 40});  // begins at the origin: the same in compression
  law.curves["lcidts"] = b.curve({-1, 0, 1}, {-5, 0, 50});
  const PartIndex p = b.beam_part(discrete_section(0), law);
  const NodeIndex n1 = b.node({0, 0, 0}), n2 = b.node({0, 0, 0});
  b.beam(p, n1, n2);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  b.state.clock.dt_previous = 1;
  const auto move = [&](const Vec3& step) {
    b.state.nodes.v[n2] = step;
    b.forces();
    return b.state.nodes.force[n1];
  };
  EXPECT_NEAR(move({0.005, 0, 0}).x, 5, 1e-12);
  EXPECT_NEAR(move({-0.02, 0, 0}).x, -25, 1e-12);
  EXPECT_NEAR(move({0.015, 0.5, 0}).y, 25, 1e-12);
  EXPECT_NEAR(move({0, -1, 0}).y, -2.5, 1e-12);
  EXPECT_EQ(norm(move({0.02, 0, 0})), 0);  // 40 > FFAILR
  EXPECT_EQ(norm(move({-0.01, 0, 0})), 0);
  b.elements->account(b.model, b.state);
  EXPECT_EQ(b.state.results.beam.alive[0], 0);
}

TEST(DiscreteBeam, CableHasNoCompression) {
  BeamSection section = discrete_section(0);
  section.volume = section.inertia = 0;
  section.cable_area = 1e-4;
  section.cable_offset = 0.5;
  Pair p(section, fields(71, {{"e", 2e9}, {"f0", 30.0}}), {0, 2, 0});
  ASSERT_TRUE(p.diagnostics.ok());
  EXPECT_NEAR(p.state.nodes.mass[p.n1], 0.5 * 1000 * 1e-4 * 2, 1e-12);  // no VOL: area times length
  p.forces();
  EXPECT_NEAR(p.state.nodes.force[p.n1].y, 30 + 2e9 * 1e-4 / 1.5 * 0.5, 1e-6);
  p.state.nodes.x[p.n2] = {1, 3, 3};
  p.forces();
  EXPECT_EQ(norm(p.state.nodes.force[p.n1]), 0);
}

TEST(DiscreteBeam, WhatItNeedsIsAskedFor) {
  const auto text = [](const BeamSection& section, const FieldMaterial& law, const Vec3& arm = {}) {
    Pair p(section, law, arm);
    std::string all;
    for (const Diagnostic& d : p.diagnostics.all()) all += d.message + "\n";
    return all;
  };
  BeamSection no_inertia = discrete_section(0);
  no_inertia.inertia = 0;
  EXPECT_THAT(text(no_inertia, fields(66, six_stiffnesses)), ::testing::HasSubstr("no rotary inertia"));
  EXPECT_EQ(text(no_inertia, fields(66, {{"tkr", 1.0}})), "");
  EXPECT_THAT(text(discrete_section(2), fields(66, six_stiffnesses)), ::testing::HasSubstr("no length"));
  EXPECT_THAT(text(discrete_section(7), fields(66, six_stiffnesses)), ::testing::HasSubstr("SCOOR = 7"));
  EXPECT_THAT(text(discrete_section(0), fields(66, six_stiffnesses), {0.1, 0, 0}), ::testing::HasSubstr("as if its nodes were one point"));
  EXPECT_THAT(text(discrete_section(0), fields(3, {})), ::testing::HasSubstr("does not compute"));
  EXPECT_THAT(text(discrete_section(0), fields(71, {{"e", 1.0}, {"iread", 1.0}}), {1, 0, 0}), ::testing::HasSubstr("IREAD"));
}

constexpr double weld_modulus = 210e9;

/// A weld of 6 mm diameter, 2 mm long, along x.
struct Weld : BeamBench {
  NodeIndex n1, n2;
  double area;
  explicit Weld(std::map<std::string, double, std::less<>> values) {
    BeamSection s = tube(0.006, 0);
    s.elform = beam_elform::spot_weld;
    s.shrf = 1;
    values.insert({{"e", weld_modulus}, {"pr", 0.3}, {"sigy", 400e6}});
    area = beam_area(s);
    const PartIndex p = beam_part(s, fields(100, std::move(values)));
    n1 = node({0, 0, 0});
    n2 = node({0.002, 0, 0});
    beam(p, n1, n2);
    start();
    state.clock.dt_previous = 1e-6;
  }
  /// Moves node 2 by `step`; the force on node 1.
  Vec3 move(const Vec3& step) {
    state.nodes.v[n2] = step * 1e6;
    state.nodes.x[n2] += step;
    state.clock.time += 1e-6;
    forces();
    return state.nodes.force[n1];
  }
  bool alive() {
    elements->account(model, state);
    return state.results.beam.alive.empty() || state.results.beam.alive[0] != 0;
  }
};

TEST(SpotWeld, YieldsWithItsPlasticModulus) {
  Weld w({{"eh", 1e9}});
  ASSERT_TRUE(w.diagnostics.ok());
  Vec3 f;
  for (int i = 0; i < 200; ++i) f = w.move({1e-6, 0, 0});
  const double strain = std::log(1.1), stress = (400e6 * weld_modulus + 1e9 * weld_modulus * strain) / (weld_modulus + 1e9);
  EXPECT_NEAR(f.x, stress * w.area, 2e-5 * stress * w.area);
  EXPECT_TRUE(w.alive());
}

TEST(SpotWeld, FailsByTheSumOfSquaresInTensionAndShearButNotInCompression) {
  const double k = weld_modulus / 0.002, step = 1e-9;
  Weld tension({{"nrr", 1000.0}, {"nrs", 800.0}});
  ASSERT_TRUE(tension.diagnostics.ok());
  int steps = 0;
  while (steps < 2000 && norm(tension.move({step, 0, 0})) > 0) ++steps;
  EXPECT_NEAR(steps, 1000 / (k * tension.area * step), 2);
  EXPECT_FALSE(tension.alive());
  EXPECT_EQ(norm(tension.move({-100 * step, 0, 0})), 0);  // gone for good
  Weld compression({{"nrr", 1000.0}, {"nrs", 800.0}});
  for (int i = 0; i < 500; ++i) compression.move({-2 * step, 0, 0});
  EXPECT_TRUE(compression.alive());
  Weld both({{"nrr", 1000.0}, {"nrs", 800.0}, {"nrt", 800.0}});
  Vec3 last{};
  for (Vec3 f{1, 0, 0}; norm(f) > 0; f = both.move({step, step, 0})) last = f;
  EXPECT_NEAR(std::pow(last.x / 1000, 2) + (last.y * last.y + last.z * last.z) / (800 * 800), 1, 0.05);
}

TEST(SpotWeld, FailsByPlasticStrainAndTime) {
  Weld strain({{"efail", 0.05}});
  int steps = 0;
  while (steps < 1000 && norm(strain.move({1e-6, 0, 0})) > 0) ++steps;
  EXPECT_NEAR(std::log(1 + steps * 1e-6 / 0.002), 0.05 + 400e6 / weld_modulus, 0.001);
  Weld time({{"tfail", 10.5e-6}});
  for (int i = 0; i < 10; ++i) EXPECT_GT(norm(time.move({1e-8, 0, 0})), 0);
  EXPECT_EQ(norm(time.move({1e-8, 0, 0})), 0);
  EXPECT_FALSE(time.alive());
}

TEST(SpotWeld, MassScalingRaisesTheStepToDt) {
  const double own = 0.002 * std::sqrt(1000 / weld_modulus);
  for (const double dt : {0.5 * own, 4 * own}) {
    Weld w({{"dt", dt}});
    ASSERT_TRUE(w.diagnostics.ok());
    w.move({});
    EXPECT_NEAR(w.elements->stable_time_step(), std::max(own, dt), 1e-9 * own);
    const double mass = 1000 * w.area * 0.002;
    EXPECT_NEAR(w.state.nodes.mass[w.n1] + w.state.nodes.mass[w.n2], mass * (dt > own ? 16 : 1), 1e-9 * mass);
    EXPECT_EQ(w.diagnostics.all().size(), dt > own ? 1u : 0u);  // the notice of the mass added
  }
}

TEST(SpotWeld, BelongsToItsMaterialAndNamesWhatIsNotDone) {
  Weld filtered({{"nf", 10.0}});
  ASSERT_FALSE(filtered.diagnostics.ok());
  EXPECT_THAT(filtered.diagnostics.all()[0].message, ::testing::HasSubstr("filtered over NF cycles"));
  BeamBench b;
  const PartIndex p = b.beam_part(tube(0.006, 0), fields(100, {{"e", 1e9}, {"sigy", 1e6}}));  // ELFORM 1
  b.beam(p, b.node({0, 0, 0}), b.node({1, 0, 0}));
  b.start();
  ASSERT_FALSE(b.diagnostics.ok());
  EXPECT_THAT(b.diagnostics.all()[0].cure, ::testing::HasSubstr("ELFORM = 9"));
}

}  // namespace
}  // namespace kardan

// *INITIAL_STRESS_…: what is in balance stays, what is not rings with the frequency and amplitude of the closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "handmade_model.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

constexpr double density = 7800, e_modulus = 210e9, sigma = 1e6;

InitialStress stressed(ElementKind kind, std::size_t elements, const std::array<double, 6>& stress) {
  InitialStress s;
  s.kind = kind;
  for (std::size_t e = 0; e < elements; ++e) s.elements.push_back(static_cast<Index>(e));
  s.points = {{0, stress, 0}};
  return s;
}

/// Has the elements' results made up at every cycle, and keeps those of t = 0.
struct Look : Observer {
  bool due(const State&, const StepView&) override { return true; }
  bool reads_elements(const State&, const StepView&) const override { return true; }
  void at(const Model&, const State& state, const StepView&) override {
    if (state.clock.cycle == 0) shell = state.results.shell.stress;
  }
  std::vector<StressVector> shell;
};

/// A column of 20 cubes under the stress sigma along z.
Bricks stressed_column(int elform, bool held) {
  Bricks b;
  const PartIndex p = b.part(ElasticMaterial{density, e_modulus, 0.0, 0, 0});
  b.model.sections[0].solid.elform = elform;
  b.column(p, 20, 0.1);
  b.model.initial_stresses = {stressed(ElementKind::solid, 20, {0, 0, sigma, 0, 0, 0})};
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n)
    if (n < 4 || (held && n >= b.model.nodes.size() - 4)) b.model.nodes.constrained[n] = dof_all;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-20;
  return b;
}

TEST(InitialStress, ABarThatIsHeldAtBothEndsStays) {
  for (const int elform : {1, 2}) {
    Bricks b = stressed_column(elform, true);
    b.model.control.termination.end_time = 1e-3;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    Look look;
    solver.attach(look);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const State& s = solver.state();
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) EXPECT_LT(norm(s.nodes.x[n] - b.model.nodes.x[n]), 1e-9 * 2 * sigma / e_modulus) << n;
    const double volume = 20 * 1e-3, energy = sigma * sigma / (2 * e_modulus) * volume;
    EXPECT_NEAR(s.energy.initial, energy, 1e-12 * energy);
    EXPECT_NEAR(s.energy.total(), energy, 1e-9 * energy);
    EXPECT_NEAR(s.results.solid.stress[7][2], sigma, 1e-9 * sigma);
  }
}

/// The end of a bar begins with the half step a dt/2, a = sigma A/m, m half an element: of the energy m a^2 dt^2/8 is missing in what the
/// leapfrog keeps; with c dt <= h that is at most h/(2 l) of sigma^2 A l/(2 E).
double letting_go(double energy, double element, double length) { return energy * element / (2 * length); }

/// Let go at one end, a bar of length l held at the other shrinks: a wave runs to and fro, the free end swings between 0 and
/// -2 sigma l/E with the period 4 l/c, and its velocity is -c sigma/E for the first half.
TEST(InitialStress, ABarThatIsLetGoRings) {
  Bricks b = stressed_column(1, false);
  const double l = 2, c = std::sqrt(e_modulus / density), period = 4 * l / c;
  b.model.control.termination.end_time = 1.25 * period;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  const std::size_t tip = b.model.nodes.size() - 1;
  double least = 0, least_time = 0, at_quarter = 0, back = -1, initial = 0;
  while (solver.step()) {
    const State& s = solver.state();
    const double t = s.clock.time, u = s.nodes.x[tip].z - l;
    if (initial == 0) initial = s.energy.initial;
    if (u < least) least = u, least_time = t;
    if (std::abs(t - 0.25 * period) < 0.6 * s.clock.dt) at_quarter = u;
    if (std::abs(t - period) < 0.6 * s.clock.dt) back = u;
  }
  const double amplitude = sigma * l / e_modulus;
  EXPECT_NEAR(at_quarter, -amplitude, 0.03 * amplitude);
  EXPECT_NEAR(least, -2 * amplitude, 0.04 * amplitude);
  EXPECT_NEAR(least_time, 0.5 * period, 0.02 * period);
  EXPECT_NEAR(back, 0.0, 0.1 * amplitude);
  EXPECT_NEAR(initial, sigma * sigma / (2 * e_modulus) * l * 0.01, 1e-9 * initial);
  const double lost = letting_go(initial, 0.1, l);
  EXPECT_NEAR(solver.state().energy.total(), initial, lost);
}

/// A strip of shells along x, clamped at x = 0, with the bending stress sigma zeta in `given` layers.
test::HandmadeModel bent_strip(int elform, int nip, int count, const std::vector<InitialStress::Point>& given) {
  test::HandmadeModel b;
  Section section;
  section.kind = ElementKind::shell;
  section.shell.elform = elform;
  section.shell.nip = nip;
  section.shell.thickness = {0.01, 0.01, 0.01, 0.01};
  const PartIndex p = b.part(section, b.material_of(ElasticMaterial{density, e_modulus, 0.0, 0, 0}));
  for (int i = 0; i <= count; ++i) {
    b.node({0.05 * i, 0, 0});
    b.node({0.05 * i, 0.05, 0});
  }
  for (int i = 0; i < count; ++i) {
    b.model.shells.id.push_back(i + 1);
    b.model.shells.part.push_back(p);
    b.model.shells.nodes.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  b.model.nodes.constrained[0] = b.model.nodes.constrained[1] = dof_all;
  InitialStress s = stressed(ElementKind::shell, static_cast<std::size_t>(count), {});
  s.points = given;
  b.model.initial_stresses = {s};
  return b;
}

/// The moment of the stress sigma zeta, M = sigma h^2/6 per width, makes the clamped strip swing about the deflection -M l^2/(2 E I) (it
/// bends back): the mean over many periods is that, the largest about twice as much.
TEST(InitialStress, AShellWithABendingStressSwingsAboutItsUnbentShape) {
  for (const int elform : {2, 16}) {
    const int nip = elform == 2 ? 3 : 2;
    test::HandmadeModel b = bent_strip(elform, nip, 8, {{-1, {-sigma, 0, 0, 0, 0, 0}, 0}, {1, {sigma, 0, 0, 0, 0, 0}, 0}});
    const double h = 0.01, l = 0.4, frequency = 3.516 / (l * l) * std::sqrt(e_modulus * h * h / (12 * density)) / (2 * std::numbers::pi);
    b.model.control.termination.end_time = 4 / frequency;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    const std::size_t tip = b.model.nodes.size() - 1;
    double sum = 0, time = 0, most = 0;
    while (solver.step()) {
      const State& s = solver.state();
      sum += s.nodes.x[tip].z * s.clock.dt_previous;
      time += s.clock.dt_previous;
      most = std::max(most, std::abs(s.nodes.x[tip].z));
    }
    const double deflection = sigma * h * h / 6 * l * l / 2 / (e_modulus * h * h * h / 12);
    EXPECT_NEAR(std::abs(sum / time), deflection, 0.05 * deflection) << elform;
    EXPECT_NEAR(most, 2 * deflection, 0.3 * deflection) << elform;
    EXPECT_GT(sum, 0.0) << "tension on top bends the strip upwards when it is let go";
    const double energy = sigma * sigma / (6 * e_modulus) * l * 0.05 * h;
    EXPECT_NEAR(solver.state().energy.initial, energy, 1e-9 * energy);
    EXPECT_NEAR(solver.state().energy.total(), energy, 0.02 * energy);
  }
}

/// Stresses in global axes come back in global axes, whatever the shell's own; zz of the shell is dropped.
TEST(InitialStress, GlobalStressesOfATurnedShellAreReportedAsTheyWereGiven) {
  test::HandmadeModel b = bent_strip(2, 2, 1, {});
  const Mat3 turn = to_matrix(from_rotation_vector({0.4, -0.7, 1.1}));
  for (Vec3& x : b.model.nodes.x) x = turn * x;
  const Mat3 local{{{{3e6, 1e6, 0}, {1e6, -2e6, 0}, {0, 0, 0}}}};
  const Mat3 s = turn * local * transpose(turn);
  b.model.initial_stresses[0].points = {{0, {s[0].x, s[1].y, s[2].z, s[0].y, s[1].z, s[2].x}, 0}};
  b.model.control.termination.end_time = 1e-9;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  Look look;
  solver.attach(look);
  solver.step();
  ASSERT_FALSE(look.shell.empty());
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(look.shell[0][c], b.model.initial_stresses[0].points[0].stress[c], 1e-3) << c;
}

/// With a plastic strain the yield stress is that of the hardening there: pulled on, the bar is elastic up to it.
TEST(InitialStress, PlasticStrainHasHardened) {
  Bricks b;
  PiecewisePlasticMaterial law;
  law.density = density;
  law.youngs_modulus = e_modulus;
  law.poissons_ratio = 0.3;
  law.yield_stress = 200e6;
  law.tangent_modulus = 2e9;
  b.column(b.part(law), 1, 0.1);
  InitialStress s = stressed(ElementKind::solid, 1, {0, 0, 250e6, 0, 0, 0});
  const double slope = 2e9 * e_modulus / (e_modulus - 2e9);
  s.points[0].plastic_strain = 60e6 / slope;
  b.model.initial_stresses = {s};
  for (std::size_t n = 0; n < 8; ++n) b.model.nodes.constrained[n] = dof_all;
  b.model.control.termination.end_time = 1e-5;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  Look look;
  solver.attach(look);
  solver.run();
  EXPECT_NEAR(solver.state().energy.total(), 250e6 * 250e6 / (2 * e_modulus) * 1e-3, 1e-6 * 250e6 * 250e6 / (2 * e_modulus) * 1e-3);
  // 250 MPa stands below the hardened 260 MPa; without the plastic strain it would have been pulled back to 200 MPa.
  EXPECT_NEAR(solver.state().results.solid.stress[0][2], 250e6, 1.0);
  EXPECT_NEAR(solver.state().results.solid.plastic_strain[0], 60e6 / slope, 1e-12);
}

/// Beams: a stress in the axis direction of Hughes-Liu beams, resultants of Belytschko-Schwer beams; a bar let go rings as above.
TEST(InitialStress, BeamsRingToo) {
  for (const int elform : {1, 2, 3}) {
    test::HandmadeModel b;
    Section section;
    section.kind = ElementKind::beam;
    BeamSection& beam = section.beam;
    beam.elform = elform;
    beam.ts = beam.tt = {0.02, 0.02};
    beam.area = 4e-4;
    beam.iss = beam.itt = 0.02 * 0.02 * 0.02 * 0.02 / 12;
    beam.j = 2 * beam.iss;
    const PartIndex p = b.part(section, b.material_of(ElasticMaterial{density, e_modulus, 0.3, 0, 0}));
    const int count = 20;
    for (int i = 0; i <= count; ++i) b.node({0.1 * i * std::cos(0.5), 0.1 * i * std::sin(0.5), 0});
    const NodeIndex third = b.node({0, 0, 5});
    for (int i = 0; i < count; ++i) {
      b.model.beams.id.push_back(i + 1);
      b.model.beams.part.push_back(p);
      b.model.beams.nodes.push_back({i, i + 1, third});
    }
    b.model.nodes.constrained[0] = dof_all;
    const double cs = std::cos(0.5), sn = std::sin(0.5);
    InitialStress s = stressed(ElementKind::beam, count, {sigma * cs * cs, sigma * sn * sn, 0, sigma * cs * sn, 0, 0});
    if (elform == 2) {
      s.points.clear();
      s.resultants = {sigma * beam.area, 0, 0, 0, 0, 0};
    }
    b.model.initial_stresses = {s};
    const double l = 2, c = std::sqrt(e_modulus / density), half = 2 * l / c;
    b.model.control.termination.end_time = half;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const Vec3 tip = solver.state().nodes.x[count];
    EXPECT_NEAR(norm(tip), l - 2 * sigma * l / e_modulus, 0.05 * sigma * l / e_modulus) << elform;
    const double energy = sigma * sigma / (2 * e_modulus) * beam.area * l;
    EXPECT_NEAR(solver.state().energy.initial, energy, 1e-9 * energy) << elform;
    EXPECT_NEAR(solver.state().energy.total(), energy, letting_go(energy, 0.1, l)) << elform;
  }
}

TEST(InitialStress, MaterialsWhoseStressFollowsFromTheDeformationRefuseIt) {
  Bricks b;
  FieldMaterial rubber;
  rubber.number = 7;
  rubber.keyword = "*MAT_BLATZ-KO_RUBBER";
  rubber.density = 1000;
  rubber.values = {{"g", 1e6}};
  b.column(b.part(rubber), 1, 0.1);
  b.model.initial_stresses = {stressed(ElementKind::solid, 1, {1e5, 0, 0, 0, 0, 0})};
  b.model.control.termination.end_time = 1;
  Diagnostics diagnostics;
  EXPECT_THROW(Solver(b.model, {}, diagnostics), InputError);
}

}  // namespace
}  // namespace kardan

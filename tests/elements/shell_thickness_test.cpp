// Thickness of shells: its change with the strains (ISTUPD), rules through it, offsets, deletion.
#include "elements/bench.hpp"
#include "kardan/elements/shell/shell_forces.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800, nu = 0.3;

struct Strip : Bench {
  explicit Strip(int elform, int istupd = 0) {
    section.kind = ElementKind::shell;
    section.shell.elform = elform;
    section.shell.thickness.fill(0.1);
    section.shell.nip = 3;
    model.control.shell_istupd = istupd;
    model.control.hourglass_type = 4;
  }
  void make(const decltype(Material::law)& law) {
    Material material;
    material.law = law;
    mesh(*this, part(section, material), 1, 1, 1, 1, [](const Vec3& x) { return x; });
    if (section.shell.elform == 4) model.shells.nodes[0] = {0, 1, 3, 3};
    start();
    EXPECT_TRUE(diagnostics.ok()) << to_string(diagnostics.all().front());
  }
  /// Stretches along x to `ratio`, held in y.
  void stretch(double ratio, int steps) {
    for (int i = 1; i <= steps; ++i) {
      state.clock.dt_previous = 1e-3 / steps;
      for (std::size_t n = 0; n < 4; ++n) {
        const Vec3 x{model.nodes.x[n].x * (1 + (ratio - 1) * i / steps), model.nodes.x[n].y, 0};
        state.nodes.v[n] = (x - state.nodes.x[n]) / state.clock.dt_previous;
        state.nodes.x[n] = x;
      }
      forces();
    }
    look();
  }
  double thickness() const { return state.results.shell.thickness[0]; }
  Section section;
};

class Thinning : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Elforms, Thinning, ::testing::Values(2, 4, 5, 9, 16));

TEST_P(Thinning, AStretchedElasticStripGetsThinnerByItsLateralContraction) {
  const auto error = [](int steps) {
    Strip b(GetParam(), 1);
    b.make(ElasticMaterial{density, e_modulus, nu, 0, 0});
    const double mass = b.state.nodes.mass[1];
    b.stretch(1.3, steps);
    const double expected = 0.1 * std::exp(-nu / (1 - nu) * std::log(1.3));
    EXPECT_NEAR(b.thickness(), expected, 1e-4);
    // The force is that of the thickness there is.
    const double stress = b.state.results.shell.stress[0][0];
    double force = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      if (b.model.nodes.x[n].x == 0) force += b.state.nodes.force[n].x;
    }
    EXPECT_NEAR(force, stress * b.thickness() * (GetParam() == 4 ? 0.5 : 1.0), 1e-9 * force);
    EXPECT_EQ(b.state.nodes.mass[1], mass);
    return std::abs(b.thickness() - expected);
  };
  EXPECT_NEAR(error(20) / error(40), 4.0, 0.2);  // second order
}

TEST_P(Thinning, WithoutElasticStrainsOnlyFlowMakesAStripThinner) {
  PiecewisePlasticMaterial law;
  law.density = density;
  law.youngs_modulus = e_modulus;
  law.poissons_ratio = nu;
  law.yield_stress = 210e6;
  Strip elastic(GetParam(), 4), plastic(GetParam(), 4);
  elastic.make(law);
  elastic.stretch(1 + 5e-4, 5);
  EXPECT_NEAR(elastic.thickness(), 0.1, 1e-13);
  plastic.make(law);
  plastic.stretch(1.2, 400);
  // Flow keeps the volume; the elastic part of ln 1.2 is (s_xx - nu s_yy)/E, at yield s_xx = 2 s_yy = 2/sqrt(3) Y.
  const double s = 2 / std::sqrt(3) * 210e6;
  const double flow = std::log(1.2) - s * (1 - 0.5 * nu) / e_modulus, lateral = -s * (0.5 - nu) / e_modulus;
  EXPECT_NEAR(plastic.thickness(), 0.1 * std::exp(-(flow + lateral)), 2e-6);
}

TEST(ShellThickness, StaysWithoutIstupd) {
  Strip b(2);
  b.make(ElasticMaterial{density, e_modulus, nu, 0, 0});
  b.stretch(1.3, 10);
  EXPECT_EQ(b.thickness(), 0.1);
}

TEST(ThicknessRule, LobattoIsExactToItsDegreeAndHasTheSurfaces) {
  for (int n = 2; n <= 10; ++n) {
    double x[10], w[10];
    lobatto_rule(n, x, w);
    EXPECT_EQ(x[0], -1);
    EXPECT_EQ(x[n - 1], 1);
    for (int degree = 0; degree <= 2 * n - 3; ++degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += w[i] * std::pow(x[i], degree);
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 1e-12) << n << " " << degree;
    }
  }
}

TEST(ThicknessRule, FollowsTheSection) {
  Model m;
  ShellSection s;
  s.nip = 5;
  EXPECT_NEAR(thickness_rule(m, s).points[0], -0.906179845938664, 1e-14);
  m.control.shell_lobatto = true;
  EXPECT_EQ(thickness_rule(m, s).points[4], 1);
  s.nip = 2;
  EXPECT_NEAR(thickness_rule(m, s).points[0], -1 / std::sqrt(3.0), 1e-14);  // Gauss: Lobatto's two are very inaccurate
  s.nip = 12;
  EXPECT_EQ(thickness_rule(m, s).points[11], 1);
  EXPECT_NEAR(thickness_rule(m, s).weights[0], 1.0 / 11, 1e-15);
  m.shell_rules = {{7, false, 3, {-0.9, 0.1, 0.9}, {0.25, 0.5, 0.25}}, {8, true, 4, {}, {}}};
  s.rule = 0;
  EXPECT_EQ(thickness_rule(m, s).points[1], 0.1);
  EXPECT_EQ(thickness_rule(m, s).weights[1], 1.0);
  s.rule = 1;
  EXPECT_EQ(thickness_rule(m, s).points[0], -0.75);
  EXPECT_EQ(thickness_rule(m, s).weights[3], 0.5);
}

/// Stretch and bending of a strip whose mid surface lies z above its nodes.
TEST(ShellOffset, MovesTheMidSurfaceOffTheNodes) {
  for (const int elform : {2, 16}) {
    for (const bool by_nloc : {false, true}) {
      const double z = by_nloc ? -0.05 : 0.07, kappa = 0.3, dt = 1e-10;
      Strip b(elform);
      if (by_nloc) b.section.shell.nloc = 1;
      if (!by_nloc) b.model.shells.offset[0] = z;
      b.make(ElasticMaterial{density, e_modulus, nu, 0, 0});
      b.state.clock.dt_previous = dt;
      for (std::size_t n = 0; n < 4; ++n) {
        const double x = b.model.nodes.x[n].x;
        b.state.nodes.v[n] = {0, 0, -0.5 * kappa * x * x};
        b.state.nodes.omega[n] = {0, kappa * x, 0};
      }
      b.forces();
      const double f = e_modulus / (1 - nu * nu) * kappa * dt;
      EXPECT_NEAR(b.state.nodes.force[0].x, 0.5 * f * 0.1 * z, 1e-6 * f * 0.1 * std::abs(z));
      EXPECT_NEAR(b.state.nodes.moment[0].y, 0.5 * f * (1e-3 / 12 + 0.1 * z * z), 1e-6 * f * 1e-3);
    }
  }
}

/// Two shells in a row, the second of which is stretched until it fails.
TEST(ShellDeletion, TakesForcesEnergyAndStepAway) {
  for (const int elform : {2, 16}) {
    Strip b(elform);
    FieldMaterial law;
    law.number = 3;
    law.keyword = "*MAT_PLASTIC_KINEMATIC";
    law.density = density;
    law.youngs_modulus = e_modulus;
    law.poissons_ratio = nu;
    law.values = {{"sigy", 200e6}, {"etan", 1e9}, {"beta", 1.0}, {"fs", 0.05}};
    Material material;
    material.law = law;
    mesh(b, b.part(b.section, material), 2, 1, 2, 1, [](const Vec3& x) { return x; });
    b.start();
    ASSERT_TRUE(b.diagnostics.ok()) << to_string(b.diagnostics.all().front());
    ASSERT_EQ(b.state.results.shell.alive.size(), 2u);
    b.state.clock.dt_previous = 1e-5;
    double before = 0;
    int cycle = 0;
    for (; cycle < 200 && b.state.results.deleted_shells == 0; ++cycle) {
      for (std::size_t n = 0; n < 6; ++n) {
        b.state.nodes.v[n] = {b.model.nodes.x[n].x > 1.5 ? 100.0 : 0.0, 0, 0};
        b.state.nodes.x[n] += b.state.nodes.v[n] * 1e-5;
      }
      b.forces();
      before = b.state.energy.internal;
      b.look();
    }
    ASSERT_EQ(b.state.results.deleted_shells, 1) << elform;
    EXPECT_NEAR(cycle * 1e-3, std::exp(0.05) - 1, 0.01);  // strain at failure, plane strain adds a little
    EXPECT_GT(b.state.energy.eroded_internal, before);
    EXPECT_NEAR(b.state.energy.internal, 0, 1e-12 * before);
    EXPECT_EQ(b.state.results.shell.alive[0], 1);
    EXPECT_EQ(b.state.results.shell.alive[1], 0);
    EXPECT_EQ(b.state.results.shell.stress[3][0], 0);
    for (const Vec3& f : b.state.nodes.force) EXPECT_LT(norm(f), 1e-6);
    EXPECT_EQ(b.elements->governing().element, 1000);
  }
}

}  // namespace
}  // namespace kardan

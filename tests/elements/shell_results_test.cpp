// What shells report: stresses in global axes at the layers of D3PLOT, resultants, thickness, energy density, histories of ELOUT.
#include "elements/bench.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/elements/shell/shell_forces.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800, nu = 0.3, thickness = 0.01;

Mat3 tensor(const StressVector& s) { return {{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}}; }

double largest(const Mat3& m) {
  double value = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) value = std::max(value, std::abs(m[i][j]));
  }
  return value;
}

Material plastic() {
  PiecewisePlasticMaterial law;
  law.density = density;
  law.youngs_modulus = e_modulus;
  law.poissons_ratio = nu;
  law.yield_stress = 200e6;
  law.tangent_modulus = 0;
  Material material;
  material.law = law;
  return material;
}

Section section(int points) {
  Section s;
  s.kind = ElementKind::shell;
  s.shell.thickness.fill(thickness);
  s.shell.nip = points;
  return s;
}

/// A plate of 2 x 2 elements turned into space by q. Its side 1-2 lies along the plate's x.
struct Plate {
  Bench b;
  Mat3 q;

  Plate(const Section& s, const Material& m, const Vec3& rotation) : q(to_matrix(from_rotation_vector(rotation))) {
    mesh(b, b.part(s, m), 2, 2, 0.2, 0.1, [this](const Vec3& x) { return q * x; });
  }
  /// Membrane strain e in the plate's axes and curvature k (kxx, kyy, kxy), in steps.
  void strain(const Mat3& e, const Vec3& k, int steps) {
    b.state.clock.dt_previous = 1e-6;
    const std::vector<Vec3> x = b.model.nodes.x;
    for (int i = 0; i < steps; ++i) {
      for (std::size_t n = 0; n < x.size(); ++n) {
        const Vec3 local = transpose(q) * x[n];
        const double turn_x = -(k.y * local.y + 0.5 * k.z * local.x), turn_y = k.x * local.x + 0.5 * k.z * local.y;
        const double w = -0.5 * (k.x * local.x * local.x + k.y * local.y * local.y + k.z * local.x * local.y);  // without shear
        b.state.nodes.v[n] = q * (e * local + Vec3{0, 0, w}) * (1e6 / steps);
        b.state.nodes.omega[n] = q * Vec3{turn_x, turn_y, 0} * (1e6 / steps);
      }
      b.forces();
    }
    b.look();
  }
};

TEST(ShellResults, StretchedPlateReportsItsStressInGlobalAxesOnEveryLayer) {
  Material material;
  material.law = ElasticMaterial{density, e_modulus, nu, 0, 0};
  Plate p(section(3), material, {0.4, -1.1, 0.7});
  p.b.model.output.history_shells = {1};
  p.b.start();
  ASSERT_TRUE(p.b.diagnostics.ok());
  const Mat3 strain{{{{2e-6, 0.5e-6, 0}, {0.5e-6, -1e-6, 0}, {0, 0, 0}}}};
  p.strain(strain, {}, 1);
  const double f = e_modulus / (1 - nu * nu);
  const Mat3 local{{{{f * 1.7e-6, f * 0.7 * 0.5e-6, 0}, {f * 0.7 * 0.5e-6, f * -0.4e-6, 0}, {0, 0, 0}}}};
  const Mat3 expected = p.q * local * transpose(p.q);
  const ShellResults& r = p.b.state.results.shell;
  ASSERT_EQ(r.stress.size(), 4u * 3u);
  for (const StressVector& s : r.stress) EXPECT_LT(largest(tensor(s) - expected), 1e-5 * f * 1e-6);
  for (std::size_t e = 0; e < 4; ++e) {
    EXPECT_NEAR(r.membrane[e].x, thickness * local[0].x, 1e-5 * f * 1e-6 * thickness);
    EXPECT_NEAR(r.membrane[e].y, thickness * local[1].y, 1e-5 * f * 1e-6 * thickness);
    EXPECT_NEAR(r.membrane[e].z, thickness * local[0].y, 1e-5 * f * 1e-6 * thickness);
    EXPECT_LT(norm(r.bending[e]), 1e-6 * thickness * thickness * f * 1e-6);
    EXPECT_EQ(r.thickness[e], thickness);
    double density_of_energy = 0;
    for (std::size_t i = 0; i < 3; ++i) density_of_energy += 0.5 * dot(local[i], strain[i]);
    EXPECT_NEAR(r.internal_energy[e], density_of_energy, 1e-5 * density_of_energy);
  }
  ASSERT_EQ(r.history.size(), 1u);
  ASSERT_EQ(r.history[0].size(), 3u);  // in the element's own axes, all points
  for (const PointStress& point : r.history[0]) EXPECT_LT(largest(tensor(point.stress) - local), 1e-5 * f * 1e-6);
}

TEST(ShellResults, BentPlateHasOppositeStressesInsideAndOutsideAndItsMoment) {
  for (const int points : {2, 3, 4, 5}) {
    Material material;
    material.law = ElasticMaterial{density, e_modulus, nu, 0, 0};
    Plate p(section(points), material, {0, 0, 0});
    p.b.start();
    p.strain({}, {1e-7, 0, 0}, 1);
    const ShellResults& r = p.b.state.results.shell;
    const double f = e_modulus / (1 - nu * nu), surface = f * 1e-7 * 0.5 * thickness;
    double zeta[max_shell_points], weight[max_shell_points];
    gauss_rule(points, zeta, weight);
    for (std::size_t e = 0; e < 4; ++e) {
      EXPECT_NEAR(r.stress[3 * e][0], 0, 1e-6 * surface);
      EXPECT_NEAR(r.stress[3 * e + 1][0], zeta[0] * surface, 1e-6 * surface);  // inner: the side away from the normal
      EXPECT_NEAR(r.stress[3 * e + 2][0], -zeta[0] * surface, 1e-6 * surface);
      EXPECT_NEAR(r.stress[3 * e + 2][1], -nu * zeta[0] * surface, 1e-6 * surface);
      EXPECT_NEAR(r.bending[e].x, f * std::pow(thickness, 3) / 12 * 1e-7, 1e-6 * surface * thickness * thickness);
      EXPECT_NEAR(r.bending[e].y, nu * r.bending[e].x, 1e-6 * r.bending[e].x);
    }
  }
}

TEST(ShellResults, OtherThanThreeLayersAreTheFirstPoints) {
  Material material;
  material.law = ElasticMaterial{density, e_modulus, nu, 0, 0};
  Plate p(section(3), material, {0, 0, 0});
  p.b.model.output.maxint = 5;
  p.b.start();
  p.strain({}, {1e-7, 0, 0}, 1);
  const ShellResults& r = p.b.state.results.shell;
  ASSERT_EQ(r.layers, 5);
  EXPECT_LT(r.stress[0][0], 0);
  EXPECT_NEAR(r.stress[1][0], 0, 1e-6 * std::abs(r.stress[0][0]));
  EXPECT_NEAR(r.stress[2][0], -r.stress[0][0], 1e-6 * std::abs(r.stress[0][0]));
  EXPECT_EQ(r.stress[3][0], 0);  // the element has three
}

TEST(ShellResults, PlasticStrainIsReportedByLayer) {
  Plate p(section(5), plastic(), {0.2, 0.3, -0.5});
  p.b.start();
  p.strain({}, {0.4, 0, 0}, 50);
  const ShellResults& r = p.b.state.results.shell;
  EXPECT_EQ(r.plastic_strain[0], 0);
  EXPECT_GT(r.plastic_strain[1], 5e-4);
  EXPECT_NEAR(r.plastic_strain[2], r.plastic_strain[1], 1e-4);
}

}  // namespace
}  // namespace kardan

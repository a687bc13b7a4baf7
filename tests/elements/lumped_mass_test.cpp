#include "kardan/elements/lumped_mass.hpp"

#include <numbers>
#include <numeric>

#include "elements/beam_bench.hpp"
#include "kardan/elements/geometry.hpp"

namespace kardan {
namespace {

using test::Bench;

double total(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(Geometry, VolumeOfADistortedHexahedronIsTheExactIntegral) {
  // By the divergence theorem V = 1/3 integral of x . n dA over the six bilinear faces, here by a fine midpoint rule.
  ElementCoordinates<8> x{{{0.1, 0, 0}, {2, 0.2, -0.1}, {2.3, 1.9, 0.3}, {-0.2, 2.1, 0.1},
                           {0, 0.3, 1.8}, {2.1, -0.2, 2.2}, {1.8, 2.2, 1.7}, {0.2, 1.8, 2.4}}};
  const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const int m = 200;
  double volume = 0;
  for (const auto& f : faces) {
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < m; ++j) {
        const double r = (i + 0.5) / m, s = (j + 0.5) / m;
        const Vec3 a = x[f[0]], b = x[f[1]], c = x[f[2]], d = x[f[3]];
        const Vec3 p = a * ((1 - r) * (1 - s)) + b * (r * (1 - s)) + c * (r * s) + d * ((1 - r) * s);
        const Vec3 pr = (b - a) * (1 - s) + (c - d) * s, ps = (d - a) * (1 - r) + (c - b) * r;
        volume += dot(p, cross(pr, ps)) / (3.0 * m * m);
      }
    }
  }
  EXPECT_NEAR(hexahedron_volume(x), volume, 1e-4);
}

TEST(Geometry, DegenerateSolids) {
  const Vec3 a{0, 0, 0}, b{3, 0, 0}, c{0, 2, 0}, d{0, 0, 4};
  EXPECT_NEAR(solid_volume({{a, b, c, d, d, d, d, d}}, {1, 2, 3, 4, 4, 4, 4, 4}), 4.0, 1e-14);  // tetrahedron: 3*2*4/6
  EXPECT_EQ(distinct_nodes({1, 2, 3, 4, 4, 4, 4, 4}), 4);
  EXPECT_NEAR(solid_length({{a, b, c, d, d, d, d, d}}, {1, 2, 3, 4, 4, 4, 4, 4}),
              3 * 4.0 / (0.5 * std::sqrt(12. * 12 + 8. * 8 + 6. * 6)), 1e-13);
  // wedge: triangle (0,0) (3,0) (0,2) swept by 4 along z, numbered 1 2 3 4 5 5 6 6
  const Vec3 e = b + Vec3{0, 0, 4}, f{0, 2, 4};
  EXPECT_NEAR(std::abs(hexahedron_volume({{a, b, e, d, c, c, f, f}})), 12.0, 1e-13);
}

TEST(Geometry, ShellLengthsOfTheThreeIsdo) {
  const ElementCoordinates<4> q{{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}};
  EXPECT_DOUBLE_EQ(shell_length(q, false, 0), 12.0 / 4.0);
  EXPECT_DOUBLE_EQ(shell_length(q, false, 1), 12.0 / 5.0);
  const ElementCoordinates<4> t{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 3, 0}}};
  EXPECT_DOUBLE_EQ(shell_length(t, true, 0), 2 * 6.0 / 5.0);
}

TEST(LumpedMass, DistortedShellTriangleAndSolid) {
  Bench b;
  const NodeIndex n0 = b.node({0, 0, 0}), n1 = b.node({2, 0.1, 0}), n2 = b.node({2.2, 1.7, 0}), n3 = b.node({-0.1, 1.4, 0});
  const PartIndex p = b.shell_part(0.1, 7800, 2e11, 0.3);
  b.model.sections[0].shell.mass_per_area = 5;
  b.shell(p, {n0, n1, n2, n3});
  const auto far = b.node({10, 0, 0});
  b.shell(p, {n1, far, n2, n2});
  b.model.shells.thickness[1] = {0.1, 0.2, 0.3, 0};
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const double quad = 0.5 * std::abs(2.2 * 1.3 - 1.7 * -2.1);  // diagonals (2.2, 1.7) and (-2.1, 1.3)
  const double triangle = 0.5 * std::abs(8 * 1.6 - (-0.1) * 0.2);
  EXPECT_NEAR(b.state.nodes.mass[n0], quad * (0.1 * 7800 + 5) / 4, 1e-10);
  EXPECT_NEAR(b.state.nodes.mass[far], triangle * (0.2 * 7800 + 5) / 3, 1e-9);
  EXPECT_NEAR(total(b.state.nodes.mass), quad * 785 + triangle * 1565, 1e-9);
  EXPECT_EQ(b.state.nodes.needed[far], 1);
  EXPECT_NEAR(b.state.nodes.inertia[n0], quad * 785 / 4 * quad / 8, 1e-9);
}

TEST(LumpedMass, RigidPartsHaveMassAndNoInertiaAndAreNotNeeded) {
  Bench b;
  const PartIndex p = b.shell_part(0.1, 1, 1, 0);
  b.model.materials[0].law = RigidMaterial{2.0, 200, 0, 0, 0, 0, none, {}, none, none, {}, {}};
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{3, 2, 0}, Vec3{0, 2, 0}}) b.node(x);
  b.shell(p, {0, 1, 2, 3});
  b.start();
  EXPECT_NEAR(b.state.nodes.mass[2], 2.0 * 0.1 * 6 / 4, 1e-15);
  EXPECT_EQ(b.state.nodes.inertia[2], 0.0);
  EXPECT_EQ(b.state.nodes.needed[2], 0);
  b.forces();
  EXPECT_EQ(b.elements->stable_time_step(), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(b.elements->rigid_courant_time_step(b.model, b.state), 2.0 / 10.0, 1e-15);
}

TEST(LumpedMass, BeamsBySizesAndByArea) {
  BeamSection s;
  s.ts = {0.2, 0.4};
  s.tt = {0.1, 0};
  EXPECT_NEAR(beam_area(s), 0.5 * (0.2 * 0.1 + 0.4 * 0.1), 1e-16);
  s.cst = 1;
  s.ts = {0.2, 0.2};
  s.tt = {0.1, 0.1};
  EXPECT_NEAR(beam_area(s), std::numbers::pi / 4 * (0.04 - 0.01), 1e-16);
  s.elform = 2;
  s.area = 7;
  EXPECT_EQ(beam_area(s), 7);
}

TEST(LumpedMass, SaysWhichPartCannotBeComputed) {
  Bench b;
  const PartIndex p = b.shell_part(0.1, 1, 1, 0);
  b.model.materials[0].law = UnsupportedMaterial{"*MAT_FABRIC", 1, 1, 0};
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{3, 2, 0}, Vec3{0, 2, 0}}) b.node(x);
  b.shell(p, {0, 1, 2, 3});
  b.shell(p, {0, 1, 1, 0});
  b.start();
  ASSERT_EQ(b.diagnostics.error_count(), 2u);
  EXPECT_NE(to_string(b.diagnostics.all()[0]).find("shell 1001"), std::string::npos);
  EXPECT_NE(to_string(b.diagnostics.all()[1]).find("*MAT_FABRIC"), std::string::npos);
  EXPECT_NE(to_string(b.diagnostics.all()[1]).find("part 100"), std::string::npos);
}

/// DT2MS = -2 times the step: four times the mass and the rotary inertia, on the nodes of shells and of beams, and twice the step.
TEST(MassScaling, ShellsAndBeamsGetMassAndInertia) {
  for (const bool beams : {false, true}) {
    const auto build = [beams](test::BeamBench& b) {
      if (beams)
        b.line(b.beam_part(test::rectangle(0.02, 0.03), 7800, 210e9, 0.3), {0, 0, 0}, {0.3, 0, 0}, 3, {0, 1, 0});
      else
        test::mesh(b, b.shell_part(0.01, 7800, 210e9, 0.3), 3, 2, 0.3, 0.2, [](const Vec3& x) { return x; });
    };
    test::BeamBench plain, scaled;
    build(plain);
    plain.start();
    plain.forces();
    const double step = plain.elements->stable_time_step();
    build(scaled);
    scaled.model.control.time_step.dt2ms = -2 * step;
    scaled.start();
    ASSERT_TRUE(scaled.diagnostics.ok());
    scaled.forces();
    scaled.elements->scale_masses(scaled.model, scaled.state);
    for (std::size_t n = 0; n < plain.state.nodes.mass.size(); ++n) {
      EXPECT_NEAR(scaled.state.nodes.mass[n], 4 * plain.state.nodes.mass[n], 1e-9 * plain.state.nodes.mass[n]) << beams << n;
      EXPECT_NEAR(scaled.state.nodes.inertia[n], 4 * plain.state.nodes.inertia[n], 1e-9 * plain.state.nodes.inertia[n]) << beams << n;
    }
    scaled.forces();
    EXPECT_NEAR(scaled.elements->stable_time_step(), 2 * step, 1e-9 * step) << beams;
  }
}

}  // namespace
}  // namespace kardan

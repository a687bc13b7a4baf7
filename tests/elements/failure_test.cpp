// Points that fail, elements that are deleted: from the material's fields to the forces.
#include <omp.h>

#include "elements/bench.hpp"
#include "kardan/base/isa.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800;

bool carries(const Bench& b) {
  for (const Vec3& f : b.state.nodes.force) {
    if (dot(f, f) > 0) return true;
  }
  return false;
}

/// A shell of three points, stretched at 1/s and bent so that the strain at the top point grows at 2/s and stays zero at the bottom one:
/// with MXEPS = 1e-3 the top fails at 0.5 ms, the middle at 1 ms. When is the element deleted?
double time_of_deletion(double numfip) {
  Bench b;
  const PartIndex p = b.shell_part(0.02, density, e_modulus, 0.3, 3);
  b.model.materials[0].erosion.emplace();
  b.model.materials[0].erosion->max_strain = 1e-3;
  b.model.materials[0].erosion->failing_points = numfip;
  mesh(b, p, 1, 1, 0.1, 0.1, [](const Vec3& x) { return x; });
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  const double dt = 2e-6, curvature = 1 / (0.01 * std::sqrt(0.6));
  while (b.state.clock.time < 1.5e-3) {
    b.step(dt, [] {}, [&] {
      for (std::size_t n = 0; n < 4; ++n) {
        const double x = b.model.nodes.x[n].x - 0.05;
        b.state.nodes.v[n] = {x, 0, 0};
        b.state.nodes.omega[n] = {0, curvature * x, 0};
      }
    });
    if (b.state.clock.cycle > 2 && !carries(b)) return b.state.clock.time;
  }
  return 0;
}

TEST(Failure, AShellIsDeletedWhenAsManyPointsHaveFailedAsNumfipSays) {
  EXPECT_NEAR(time_of_deletion(1), 0.5e-3, 1e-5);
  EXPECT_NEAR(time_of_deletion(2), 1e-3, 1e-5);
  EXPECT_NEAR(time_of_deletion(-30), 0.5e-3, 1e-5);  // per cent of three points
  EXPECT_NEAR(time_of_deletion(-60), 1e-3, 1e-5);
  EXPECT_EQ(time_of_deletion(3), 0);
  EXPECT_EQ(time_of_deletion(0), 0);  // all of them
}

/// Squeezed until its stable step falls below TDEL.
TEST(Failure, ASolidIsDeletedWhereItsStableStepFallsBelowTdel) {
  Bench b;
  const PartIndex p = b.solid_part(density, e_modulus, 0.3);
  PiecewisePlasticMaterial m;
  m.density = density;
  m.youngs_modulus = e_modulus;
  m.poissons_ratio = 0.3;
  m.yield_stress = 300e6;
  m.smallest_step = 1;  // to be set
  b.model.materials[0].law = m;
  std::array<NodeIndex, 8> nodes{};
  for (std::size_t i = 0; i < 8; ++i) nodes[i] = b.node({i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0, i % 4 >= 2 ? 1.0 : 0.0, i >= 4 ? 1.0 : 0.0});
  b.solid(p, nodes);
  const double wave_speed = std::sqrt(e_modulus * 0.7 / (1.3 * 0.4) / density), limit = 0.8 / wave_speed;
  std::get<PiecewisePlasticMaterial>(b.model.materials[0].law).smallest_step = limit;
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  double before = 0, now = 0, free_faces = 0;  // the last: what the faces of a lone element take off its step, at rest
  for (int i = 0; i < 2000 && std::isfinite(now); ++i) {
    b.step(1e-6, [] {}, [&] {
      for (std::size_t n = 0; n < 8; ++n) b.state.nodes.v[n] = {-200 * b.model.nodes.x[n].x, 0, 0};
    });
    before = now;
    now = b.elements->stable_time_step();
    if (i == 0) free_faces = now * wave_speed;
  }
  EXPECT_GE(before, limit * free_faces);
  EXPECT_LT(before, limit * free_faces * 1.01);
  EXPECT_GT(b.state.nodes.x[1].x, 0.7);
  b.step(1e-6);
  EXPECT_FALSE(carries(b));
}

/// A dished plate of MAT_024 with curves by rate, viscoplastic, thrown apart until it breaks. Returns the hash of everything at the end.
std::uint64_t breaking(int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  b.model.control.hourglass_type = 4;
  const PartIndex p = b.shell_part(0.02, density, e_modulus, 0.3, 3);
  Table table;
  table.parameter = {-2, 2, 6};  // logarithms of the rates
  for (const double scale : {1.0, 1.3, 1.7}) table.curve.push_back(b.curve({0, 0.02, 0.1}, {200e6 * scale, 300e6 * scale, 250e6 * scale}));
  b.model.tables.push_back(table);
  PiecewisePlasticMaterial m;
  m.density = density;
  m.youngs_modulus = e_modulus;
  m.poissons_ratio = 0.3;
  m.table = 0;
  m.formulation = 1;
  b.model.materials[0].law = m;
  b.model.materials[0].erosion.emplace();
  b.model.materials[0].erosion->max_strain = 0.02;
  mesh(b, p, 31, 27, 3.1, 2.7, [](const Vec3& x) { return x + Vec3{0, 0, 0.1 * std::sin(x.x) * std::sin(x.y)}; }, true);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(2 * x.y), std::sin(2 * x.x + x.y)} * 60.0;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  for (int i = 0; i < 200; ++i) b.step(5e-6);
  EXPECT_GT(b.state.energy.internal, 0.05 * initial);
  EXPECT_LT(b.state.energy.internal, initial);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST(Failure, BreakingDoesNotDependOnThreadsOrInstructionSet) {
  const std::uint64_t one = breaking(1, 0);
  EXPECT_EQ(one, breaking(2, 0));
  EXPECT_EQ(one, breaking(2, 2));
  EXPECT_EQ(one, breaking(1, 3));
}

}  // namespace
}  // namespace kardan

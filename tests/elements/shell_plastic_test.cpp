#include <omp.h>

#include "elements/bench.hpp"
#include "kardan/base/isa.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800;

PiecewisePlasticMaterial steel(double yield) {
  PiecewisePlasticMaterial m;
  m.density = density;
  m.youngs_modulus = e_modulus;
  m.poissons_ratio = 0.3;
  m.points = 4;
  m.strain = {0, 0.02, 0.1, 0.4};
  m.stress = {yield, 1.3 * yield, 1.6 * yield, 1.9 * yield};
  return m;
}

PartIndex plastic_part(Bench& b, const PiecewisePlasticMaterial& m, int nip) {
  const PartIndex p = b.shell_part(0.02, density, e_modulus, 0.3, nip);
  b.model.materials.back().law = m;
  return p;
}

/// A strip drawn out evenly; its edges are free and their vibration is damped. Force over true strain against the curve.
TEST(PlasticShell, StripInTensionFollowsItsCurve) {
  Bench b;
  b.model.control.hourglass_type = 4;
  const PiecewisePlasticMaterial m = steel(300e6);
  mesh(b, plastic_part(b, m, 3), 6, 2, 0.6, 0.2, [](const Vec3& x) { return x; });
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  Curve curve;
  curve.x.assign(m.strain.begin(), m.strain.begin() + 4);
  curve.y.assign(m.stress.begin(), m.stress.begin() + 4);
  b.forces();
  const double dt = 0.5 * b.elements->stable_time_step(), rate = 10;
  double force = 0;
  int compared = 0;
  for (int i = 0; b.state.clock.time * rate < 0.25; ++i) {
    b.step(dt,
           [&] {
             force = 0;
             for (const std::size_t n : {0, 7, 14}) force += b.state.nodes.force[n].x;
           },
           [&] {
             for (std::size_t n = 0; n < b.state.nodes.v.size(); ++n) {
               const Vec3& x = b.state.nodes.x[n];
               b.state.nodes.v[n].x = rate * x.x / (1 - 0.5 * rate * dt);  // x grows as exp(rate t) to second order
               b.state.nodes.v[n].y *= 0.98;
             }
           });
    if (i % 100 != 99) continue;
    const double length = b.state.nodes.x[6].x - b.state.nodes.v[6].x * dt - b.state.nodes.x[0].x;  // where `force` was taken
    const double width = b.state.nodes.x[14].y - b.state.nodes.x[0].y;
    const double strain = std::log(length / 0.6), stress = force / (width * 0.02);
    if (strain < 0.005) continue;
    EXPECT_NEAR(stress / curve.value(strain - stress / e_modulus), 1.0, 2e-3) << strain;
    ++compared;
  }
  EXPECT_GT(compared, 20);
  // Plastic work per volume is the area under the curve, less what stays elastic.
  b.elements->account(b.model, b.state);
  EXPECT_GT(b.state.energy.internal, 0.6 * 0.2 * 0.02 * 300e6 * 0.2);
}

TEST(PlasticShell, BelowYieldItHasTheBitsOfTheElasticShell) {
  Bench elastic, plastic;
  mesh(elastic, elastic.shell_part(0.02, density, e_modulus, 0.3, 3), 4, 3, 0.4, 0.3, [](const Vec3& x) { return x; });
  mesh(plastic, plastic_part(plastic, steel(1e15), 3), 4, 3, 0.4, 0.3, [](const Vec3& x) { return x; });
  for (Bench* b : {&elastic, &plastic}) {
    b->start();
    for (std::size_t n = 0; n < b->model.nodes.size(); ++n) {
      const Vec3& x = b->model.nodes.x[n];
      b->state.nodes.v[n] = {std::sin(9 * x.x), std::cos(7 * x.y), std::sin(5 * x.x + x.y)};
    }
    for (int i = 0; i < 50; ++i) b->step(2e-6);
  }
  for (std::size_t n = 0; n < elastic.model.nodes.size(); ++n) {
    EXPECT_EQ(elastic.state.nodes.v[n].x, plastic.state.nodes.v[n].x);
    EXPECT_EQ(elastic.state.nodes.v[n].z, plastic.state.nodes.v[n].z);
    EXPECT_EQ(elastic.state.nodes.omega[n].x, plastic.state.nodes.omega[n].x);
  }
}

/// A dished plate thrown apart: total energy stays, most of it becomes plastic work. Returns the hash of everything at the end.
std::uint64_t crash(int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  b.model.control.hourglass_type = 4;
  PiecewisePlasticMaterial m = steel(200e6);
  m.rate_constant = 40;
  m.rate_exponent = 5;
  mesh(b, plastic_part(b, m, 5), 31, 27, 3.1, 2.7, [](const Vec3& x) { return x + Vec3{0, 0, 0.1 * std::sin(x.x) * std::sin(x.y)}; }, true);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(2 * x.y), std::sin(2 * x.x + x.y)} * 60.0;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  double kinetic = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vec3> v = b.state.nodes.v, w = b.state.nodes.omega;
    b.step(5e-6);
    kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) {
      kinetic += 0.5 * (b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]) + b.state.nodes.inertia[n] * dot(w[n], b.state.nodes.omega[n]));
    }
  }
  EXPECT_NEAR(kinetic + b.state.energy.internal + b.state.energy.hourglass, initial, 0.01 * initial);
  EXPECT_GT(b.state.energy.internal, 0.2 * initial);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST(PlasticShell, ResultsDoNotDependOnThreadsOrInstructionSetAndEnergyStays) {
  const std::uint64_t one = crash(1, 0);
  EXPECT_EQ(one, crash(2, 0));
  EXPECT_EQ(one, crash(2, 2));
  EXPECT_EQ(one, crash(2, 3));
}

TEST(PlasticShell, HardeningThatCannotBeComputedIsRefused) {
  Bench b;
  PiecewisePlasticMaterial m = steel(300e6);
  m.stress[2] = -100e6;
  mesh(b, plastic_part(b, m, 3), 1, 1, 1, 1, [](const Vec3& x) { return x; });
  b.start();
  ASSERT_EQ(b.diagnostics.error_count(), 1u);
  EXPECT_NE(b.diagnostics.all()[0].message.find("material 100 has the yield stress"), std::string::npos);
}

}  // namespace
}  // namespace kardan

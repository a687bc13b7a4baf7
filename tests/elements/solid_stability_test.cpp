#include "elements/bench.hpp"
#include "elements/solid_meshes.hpp"

namespace kardan {
namespace {

using namespace test;

/// Largest energy (kinetic and strain) of `steps` steps of 0.9 (TSSFAC) times the stable step, over that of the start, from velocities that
/// look like noise. `at_least` steps down to where the energy of an unstable one would have gone through many orders.
double largest_energy(Bench& b, double speed, int steps) {
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  double initial = 0, worst = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const double i = static_cast<double>(n + 1);
    b.state.nodes.v[n] = Vec3{std::sin(37 * i), std::sin(53 * i + 1), std::sin(71 * i + 2)} * speed;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  b.forces();
  for (int i = 0; i < steps; ++i) {
    const std::vector<Vec3> v = b.state.nodes.v;
    b.step(0.9 * b.elements->stable_time_step());
    double kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) kinetic += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
    worst = std::max(worst, kinetic / initial);
  }
  return worst;
}

/// The length of the bulk viscosity is that of the step: a flat element's thickness, not the larger V^(1/3).
TEST(SolidStability, BulkViscosityOfAFlatElementHasItsThickness) {
  Bench b;
  const double thickness = 0.05, rate = 400;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, [&](const Vec3& x) { return Vec3{x.x, x.y, thickness * x.z}; });
  b.start();
  for (std::size_t n = 0; n < 8; ++n) b.state.nodes.v[n] = {0, 0, -rate * b.model.nodes.x[n].z};
  b.forces();  // no time has passed: all of the force is viscous
  const double c = std::sqrt((lambda + 2 * mu) / density);
  const double pressure = density * thickness * (1.5 * thickness * rate * rate + 0.06 * c * rate);
  EXPECT_NEAR(b.state.nodes.force[0].z, -pressure / 4, 1e-9 * pressure);
}

/// A stack of flat elements, 1 : 20, vibrates at random; bulk viscosity only takes energy out.
TEST(SolidStability, AStackOfFlatElementsIsStableAtTheStableStep) {
  Bench b;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 2, 2, 8, [](const Vec3& x) { return Vec3{x.x, x.y, 0.05 * x.z}; });
  EXPECT_LT(largest_energy(b, 1.0, 400), 1.5);
}

/// A flat element that is warped by several times its thickness: its hourglass vectors are long, and their control must not outrun the
/// step.
TEST(SolidStability, AWarpedFlatElementIsStableAtTheStableStep) {
  for (const int hourglass : {2, 4, 6}) {
    for (const double warp : {0.0, 0.1, 0.3}) {
      Bench b;
      b.model.control.hourglass_type = hourglass;
      mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1,
           [&](const Vec3& x) { return Vec3{x.x, x.y, 0.03 * x.z + 4 * warp * (x.x - 0.5) * (x.y - 0.5)}; });
      EXPECT_LT(largest_energy(b, 1e-2, 400), 1.5) << hourglass << ' ' << warp;
    }
  }
}

TEST(SolidStability, WarnsOfAViscousHourglassControlThatTheStepDoesNotCarry) {
  for (const double coefficient : {0.1, 0.2}) {
    Bench b;
    b.model.control.hourglass_qm = coefficient;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, identity);
    b.start();
    EXPECT_EQ(b.diagnostics.all().size(), coefficient > 0.15 ? 1u : 0u);
    if (coefficient > 0.15) {
      EXPECT_NE(b.diagnostics.all().at(0).message.find("QM = 0.2"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace kardan

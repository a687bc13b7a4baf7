#include <omp.h>

#include <random>

#include "elements/bench.hpp"
#include "elements/solid_meshes.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/elements/geometry.hpp"

namespace kardan {
namespace {

using namespace test;

class SolidPatch : public ::testing::TestWithParam<int> {};

/// Irons' patch: uniform stress and no force on inner nodes, with either hourglass control. (Bulk viscosity depends on
/// the element's size and is out of it where the volume grows, as here.)
TEST_P(SolidPatch, StressIsUniformInADistortedPatch) {
  Bench b;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 3, 3, 3, distort);
  b.model.control.hourglass_type = GetParam();
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const Mat3 expected = strain_and_compute(b);
  for (const StressVector& s : b.state.results.solid.stress) {
    EXPECT_LT(size_of(to_tensor(s) - expected), 1e-10 * size_of(expected));
  }
  double inner = 0, outer = 0;
  for (int n = 0; n < 64; ++n) {
    const auto inside = [](int i) { return i == 1 || i == 2; };
    double& largest = inside(n % 4) && inside(n / 4 % 4) && inside(n / 16) ? inner : outer;
    largest = std::max(largest, norm(b.state.nodes.force[static_cast<std::size_t>(n)]));
  }
  EXPECT_GT(outer, 0.1 * size_of(expected));
  EXPECT_LT(inner, 1e-10 * outer);
}

INSTANTIATE_TEST_SUITE_P(HourglassControls, SolidPatch, ::testing::Values(1, 2, 3, 4, 5, 6));

TEST(Solid, WedgesAndTetrahedraPassThePatchTest) {
  Bench b;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 3, 3, 3, distort, true);
  // Tetrahedra and wedges of neighbouring cubes cut their common faces along different diagonals: only the stress is
  // uniform.
  b.model.control.hourglass_type = 4;
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const Mat3 expected = strain_and_compute(b);
  for (const StressVector& s : b.state.results.solid.stress) {
    EXPECT_LT(size_of(to_tensor(s) - expected), 1e-10 * size_of(expected));
  }
  EXPECT_LT(std::abs(b.state.energy.hourglass), 1e-10 * b.state.energy.internal);
}

TEST(Solid, OneTetrahedronHasTheVolumeAndStepOfATetrahedron) {
  Bench b;
  const PartIndex p = b.solid_part(density, e_modulus, 0.3);
  const NodeIndex n[] = {b.node({0, 0, 0}), b.node({2, 0, 0}), b.node({0, 1, 0}), b.node({0, 0, 1})};
  b.solid(p, {n[0], n[1], n[2], n[3], n[3], n[3], n[3], n[3]});
  b.start();
  const double dt = b.state.clock.dt_previous = 1e-12;
  for (std::size_t i = 0; i < 4; ++i) b.state.nodes.v[i] = {b.model.nodes.x[i].x, 0, 0};
  b.forces();
  b.look();
  EXPECT_NEAR(b.state.energy.internal, 0.5 * (lambda + 2 * mu) * dt * dt / 3.0, 1e-9 * (lambda + 2 * mu) * dt * dt);
  const double altitude = 1.0 / std::sqrt(1.0 + 1.0 + 0.25);  // onto the face x/2 + y + z = 1
  EXPECT_NEAR(b.elements->stable_time_step(), altitude / std::sqrt((lambda + 2 * mu) / density),
              1e-9 * dt / 1e-12 * 1e-5);
}

TEST(Solid, RigidRotationTurnsTheStressAndLeavesTheEnergy) {
  for (const int hourglass : {2, 4, 6}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, distort);
    b.start();
    std::vector<Vec3> strained = b.model.nodes.x;
    for (std::size_t n = 0; n < 8; ++n) {
      strained[n] += some_gradient() * b.model.nodes.x[n] * 0.01;
      if (hourglass >= 4) strained[n] += Vec3{0.004, -0.002, 0.003} * (n == 0 || n == 3 || n == 6 ? 1.0 : -1.0);
    }
    move_to(b, strained, 1e-3);
    b.forces();
    move_to(b, strained, 1e-3);  // at rest: viscous forces are gone
    b.forces();
    b.look();
    const std::vector<Vec3> f0 = b.state.nodes.force;
    const Mat3 s0 = to_tensor(b.state.results.solid.stress[0]);
    const double energy = b.state.energy.internal, springs = b.state.energy.hourglass;
    ASSERT_GT(energy, 0.0);
    const Vec3 axis = normalized(Vec3{2, -3, 1});
    const int steps = 360;
    for (int i = 1; i <= steps; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / steps;
      const Mat3 k = skew(axis), q = Mat3::identity() + k * std::sin(angle) + k * k * (1 - std::cos(angle));
      std::vector<Vec3> x = strained;
      for (Vec3& p : x) p = q * p;
      move_to(b, x, 1e-3);
      b.forces();
      b.look();
      EXPECT_LT(size_of(to_tensor(b.state.results.solid.stress[0]) - q * s0 * transpose(q)), 1e-11 * size_of(s0)) << i;
      for (std::size_t n = 0; n < 8; ++n) EXPECT_LT(norm(b.state.nodes.force[n] - q * f0[n]), 1e-10 * norm(f0[n])) << i;
    }
    EXPECT_NEAR(b.state.energy.internal, energy, 1e-11 * energy);
    EXPECT_NEAR(b.state.energy.hourglass, springs, 1e-11 * energy);
  }
}

TEST(Solid, UniaxialStretchFollowsTheLogarithmicStrain) {
  const auto error = [](int steps) {
    Bench b;
    b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, identity);
    b.start();
    for (int i = 1; i <= steps; ++i) {
      std::vector<Vec3> x = b.model.nodes.x;
      for (Vec3& p : x) p.z *= 1 + 0.5 * i / steps;
      move_to(b, x, 1e-3 / steps);
      b.forces();
    }
    b.look();
    const double modulus = lambda + 2 * mu, strain = std::log(1.5);
    const StressVector& s = b.state.results.solid.stress[0];
    EXPECT_NEAR(s[0], s[2] * lambda / modulus, 1e-9 * s[2]);
    EXPECT_NEAR(b.state.nodes.force[0].z, s[2] / 4, 1e-9 * s[2]);  // unit face, four nodes
    // The integral of the stress over the length: M (l ln l - l + 1).
    EXPECT_NEAR(b.state.energy.internal / (modulus * (1.5 * strain - 0.5)), 1.0, 2.0 / (steps * steps));
    return std::abs(s[2] / (modulus * strain) - 1);
  };
  const double coarse = error(10), fine = error(20);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);  // second order
}

/// Dienes 1979, Acta Mech. 32, 217-232: with Jaumann's rate simple shear g gives s_xy = mu sin g, s_xx = mu (1 - cos
/// g).
TEST(Solid, SimpleShearHasTheStressOfJaumannsRate) {
  const auto error = [](int steps) {
    Bench b;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, identity);
    b.start();
    const double shear = 1.2;
    for (int i = 1; i <= steps; ++i) {
      std::vector<Vec3> x = b.model.nodes.x;
      for (Vec3& p : x) p.x += shear * i / steps * p.y;
      move_to(b, x, 1e-3 / steps);
      b.forces();
    }
    b.look();
    const StressVector& s = b.state.results.solid.stress[0];
    EXPECT_NEAR(b.state.energy.internal / (mu * (1 - std::cos(shear))), 1.0, 1.0 / (steps * steps));
    return std::max(std::abs(s[3] - mu * std::sin(shear)), std::abs(s[0] - mu * (1 - std::cos(shear)))) / mu;
  };
  const double coarse = error(20), fine = error(40);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(Solid, InternalForcesConserveLinearAndAngularMomentum) {
  for (const int hourglass : {2, 4, 6}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 5, 4, 6, distort, true);
    b.start();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double dt = b.state.clock.dt_previous = 1e-3;
    for (int cycle = 0; cycle < 5; ++cycle) {
      for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
        b.state.nodes.v[n] = Vec3{uniform(random), uniform(random), uniform(random)} * 10.0;
        b.state.nodes.x[n] += b.state.nodes.v[n] * dt;
      }
      b.forces();
      Vec3 force, moment;
      double size = 0, arm = 0;
      for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
        force += b.state.nodes.force[n];
        moment += cross(b.state.nodes.x[n], b.state.nodes.force[n]);
        size += norm(b.state.nodes.force[n]);
        arm = std::max(arm, norm(b.state.nodes.x[n]));
      }
      EXPECT_LT(norm(force), 1e-12 * size);
      EXPECT_LT(norm(moment), 1e-12 * size * arm);
    }
  }
}

TEST(Solid, StableStepIsVolumeOverLargestFaceAndWaveSpeed) {
  Bench b;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 2, 1, 1, [](const Vec3& x) {
    return Vec3{x.x < 1.5 ? 0.8 * x.x : 1.5, 2 * x.y, 3 * x.z};
  });
  b.start();
  b.forces();
  const double c = std::sqrt((lambda + 2 * mu) / density);
  EXPECT_NEAR(b.elements->stable_time_step(), 0.7 / c, 1e-12 / c);
  EXPECT_EQ(b.elements->governing().kind, ElementKind::solid);
  EXPECT_EQ(b.elements->governing().element, 2001);
  // In compression the bulk viscosity takes part: l / (Q + sqrt(Q^2 + c^2)), Q = Q2 c + Q1 l |rate|.
  const double rate = 500;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) b.state.nodes.v[n] = {-rate * b.model.nodes.x[n].x, 0, 0};
  b.forces();
  const double q = 0.06 * c + 1.5 * 0.7 * rate;
  EXPECT_NEAR(b.elements->stable_time_step(), 0.7 / (q + std::sqrt(q * q + c * c)), 1e-12 / c);
}

TEST(Solid, BulkViscosityIsThePressureOfLandshoffAndVonNeumannInCompressionOnly) {
  for (const double rate : {-400.0, 400.0}) {
    Bench b;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, [](const Vec3& x) { return x * 2.0; });
    b.start();
    for (std::size_t n = 0; n < 8; ++n) b.state.nodes.v[n] = b.model.nodes.x[n] * (rate / 3);
    b.forces();  // no time has passed: all of the force is viscous
    const double c = std::sqrt((lambda + 2 * mu) / density), l = 2, d = std::abs(rate);
    const double pressure = rate < 0 ? density * l * (1.5 * l * d * d + 0.06 * c * d) : 0;
    // A face of 2 x 2, a quarter of it a node; the node at the origin is pushed outwards.
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(b.state.nodes.force[0][i], -pressure, 1e-9 * (pressure + 1)) << rate;
  }
}

TEST(Solid, HourglassModesAreDampedOrSprungBackWithTheirEnergy) {
  for (const int hourglass : {2, 4}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, identity);
    b.start();
    double initial = 0;
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 x = b.model.nodes.x[n] * 2.0 - Vec3{1, 1, 1};
      b.state.nodes.v[n] = {x.x * x.y, 0.5 * x.x * x.y * x.z, 0.7 * x.y * x.z};
      initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
    }
    b.forces();
    const double dt = 0.2 * b.elements->stable_time_step();
    double peak = 0;
    for (int i = 0; i < 60; ++i) {
      b.step(dt);
      peak = std::max(peak, b.state.energy.hourglass);
    }
    EXPECT_LT(std::abs(b.state.energy.internal), 1e-6 * initial);
    EXPECT_NEAR(peak, initial, 0.03 * initial) << hourglass;
  }
}

/// Free vibration of a block: the energy of the ledger stays.
TEST(Solid, EnergyIsKeptInFreeVibration) {
  Bench b;
  b.model.control.hourglass_type = 4;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-12;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 4, 3, 3, distort);
  b.start();
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(x.x + x.y), std::cos(x.z), std::sin(x.x)} * 5.0;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  b.forces();
  const double dt = 0.5 * b.elements->stable_time_step();
  double worst = 0, stored = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Vec3> v = b.state.nodes.v;
    b.step(dt);
    double kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) kinetic += 0.5 * b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]);
    if (i == 0) continue;  // the first kick is half a step
    worst = std::max(worst, std::abs(kinetic + b.state.energy.internal + b.state.energy.hourglass - initial));
    stored = std::max(stored, b.state.energy.internal);
  }
  EXPECT_GT(stored, 0.2 * initial);
  EXPECT_LT(worst, 5e-3 * initial);
}

/// A shaken block of several tiles after some cycles.
std::uint64_t hash_after_cycles(int threads, int level, int hourglass) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  b.model.control.hourglass_type = hourglass;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 13, 11, 12, distort, true);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(5 * x.y), std::sin(4 * x.x + x.z)} * 20.0;
  }
  for (int i = 0; i < 20; ++i) b.step(5e-6);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST(Solid, ResultsDoNotDependOnThreadsOrInstructionSet) {
  for (const int hourglass : {2, 4, 6}) {
    const std::uint64_t one = hash_after_cycles(1, 0, hourglass);
    EXPECT_EQ(one, hash_after_cycles(2, 0, hourglass));
    EXPECT_EQ(one, hash_after_cycles(3, 0, hourglass));
    EXPECT_EQ(one, hash_after_cycles(2, 2, hourglass));
    EXPECT_EQ(one, hash_after_cycles(2, 3, hourglass));
  }
}

TEST(Solid, NegativeVolumeIsReportedWithElementPartTimeAndNodes) {
  Bench b;
  mesh(b, b.solid_part(density, e_modulus, 0.3), 2, 1, 1, identity);
  b.start();
  b.state.clock.time = 0.125;
  for (const std::size_t n : {2u, 5u, 8u, 11u}) b.state.nodes.x[n].x = 0.75;  // the far face passes the middle one
  try {
    b.forces();
    FAIL() << "no error";
  } catch (const RunError& error) {
    const std::string text = error.what();
    for (const char* part : {"solid 2001 of part 100", "negative volume -0.25", "t = 0.125", " 3 (0.75, 0, 0)"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(Solid, RefusesWhatIsNotComputedByName) {
  const auto message = [](auto change) {
    Bench b;
    mesh(b, b.solid_part(density, e_modulus, 0.3), 1, 1, 1, identity);
    change(b.model);
    b.start();
    return b.diagnostics.error_count() == 1 ? b.diagnostics.all()[0].message : std::string("other errors");
  };
  EXPECT_NE(message([](Model& m) { m.sections[0].solid.elform = 18; }).find("ELFORM = 18"), std::string::npos);
  EXPECT_NE(message([](Model& m) { m.control.hourglass_type = 7; }).find("IHQ = 7"), std::string::npos);
  EXPECT_NE(message([](Model& m) { std::get<ElasticMaterial>(m.materials[0].law).poissons_ratio = 0.5; }).find("0.5"),
            std::string::npos);
  EXPECT_NE(message([](Model& m) {
              m.materials[0].law = UnsupportedMaterial{"MAT_HONEYCOMB", 1, 1, 0};
            }).find("MAT_HONEYCOMB"),
            std::string::npos);
}

}  // namespace
}  // namespace kardan

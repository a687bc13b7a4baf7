// Fully integrated shells (ELFORM 16), C0 triangles (4), membranes (5, 9): patch tests, invariance, conservation, closed forms.
#include <omp.h>

#include <numbers>
#include <random>

#include "elements/bench.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/base/rotation.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800, nu = 0.3;

Vec3 straight(const Vec3& x) { return x; }
Vec3 distort(const Vec3& x) {
  return x + Vec3{0.13 * std::sin(2.1 * x.x + 1.3 * x.y), 0.11 * std::cos(1.7 * x.x - 2.3 * x.y), 0};
}

/// Quadrilaterals of ELFORM 16 or 9, or a mesh with triangles: of ELFORM 2 with ESORT = 1, so that C0 triangles lie beside Belytschko-Tsay shells.
enum class Kind { full, full_with_triangles, sorted, membrane };

struct Patch : Bench {
  Patch(Kind kind, double thickness, int nx, int ny, double lx, double ly, Vec3 (*warp)(const Vec3&), double shrf = 5.0 / 6.0, double poisson = nu) {
    const PartIndex p = shell_part(thickness, density, e_modulus, poisson, 3, shrf);
    model.sections[0].shell.elform = kind == Kind::sorted ? 2 : (kind == Kind::membrane ? 9 : 16);
    model.control.shell_esort = kind == Kind::sorted ? 1 : 0;
    model.control.hourglass_type = 4;
    mesh(*this, p, nx, ny, lx, ly, warp, kind == Kind::sorted || kind == Kind::full_with_triangles);
    start();
    EXPECT_TRUE(diagnostics.ok()) << to_string(diagnostics.all().front());
  }
};

bool inner(NodeIndex n) { return n % 4 != 0 && n % 4 != 3 && n / 4 != 0 && n / 4 != 3; }
double largest(const std::vector<Vec3>& f, bool of_inner) {
  double value = 0;
  for (std::size_t n = 0; n < f.size(); ++n) {
    if (inner(static_cast<NodeIndex>(n)) == of_inner) value = std::max(value, norm(f[n]));
  }
  return value;
}

class Formulation : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Shells, Formulation, ::testing::Values(Kind::full, Kind::full_with_triangles, Kind::sorted));

TEST_P(Formulation, MembraneStressIsUniformInADistortedPatch) {
  Patch b(GetParam(), 0.05, 3, 3, 3, 3, distort);
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = {0.7 * x.x - 0.2 * x.y, 0.4 * x.x + 1.1 * x.y, 0};
  }
  b.state.clock.dt_previous = 1e-12;
  b.forces();
  EXPECT_GT(largest(b.state.nodes.force, false), 0.0);
  EXPECT_LT(largest(b.state.nodes.force, true), 1e-10 * largest(b.state.nodes.force, false));
  b.look();
  for (std::size_t e = 1; e < b.model.shells.size(); ++e) {
    for (std::size_t c : {0u, 1u, 3u}) EXPECT_NEAR(b.state.results.shell.stress[3 * e][c], b.state.results.shell.stress[0][c], 1e-10 * e_modulus * 1e-12);
  }
}

/// Constant curvature: linear rotations and the deflection that belongs to them. The thin plate must feel no shear, on any shape. (The one-point
/// quadrilateral between sorted triangles does where it is distorted, and twist feeds its hourglass control.)
TEST_P(Formulation, ConstantCurvatureMakesUniformMomentsAndNoShear) {
  Patch b(GetParam(), 0.05, 3, 3, 3, 3, GetParam() == Kind::sorted ? straight : distort);
  const double kxx = 0.7, kyy = -0.4, kxy = GetParam() == Kind::sorted ? 0.0 : 0.5;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = {0, 0, -0.5 * (kxx * x.x * x.x + kyy * x.y * x.y + kxy * x.x * x.y)};
    b.state.nodes.omega[n] = {-(kyy * x.y + 0.5 * kxy * x.x), kxx * x.x + 0.5 * kxy * x.y, 0};
  }
  b.state.clock.dt_previous = 1e-12;
  b.forces();
  const double moment = largest(b.state.nodes.moment, false);
  EXPECT_GT(moment, 0.0);
  EXPECT_LT(largest(b.state.nodes.moment, true), 1e-10 * moment);
  for (const Vec3& f : b.state.nodes.force) EXPECT_LT(norm(f), 1e-10 * e_modulus * 0.05 * 1e-12);  // of a unit strain rate
  b.look();
  const double d = e_modulus * std::pow(0.05, 3) / (12 * (1 - nu * nu)) * 1e-12;
  const Vec3 expected{d * (kxx + nu * kyy), d * (kyy + nu * kxx), d * 0.5 * (1 - nu) * kxy};
  for (const Vec3& m : b.state.results.shell.bending) {  // in the element's axes: compared by their invariants
    EXPECT_NEAR(m.x + m.y, expected.x + expected.y, 1e-9 * d);
    EXPECT_NEAR(m.x * m.y - m.z * m.z, expected.x * expected.y - expected.z * expected.z, 1e-9 * d * d);
  }
}

TEST_P(Formulation, RigidRotationCarriesTheStressAlongForAFullTurn) {
  Patch b(GetParam(), 0.05, 2, 2, 1, 1, [](const Vec3& x) { return x + Vec3{0.1 * x.y, 0.05 * x.x, 0.2 * x.x * x.y}; });  // warped
  const double dt = b.state.clock.dt_previous = 1e-4;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::size_t count = b.model.nodes.size();
  for (std::size_t n = 0; n < count; ++n) {
    b.state.nodes.v[n] = Vec3{uniform(random), uniform(random), uniform(random)};
    b.state.nodes.omega[n] = Vec3{uniform(random), uniform(random), uniform(random)};
  }
  b.forces();
  b.look();
  const double energy = b.state.energy.internal;
  const std::vector<StressVector> stress = b.state.results.shell.stress;
  const std::vector<Vec3> f0 = b.state.nodes.force, m0 = b.state.nodes.moment;
  const Vec3 w = normalized(Vec3{2, -3, 1}) * (2 * std::tan(std::numbers::pi / 400) / dt);  // 400 steps of Hughes and Winget: one turn
  Quat turned;
  for (int i = 0; i < 400; ++i) {
    turned = normalized(hughes_winget(w * dt) * turned);
    for (std::size_t n = 0; n < count; ++n) {
      const Vec3 x = to_matrix(turned) * b.model.nodes.x[n];
      b.state.nodes.v[n] = (x - b.state.nodes.x[n]) / dt;
      b.state.nodes.omega[n] = w;
      b.state.nodes.x[n] = x;
    }
    b.forces();
  }
  b.look();
  EXPECT_NEAR(b.state.energy.internal, energy, 1e-9 * energy);
  double size = 0, off = 0;
  for (std::size_t i = 0; i < stress.size(); ++i) {
    for (std::size_t c = 0; c < 6; ++c) {
      size = std::max(size, std::abs(stress[i][c]));
      off = std::max(off, std::abs(stress[i][c] - b.state.results.shell.stress[i][c]));
    }
  }
  EXPECT_LT(off, 1e-6 * size);
  for (std::size_t n = 0; n < count; ++n) {
    EXPECT_LT(norm(b.state.nodes.force[n] - f0[n]), 1e-9 * largest(f0, false));
    EXPECT_LT(norm(b.state.nodes.moment[n] - m0[n]), 1e-9 * largest(f0, false));
  }
}

TEST_P(Formulation, InternalForcesConserveLinearAndAngularMomentum) {
  Patch b(GetParam(), 0.05, 6, 5, 6, 5, [](const Vec3& x) { return distort(x) + Vec3{0, 0, 0.3 * std::sin(2 * x.x) * std::cos(3 * x.y)}; });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  const double dt = b.state.clock.dt_previous = 1e-3;
  for (int cycle = 0; cycle < 5; ++cycle) {
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      b.state.nodes.v[n] = vector() * 10.0;
      b.state.nodes.omega[n] = vector() * 10.0;
      b.state.nodes.x[n] += b.state.nodes.v[n] * dt;
    }
    b.forces();
    Vec3 force, moment;
    double size = 0;
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      force += b.state.nodes.force[n];
      moment += cross(b.state.nodes.x[n], b.state.nodes.force[n]) + b.state.nodes.moment[n];
      size = std::max(size, norm(b.state.nodes.force[n]));
    }
    EXPECT_LT(norm(force), 1e-12 * size);
    EXPECT_LT(norm(moment), 1e-11 * size);
  }
}

TEST_P(Formulation, FreeVibrationKeepsItsEnergyAtTssfacOfNineTenths) {
  for (const auto& [nx, ny] : {std::pair{1, 1}, {2, 1}, {4, 3}}) {
    Patch b(GetParam(), 0.05, nx, ny, nx, ny, distort);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double initial = 0;
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      b.state.nodes.v[n] = Vec3{uniform(random), uniform(random), uniform(random)} * 1e-4;
      b.state.nodes.omega[n] = Vec3{uniform(random), uniform(random), uniform(random)} * 1e-4;
      initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]) +
                 0.5 * b.state.nodes.inertia[n] * dot(b.state.nodes.omega[n], b.state.nodes.omega[n]);
    }
    b.forces();
    const double dt = 0.9 * b.elements->stable_time_step();
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
      const std::vector<Vec3> v = b.state.nodes.v, w = b.state.nodes.omega;
      b.step(dt);
      double energy = b.state.energy.internal + b.state.energy.hourglass;
      for (std::size_t n = 0; n < v.size(); ++n) {
        energy += 0.5 * b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]) + 0.5 * b.state.nodes.inertia[n] * dot(w[n], b.state.nodes.omega[n]);
      }
      if (i > 0) worst = std::max(worst, std::abs(energy / initial - 1));
    }
    EXPECT_LT(worst, 1e-3) << nx << " x " << ny;  // the discrete energy of central differences is constant, whatever dt
  }
}

TEST(FullyIntegrated, InPlaneBendingOfARectangleHasTheEnergyOfTheBeam) {
  for (const double poisson : {0.0, 0.3, 0.45}) {
    for (const double length : {0.5, 1.0, 4.0}) {
      Patch b(Kind::full, 0.1, 1, 1, length, 1, straight, 5.0 / 6.0, poisson);
      const double dt = b.state.clock.dt_previous = 1e-9, kappa = 0.3;
      for (std::size_t n = 0; n < 4; ++n) {
        const double x = b.model.nodes.x[n].x - 0.5 * length, y = b.model.nodes.x[n].y - 0.5;
        b.state.nodes.v[n] = {-kappa * x * y, 0.5 * kappa * (x * x + poisson * y * y), 0};
      }
      b.forces();
      b.look();
      EXPECT_NEAR(b.state.energy.internal, 0.5 * e_modulus * 0.1 / 12 * kappa * kappa * length * dt * dt, 1e-6 * b.state.energy.internal);
    }
  }
}

TEST(FullyIntegrated, ThinPlatesDoNotLock) {
  for (const double thickness : {1e-1, 1e-3}) {  // square plate over its whole width: bending energy of a cylinder, with one element
    Patch b(Kind::full, thickness, 1, 1, 1, 1, straight);
    const double dt = b.state.clock.dt_previous = 1e-9, kappa = 0.2;
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3& x = b.model.nodes.x[n];
      b.state.nodes.v[n] = {0, 0, -0.5 * kappa * x.x * x.x};
      b.state.nodes.omega[n] = {0, kappa * x.x, 0};
    }
    b.forces();
    b.look();
    const double d = e_modulus * std::pow(thickness, 3) / (12 * (1 - nu * nu));
    EXPECT_NEAR(b.state.energy.internal, 0.5 * d * kappa * kappa * dt * dt, 1e-6 * b.state.energy.internal);
  }
}

TEST(Membrane, HasNoBendingAndTheForcesOfThePlate) {
  for (const int elform : {5, 9}) {
    Patch b(Kind::membrane, 0.05, 3, 3, 3, 3, straight), plate(Kind::full, 0.05, 3, 3, 3, 3, straight);
    b.model.sections[0].shell.elform = elform;
    b.elements = std::make_unique<ElementSystem>(b.model, b.state, b.diagnostics);
    for (Bench* each : {static_cast<Bench*>(&b), static_cast<Bench*>(&plate)}) {
      each->state.clock.dt_previous = 1e-12;
      for (std::size_t n = 0; n < each->model.nodes.size(); ++n) {
        const Vec3& x = each->model.nodes.x[n];
        each->state.nodes.v[n] = {0.7 * x.x - 0.2 * x.y, 0.4 * x.x + 1.1 * x.y, 0};
        if (each == &b) each->state.nodes.omega[n] = {0.3 * x.x, -0.4 * x.y, 0};
      }
      each->forces();
    }
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      EXPECT_EQ(norm(b.state.nodes.moment[n]), 0) << elform;
      EXPECT_LT(norm(b.state.nodes.force[n] - plate.state.nodes.force[n]), 1e-9 * e_modulus * 1e-12 * 0.05) << elform;
    }
  }
}

std::uint64_t hash_after_cycles(Kind kind, int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Patch b(kind, 0.02, 31, 29, 3.1, 2.9, [](const Vec3& x) {
    return x + Vec3{0.02 * std::sin(9 * x.y), 0.02 * std::cos(7 * x.x), 0.1 * std::sin(x.x) * std::sin(x.y)};
  });
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(5 * x.y), std::sin(4 * x.x + x.y)} * 20.0;
  }
  for (int i = 0; i < 20; ++i) b.step(5e-6);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST_P(Formulation, ResultsDoNotDependOnThreadsOrInstructionSet) {
  const std::uint64_t one = hash_after_cycles(GetParam(), 1, 0);
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 2, 0));
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 2, 2));
  EXPECT_EQ(one, hash_after_cycles(GetParam(), 2, 3));
}

TEST(Formulation, TrianglesAndQuadrilateralsOfElform4AreToldApart) {
  Bench b;
  const PartIndex p = b.shell_part(0.05, density, e_modulus, nu);
  b.model.sections[0].shell.elform = 4;
  mesh(b, p, 1, 1, 1, 1, straight);
  b.start();
  ASSERT_EQ(b.diagnostics.error_count(), 1u);
  EXPECT_NE(b.diagnostics.all()[0].message.find("ELFORM = 4"), std::string::npos);
}

}  // namespace
}  // namespace kardan

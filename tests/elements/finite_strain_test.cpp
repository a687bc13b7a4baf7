#include <omp.h>

#include "elements/law_bench.hpp"
#include "kardan/base/isa.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::Cube;
using test::fields;
using test::size_of;

constexpr double g = 2.0;
FieldMaterial blatz_ko() { return fields(7, 0, 1e-3, {{"g", g}}); }

/// b of the cube, read from the stress of Blatz and Ko's law, which is linear in it: b = J sigma/G + J^(-2q) 1.
Mat3 left_cauchy_green(Cube& cube, const Mat3& f) {
  const double q = 0.463 / (1 - 2 * 0.463), j = determinant(f);
  return cube.stress() * (j / g) + Mat3::identity() * std::pow(j, -2 * q);
}

Mat3 diagonal(double x, double y, double z) { return {{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}}; }

Mat3 rotation(double angle) {
  const Mat3 k = skew(normalized(Vec3{2, -3, 1}));
  return Mat3::identity() + k * std::sin(angle) + k * k * (1 - std::cos(angle));
}

/// Largest relative error of b over a path F(s), 0 <= s <= 1, in equal steps.
template <class Path>
double error_of(Path path, int steps) {
  Cube cube(blatz_ko());
  double worst = 0;
  for (int i = 1; i <= steps; ++i) {
    const Mat3 f = path(static_cast<double>(i) / steps);
    cube.move(f, 1e-3);
    const Mat3 b = f * transpose(f);
    worst = std::max(worst, size_of(left_cauchy_green(cube, f) - b) / size_of(b));
  }
  return worst;
}

TEST(FiniteStrain, StretchWithoutRotationIsExactInAnyNumberOfSteps) {
  const auto uniaxial = [](double s) { return diagonal(1 + s, 1 / std::sqrt(1 + s), 1 / std::sqrt(1 + s)); };
  const auto biaxial = [](double s) { return diagonal(1 + s, 1 + s, 1 / ((1 + s) * (1 + s))); };
  for (const int steps : {1, 3, 1000}) {
    EXPECT_LT(error_of(uniaxial, steps), 1e-12) << steps;
    EXPECT_LT(error_of(biaxial, steps), 1e-12) << steps;
  }
}

/// With rotation the step is split into half of the rotation W, the stretch D and the other half (Strang 1968, SIAM J. Numer. Anal. 5,
/// 506-517). A step's error of F is [W,[W,D]]/24 + [D,[D,W]]/12 to third order, so that of b over a path of N steps is at most
/// 2 (w^2 d/6 + d^2 w/3)/N^2, w and d the largest rates along it.
TEST(FiniteStrain, ShearAndStretchWithRotationAreOfSecondOrder) {
  const auto shear = [](double s) { return Mat3{{{{1, s, 0}, {0, 1, 0}, {0, 0, 1}}}}; };
  const auto turning = [](double s) { return rotation(1.5 * s) * diagonal(1 + s, 1 / std::sqrt(1 + s), 1 / std::sqrt(1 + s)); };
  const auto check = [](auto path, double w, double d) {
    const double constant = 2 * (w * w * d / 6 + d * d * w / 3);
    const double coarse = error_of(path, 50), fine = error_of(path, 100);
    EXPECT_LT(coarse, constant / (50 * 50));
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);
  };
  check(shear, 0.5, 0.5);
  check(turning, 1.5, 1.0);
}

/// A stretched cube turned by 360 degrees keeps its stress in turned axes.
TEST(FiniteStrain, RigidRotationTurnsTheStress) {
  Cube cube(blatz_ko());
  const Mat3 u{{{{1.4, 0.2, 0.1}, {0.2, 0.8, -0.1}, {0.1, -0.1, 1.1}}}};
  cube.move(u, 1e-3);
  const Mat3 start = cube.stress();
  for (int i = 1; i <= 360; ++i) {
    const Mat3 q = rotation(2 * 3.14159265358979323846 * i / 360);
    cube.move(q * u, 1e-3);
    ASSERT_LT(size_of(cube.stress() - q * start * transpose(q)), 1e-11 * size_of(start)) << i;
  }
}

/// A unit shell in simple shear along `side` (0: the side 1-2, which the element's axes follow; 1: across it). Blatz and Ko's law keeps
/// the thickness: sigma_12 = G s, sigma_11 = G s^2, whichever way the element lies.
TEST(FiniteStrain, ShellInSimpleShearTurnsWithTheMaterial) {
  for (const std::size_t side : {0u, 1u}) {
    const auto error = [side](int steps) {
      Bench b;
      Section section;
      section.kind = ElementKind::shell;
      section.shell.thickness = {0.1, 0.1, 0.1, 0.1};
      Material material;
      material.law = blatz_ko();
      test::mesh(b, b.part(section, material), 1, 1, 1, 1, [](const Vec3& x) { return x; });
      b.start();
      EXPECT_TRUE(b.diagnostics.ok());
      const std::vector<Vec3> start = b.state.nodes.x;
      b.state.clock.dt_previous = 1e-3;
      for (int i = 1; i <= steps; ++i) {
        for (std::size_t n = 0; n < 4; ++n) {
          Vec3 x = start[n];
          x[side] += 1.0 * i / steps * start[n][1 - side];
          b.state.nodes.v[n] = (x - b.state.nodes.x[n]) / 1e-3;
          b.state.nodes.x[n] = x;
        }
        b.forces();
      }
      // Forces of the nodes on the far corner and beside it: sigma n times area, n of the sheared faces; the divergence theorem gives
      // sum f_a x_a^T = -V sigma.
      Mat3 sigma;
      for (std::size_t n = 0; n < 4; ++n) sigma += outer(b.state.nodes.force[n], b.state.nodes.x[n]) * (-1 / 0.1);
      Mat3 expected;
      expected[side][side] = g;
      expected[0].y = expected[1].x = g;
      return size_of(sigma - expected) / g;
    };
    const double coarse = error(20), fine = error(40);
    EXPECT_LT(fine, 2e-3) << side;
    EXPECT_NEAR(coarse / fine, 4.0, 0.4) << side;
  }
}

std::vector<FieldMaterial> rubbers() {
  return {blatz_ko(), fields(27, 0, 1e-3, {{"a", 0.8}, {"b", 0.2}, {"pr", 0.49}}),
          fields(77, 'H', 1e-3, {{"c10", 0.8}, {"c01", 0.2}, {"c20", 0.01}, {"pr", 0.49}, {"g1", 0.3}, {"beta1", 20}}),
          fields(77, 'O', 1e-3, {{"mu1", 0.8}, {"alpha1", 2.5}, {"pr", 0.49}, {"g1", 0.3}, {"beta1", 20}})};
}

/// A free block, stretched, bent and sheared by its own inertia at a fraction of the stable step: largest error of the energy.
double energy_error(const FieldMaterial& law, double fraction) {
  Bench b;
  b.model.control.hourglass_type = 4;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-300;
  test::block_of_cubes(b, test::solid_part(b, law), 4, 3, 3);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  double initial = 0, stored = 0, worst = 0, time = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{12 * std::sin(0.8 * (x.x - 2)), -6 * (x.y - 1.5), 4.5 * (x.x - 2)};
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  b.forces();
  const double dt = fraction * b.elements->stable_time_step();
  for (int i = 0; time < 0.4; ++i, time += dt) {
    EXPECT_LT(dt, b.elements->stable_time_step()) << "the stiffening has passed the step";
    const std::vector<Vec3> v = b.state.nodes.v;
    b.step(dt);
    double kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) kinetic += 0.5 * b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]);
    if (i < 2) continue;  // the first kick is half a step
    worst = std::max(worst, std::abs(kinetic + b.state.energy.internal + b.state.energy.hourglass - initial));
    stored = std::max(stored, b.state.energy.internal);
  }
  EXPECT_GT(stored, 0.3 * initial) << law.keyword;
  return worst / initial;
}

TEST(FiniteStrain, EnergyOfAFreeBlockIsKeptToTheSquareOfTheStep) {
  for (const FieldMaterial& law : rubbers()) {
    const double coarse = energy_error(law, 0.4), fine = energy_error(law, 0.2);
    EXPECT_LT(fine, 0.01) << law.keyword;
    EXPECT_GT(coarse / fine, 3.0) << law.keyword << ' ' << coarse << ' ' << fine;
  }
}

std::uint64_t hash_after_cycles(const FieldMaterial& law, int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  const PartIndex part = test::solid_part(b, law);
  test::block_of_cubes(b, part, 11, 7, 5);
  b.curve({0, 0.05, 0.6, 0.9}, {0.05, 0.2, 0.4, 5});  // of foams
  if (law.number == 9) {
    EquationOfState water;
    water.form = EquationOfState::Form::gruneisen;
    water.constants = {40, 1.9, 0, 0, 0.4, 0.1, 0};
    b.model.equations_of_state.push_back(water);
    b.model.parts[static_cast<std::size_t>(part)].equation_of_state = 0;
  }
  b.start();
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(5 * x.y), std::sin(4 * x.x + x.z)} * 3.0;
  }
  for (int i = 0; i < 20; ++i) b.step(1e-3);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST(FiniteStrain, ResultsDoNotDependOnThreadsOrInstructionSet) {
  std::vector<FieldMaterial> laws = rubbers();
  laws.push_back(fields(6, 0, 1e-3, {{"bulk", 5}, {"g0", 1}, {"gi", 0.2}, {"beta", 40}}));
  laws.push_back(fields(9, 0, 1e-3, {{"pc", -0.1}, {"mu", 1e-4}}));
  laws.push_back(fields(57, 0, 1e-3, {{"e", 3}, {"hu", 0.2}, {"shape", 3}, {"tc", 0.1}}));
  laws.push_back(fields(63, 0, 1e-3, {{"e", 5}, {"tsc", 0.1}}));
  for (FieldMaterial& law : laws) {
    law.curves["lcid"] = 0;
    const std::uint64_t one = hash_after_cycles(law, 1, 0);
    EXPECT_EQ(one, hash_after_cycles(law, 2, 0)) << law.keyword;
    EXPECT_EQ(one, hash_after_cycles(law, 2, 2)) << law.keyword;
    EXPECT_EQ(one, hash_after_cycles(law, 2, 3)) << law.keyword;
  }
}

}  // namespace
}  // namespace kardan

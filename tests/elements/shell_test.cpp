#include <omp.h>

#include <numbers>
#include <random>

#include "elements/bench.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/elements/shell/shell_forces.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::mesh;

constexpr double e_modulus = 210e9, density = 7800;

Vec3 distort(const Vec3& x) {
  return x + Vec3{0.13 * std::sin(2.1 * x.x + 1.3 * x.y), 0.11 * std::cos(1.7 * x.x - 2.3 * x.y), 0};
}

/// Boundary of the 3 x 3 patch used below.
bool inner(NodeIndex n) { return n % 4 != 0 && n % 4 != 3 && n / 4 != 0 && n / 4 != 3; }

double largest(const std::vector<Vec3>& f, bool of_inner) {
  double value = 0;
  for (std::size_t n = 0; n < f.size(); ++n) {
    if (inner(static_cast<NodeIndex>(n)) == of_inner) value = std::max(value, norm(f[n]));
  }
  return value;
}

class ShellPatch : public ::testing::TestWithParam<bool> {};

TEST_P(ShellPatch, MembraneStressIsUniformInADistortedPatch) {
  Bench b;
  mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 3, 3, 3, 3, distort, GetParam());
  b.model.control.hourglass_type = 4;
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = {0.7 * x.x - 0.2 * x.y, 0.4 * x.x + 1.1 * x.y, 0};
  }
  b.state.clock.dt_previous = 1e-12;  // the rates are what matters; nothing turns in this time
  b.forces();
  EXPECT_GT(largest(b.state.nodes.force, false), 0.0);
  EXPECT_LT(largest(b.state.nodes.force, true), 1e-10 * largest(b.state.nodes.force, false));
}

TEST_P(ShellPatch, MomentsAreUniformUnderLinearRotationsInADistortedPatch) {
  Bench b;
  const PartIndex p = b.shell_part(0.05, density, e_modulus, 0.3, 3, 0.0);  // without transverse shear
  mesh(b, p, 3, 3, 3, 3, distort, GetParam());
  b.model.control.hourglass_type = 4;
  b.start();
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.omega[n] = {0.7 * x.x - 0.2 * x.y, 0.4 * x.x + 1.1 * x.y, 0};
  }
  b.state.clock.dt_previous = 1e-12;
  b.forces();
  EXPECT_GT(largest(b.state.nodes.moment, false), 0.0);
  EXPECT_LT(largest(b.state.nodes.moment, true), 1e-10 * largest(b.state.nodes.moment, false));
}

INSTANTIATE_TEST_SUITE_P(QuadrilateralsAndTriangles, ShellPatch, ::testing::Bool());

TEST(Shell, RotationsOfARigidTiltGiveNoShearOnTrianglesAndQuadrilaterals) {
  Bench b;
  mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 3, 3, 3, 3, distort, true);
  b.model.control.hourglass_type = 4;
  b.start();
  const Vec3 w{0.3, -0.8, 0.5};
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    b.state.nodes.v[n] = cross(w, b.model.nodes.x[n]);
    b.state.nodes.omega[n] = w;
  }
  b.state.clock.dt_previous = 1e-12;
  b.forces();
  const double scale = e_modulus * 1e-12 * 0.05;  // of a unit strain rate
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    EXPECT_LT(norm(b.state.nodes.force[n]), 1e-10 * scale);
    EXPECT_LT(norm(b.state.nodes.moment[n]), 1e-10 * scale);
  }
}

TEST(Shell, PureBendingOfARectangularStripHasTheMomentOfThePlateAndNoShear) {
  Bench b;
  const double t = 0.05, kappa = 0.3;
  mesh(b, b.shell_part(t, density, e_modulus, 0.3, 2), 4, 1, 4, 1, [](const Vec3& x) { return x; });
  b.start();
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const double x = b.model.nodes.x[n].x;
    b.state.nodes.v[n] = {0, 0, -0.5 * kappa * x * x};
    b.state.nodes.omega[n] = {0, kappa * x, 0};
  }
  const double dt = b.state.clock.dt_previous = 1e-10;
  b.forces();
  const double moment = e_modulus * t * t * t / (12 * (1 - 0.09)) * kappa * dt;  // per width
  EXPECT_NEAR(b.state.nodes.moment[0].y, 0.5 * moment, 1e-9 * moment);
  EXPECT_NEAR(b.state.nodes.moment[4].y, -0.5 * moment, 1e-9 * moment);
  EXPECT_NEAR(b.state.nodes.moment[2].y, 0, 1e-9 * moment);
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) EXPECT_NEAR(b.state.nodes.force[n].z, 0, 1e-9 * moment);
}

TEST(Shell, RigidRotationCarriesTheStressAlongForManyTurns) {
  for (const int hourglass : {1, 4}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 1, 1, 1, 1,
         [](const Vec3& x) { return x + Vec3{0.1 * x.y, 0.05 * x.x, 0.2 * x.x * x.y}; });  // warped
    b.start();
    const double dt = b.state.clock.dt_previous = 1e-3;
    for (std::size_t n = 0; n < 4; ++n) b.state.nodes.v[n] = b.model.nodes.x[n] * 0.5;  // some stress to begin with
    b.forces();
    const std::vector<Vec3> f0 = b.state.nodes.force, m0 = b.state.nodes.moment;
    if (hourglass == 1) std::fill(b.state.nodes.v.begin(), b.state.nodes.v.end(), Vec3{});
    const Vec3 w{200, -300, 100};
    Quat turned;
    for (int i = 0; i < 200; ++i) {
      const Quat q = hughes_winget(w * dt);
      turned = normalized(q * turned);
      for (std::size_t n = 0; n < 4; ++n) {
        const Vec3 x = to_matrix(turned) * b.model.nodes.x[n];
        b.state.nodes.v[n] = (x - b.state.nodes.x[n]) / dt;
        b.state.nodes.omega[n] = w;
        b.state.nodes.x[n] = x;
      }
      b.forces();
    }
    for (std::size_t n = 0; n < 4; ++n) {
      // The viscous forces of the first step are gone; on this near-parallelogram they are small but not zero.
      const double tolerance = (hourglass == 1 ? 1e-3 : 1e-11) * norm(f0[0]);
      EXPECT_LT(norm(b.state.nodes.force[n] - to_matrix(turned) * f0[n]), tolerance) << hourglass;
      EXPECT_LT(norm(b.state.nodes.moment[n] - to_matrix(turned) * m0[n]), tolerance) << hourglass;
    }
  }
}

TEST(Shell, InternalForcesConserveLinearAndAngularMomentum) {
  for (const int hourglass : {1, 5}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 6, 5, 6, 5,
         [](const Vec3& x) { return distort(x) + Vec3{0, 0, 0.3 * std::sin(2 * x.x) * std::cos(3 * x.y)}; }, true);
    b.start();
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
}

TEST(Shell, StretchOfOneElementFollowsTheLogarithmicStrain) {
  const auto error = [](int steps) {
    Bench b;
    mesh(b, b.shell_part(0.1, density, e_modulus, 0.25), 1, 1, 2, 1, [](const Vec3& x) { return x; });
    b.start();
    const double dt = 1e-3 / steps;
    for (int i = 1; i <= steps; ++i) {
      b.state.clock.dt_previous = dt;
      for (std::size_t n = 0; n < 4; ++n) {
        const Vec3 x{b.model.nodes.x[n].x * (1 + 0.5 * i / steps), b.model.nodes.x[n].y, 0};
        b.state.nodes.v[n] = (x - b.state.nodes.x[n]) / dt;
        b.state.nodes.x[n] = x;
      }
      b.forces();
    }
    const double stress = e_modulus / (1 - 0.0625) * std::log(1.5);
    b.elements->account(b.model, b.state);
    // Force on the two nodes at x = 0: stress times thickness times width, half each.
    const double force_error = std::abs(b.state.nodes.force[0].x / (0.5 * stress * 0.1 * 1.0) - 1);
    // Work of the second Piola-like path: area grows as 1 + s, stress as its logarithm.
    const double work = e_modulus / (1 - 0.0625) * 2 * 0.1 * (1.5 * std::log(1.5) - 0.5);
    EXPECT_NEAR(b.state.energy.internal, work, 2.0 / (steps * steps) * work);
    return force_error;
  };
  const double coarse = error(10), fine = error(20);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);  // second order
}

TEST(Shell, StableStepIsLengthOverPlateWaveSpeed) {
  Bench b;  // without lateral contraction free edges change nothing
  const double c = std::sqrt(e_modulus / density);
  mesh(b, b.shell_part(0.1, density, e_modulus, 0.0, 2, 0.5), 2, 1, 2.4, 0.5,
       [](const Vec3& x) { return x.x < 1.3 ? x : Vec3{x.x - 0.2, x.y, 0}; });
  b.start();
  b.forces();
  EXPECT_NEAR(b.elements->stable_time_step(), 0.5 / c, 1e-12 / c);  // area / longest side
  EXPECT_EQ(b.elements->governing().kind, ElementKind::shell);
  b.model.control.time_step.isdo = 1;
  ElementSystem diagonals(b.model, b.state, b.diagnostics);
  diagonals.internal_forces(b.model, b.state);
  EXPECT_NEAR(diagonals.stable_time_step(), 0.5 / std::sqrt(1 + 0.25) / c, 1e-12 / c);
  EXPECT_EQ(diagonals.governing().element, 1001);
}

/// First bending frequency of a strip clamped at x = 0, from the zero crossings of its tip.
TEST(Shell, CantileverVibratesAtTheFrequencyOfTheBeamAndKeepsItsEnergy) {
  Bench b;
  const double length = 1.0, t = 0.02, width = 0.1;
  const int nx = 12;
  b.model.control.hourglass_type = 4;
  b.model.control.hourglass_qm = 0.05;
  mesh(b, b.shell_part(t, density, e_modulus, 0.0, 2, 5.0 / 6.0), nx, 1, length, width, [](const Vec3& x) { return x; });
  b.start();
  const double beta = 1.875104068711961 / length;
  const double frequency = beta * beta * std::sqrt(e_modulus * t * t / (12 * density)) / (2 * std::numbers::pi);
  const double k = (std::cos(beta * length) + std::cosh(beta * length)) / (std::sin(beta * length) + std::sinh(beta * length));
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const double s = beta * b.model.nodes.x[n].x;
    const double shape = std::cosh(s) - std::cos(s) - k * (std::sinh(s) - std::sin(s));
    const double slope = beta * (std::sinh(s) + std::sin(s) - k * (std::cosh(s) - std::cos(s)));
    b.state.nodes.v[n] = {0, 0, 0.1 * shape};
    b.state.nodes.omega[n] = {0, -0.1 * slope, 0};
  }
  b.forces();
  const double dt = 0.8 * b.elements->stable_time_step();
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    initial += 0.5 * (b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]) +
                      b.state.nodes.inertia[n] * dot(b.state.nodes.omega[n], b.state.nodes.omega[n]));
  }
  const auto clamp = [&] {
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      if (b.model.nodes.x[n].x == 0) b.state.nodes.v[n] = b.state.nodes.omega[n] = {};
    }
  };
  std::vector<double> crossings;
  double last = 0, worst = 0;
  const auto tip = static_cast<std::size_t>(nx);
  while (crossings.size() < 4) {
    const std::vector<Vec3> v = b.state.nodes.v, w = b.state.nodes.omega;
    b.step(dt, [] {}, clamp);
    double kinetic = 0;
    for (std::size_t n = 0; n < v.size(); ++n) {
      kinetic += 0.5 * (b.state.nodes.mass[n] * dot(v[n], b.state.nodes.v[n]) + b.state.nodes.inertia[n] * dot(w[n], b.state.nodes.omega[n]));
    }
    worst = std::max(worst, std::abs(kinetic + b.state.energy.internal + b.state.energy.hourglass - initial));
    const double z = b.state.nodes.x[tip].z;
    if (last * z < 0) crossings.push_back(b.state.clock.time - dt * z / (z - last));
    last = z;
    ASSERT_LT(b.state.clock.time, 3 / frequency);
  }
  const double measured = 0.5 * 3 / (crossings[3] - crossings[0]);
  EXPECT_NEAR(measured / frequency, 1.0, 0.02);
  EXPECT_LT(worst, 5e-3 * initial);
  EXPECT_LT(b.state.energy.hourglass, 0.02 * initial);
}

/// A dished, shaken plate of several tiles after some cycles.
std::uint64_t hash_after_cycles(int threads, int level) {
  set_kernel_level(level);
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Bench b;
  mesh(b, b.shell_part(0.02, density, e_modulus, 0.3, 3), 41, 37, 4.1, 3.7,
       [](const Vec3& x) { return x + Vec3{0.02 * std::sin(9 * x.y), 0.02 * std::cos(7 * x.x), 0.1 * std::sin(x.x) * std::sin(x.y)}; }, true);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    const Vec3& x = b.model.nodes.x[n];
    b.state.nodes.v[n] = Vec3{std::sin(3 * x.x), std::cos(5 * x.y), std::sin(4 * x.x + x.y)} * 20.0;
  }
  for (int i = 0; i < 20; ++i) b.step(5e-6);
  omp_set_num_threads(before);
  set_kernel_level(0);
  return b.state.registry.hash();
}

TEST(Shell, ResultsDoNotDependOnThreadsOrInstructionSet) {
  const std::uint64_t one = hash_after_cycles(1, 0);
  EXPECT_EQ(one, hash_after_cycles(2, 0));
  EXPECT_EQ(one, hash_after_cycles(3, 0));
  EXPECT_EQ(one, hash_after_cycles(2, 2));
  EXPECT_EQ(one, hash_after_cycles(2, 3));
}

TEST(Shell, HourglassModeIsDampedOrSprungBack) {
  for (const int hourglass : {1, 4}) {
    Bench b;
    b.model.control.hourglass_type = hourglass;
    mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 1, 1, 1, 1, [](const Vec3& x) { return x; });
    b.start();
    const double mode[] = {1, -1, -1, 1};  // nodes in the order of the mesh
    double initial = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      b.state.nodes.v[n] = {mode[n], 0, 0};
      initial += 0.5 * b.state.nodes.mass[n];
    }
    b.forces();
    const double dt = 0.5 * b.elements->stable_time_step();
    double peak = 0;
    for (int i = 0; i < 60; ++i) {
      b.step(dt);
      peak = std::max(peak, b.state.energy.hourglass);
    }
    EXPECT_NEAR(b.state.energy.internal, 0, 1e-6 * initial);
    EXPECT_NEAR(peak, initial, 0.03 * initial) << hourglass;
    if (hourglass == 1) {
      EXPECT_LT(std::abs(b.state.nodes.v[0].x), 1e-3);
    }
  }
}

TEST(Shell, BrokenShellIsNamedWithItsNodes) {
  Bench b;
  mesh(b, b.shell_part(0.05, density, e_modulus, 0.3), 2, 1, 2, 1, [](const Vec3& x) { return x; });
  b.start();
  b.state.nodes.x[2].x = std::nan("");
  try {
    b.forces();
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("shell 1001 of part 100"), std::string::npos) << error.what();
  }
}

TEST(Shell, RefusesOtherFormulationsByName) {
  Bench b;
  const PartIndex p = b.shell_part(0.05, density, e_modulus, 0.3);
  b.model.sections[0].shell.elform = 10;
  mesh(b, p, 1, 1, 1, 1, [](const Vec3& x) { return x; });
  b.start();
  ASSERT_EQ(b.diagnostics.error_count(), 1u);
  EXPECT_NE(b.diagnostics.all()[0].message.find("ELFORM = 10"), std::string::npos);
}

TEST(GaussRule, IntegratesPolynomialsExactly) {
  for (int n = 1; n <= 12; ++n) {
    double x[max_shell_points], w[max_shell_points];
    gauss_rule(n, x, w);
    for (int degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += w[i] * std::pow(x[i], degree);
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 1e-13) << n << " " << degree;
    }
  }
}

}  // namespace
}  // namespace kardan

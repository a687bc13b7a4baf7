// The stable step of elements with free sides: no loose piece of mesh may blow up at TSSFAC = 0.9, and the step of lone elements is sharp.
#include "kardan/elements/free_sides.hpp"

#include <random>

#include "elements/bench.hpp"

namespace kardan {
namespace {

using test::Bench;

constexpr double e_modulus = 210e9, density = 7800;
using Warp = Vec3 (*)(const Vec3&);

Vec3 straight(const Vec3& x) { return x; }
Vec3 long_shape(const Vec3& x) { return {2.7 * x.x, x.y, x.z}; }
Vec3 skew(const Vec3& x) { return {x.x + 0.5 * x.y, x.y + 0.2 * x.z, x.z}; }
Vec3 trapezoid(const Vec3& x) { return {x.x * (1 + 0.4 * x.y), x.y * (1 + 0.2 * x.z), x.z}; }

/// Peak of kinetic plus internal energy over that of the start, in the first and in the second half of the cycles.
struct Peaks {
  double first = 0, second = 0;
};

Peaks shake(Bench& b, int cycles, double scale) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  double initial = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    b.state.nodes.v[n] = vector() * 1e-6;  // so small that the shape stays
    if (b.state.nodes.inertia[n] > 0) b.state.nodes.omega[n] = vector() * 1e-6;
    initial += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]) +
               0.5 * b.state.nodes.inertia[n] * dot(b.state.nodes.omega[n], b.state.nodes.omega[n]);
  }
  b.forces();
  const double dt = scale * b.elements->stable_time_step();
  Peaks peaks;
  for (int i = 0; i < cycles; ++i) {
    b.step(dt);
    double energy = b.state.energy.internal;
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      energy += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]) +
                0.5 * b.state.nodes.inertia[n] * dot(b.state.nodes.omega[n], b.state.nodes.omega[n]);
    }
    double& peak = 2 * i < cycles ? peaks.first : peaks.second;
    peak = std::max(peak, energy / initial);
    if (!(energy < 1e6 * initial)) break;
  }
  return peaks;
}

void shells(Bench& b, int nx, int ny, Warp warp, double nu, double shrf, bool triangles = false, double thickness = 0.05) {
  b.model.control.hourglass_type = 4;
  test::mesh(b, b.shell_part(thickness, density, e_modulus, nu, 2, shrf), nx, ny, nx, ny, [=](const Vec3& x) { return warp(x) * 0.01; }, triangles);
  b.model.sections[0].shell.thickness.fill(0.01 * thickness);
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
}

void solids(Bench& b, int nx, int ny, int nz, Warp warp, double nu) {
  b.model.control.hourglass_type = 4;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-12;
  const PartIndex p = b.solid_part(density, e_modulus, nu);
  const auto at = [=](int i, int j, int k) { return static_cast<NodeIndex>((k * (ny + 1) + j) * (nx + 1) + i); };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) b.node(warp(Vec3{1.0 * i, 1.0 * j, 1.0 * k}) * 0.01);
    }
  }
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        b.solid(p, {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1),
                    at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
    }
  }
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
}

void expect_steady(Bench& b, int cycles, const std::string& what) {
  const Peaks peaks = shake(b, cycles, 0.9);
  EXPECT_LT(peaks.first, 12.0) << what;  // 1/(1 - 0.81) = 5.3 is what a mode at 0.9 of its limit swings to
  EXPECT_LT(peaks.second, 1.1 * peaks.first) << what;
}

TEST(FreeSides, LoosePiecesOfShellsKeepTheirEnergyAtTssfacOfNineTenths) {
  for (const Warp warp : {straight, long_shape, skew, trapezoid}) {
    for (const double nu : {0.0, 0.3, 0.45}) {
      for (const auto& [nx, ny] : {std::pair{1, 1}, {2, 1}, {5, 1}, {2, 2}, {4, 3}}) {
        for (const double shrf : {5.0 / 6.0, 1.0}) {
          Bench b;
          shells(b, nx, ny, warp, nu, shrf);
          expect_steady(b, nx * ny == 1 ? 10000 : 2000,
                        std::to_string(nx) + " x " + std::to_string(ny) + " nu " + std::to_string(nu) + " k " + std::to_string(shrf));
        }
      }
    }
  }
}

TEST(FreeSides, LooseTrianglesKeepTheirEnergyAtTssfacOfNineTenths) {
  for (const Warp warp : {straight, skew}) {
    for (const int count : {1, 2}) {
      Bench b;
      b.model.control.hourglass_type = 4;
      const PartIndex p = b.shell_part(5e-4, density, e_modulus, 0.3, 2, 5.0 / 6.0);
      for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) b.node(warp(x) * 0.01);
      b.shell(p, {0, 1, 2, 2});
      if (count == 2) b.shell(p, {0, 2, 3, 3});
      if (count == 1) b.mass(3, 1.0);
      b.start();
      expect_steady(b, 10000, std::to_string(count) + " triangles");
    }
  }
}

TEST(FreeSides, LoosePiecesOfSolidsKeepTheirEnergyAtTssfacOfNineTenths) {
  for (const Warp warp : {straight, long_shape, skew, trapezoid}) {
    for (const double nu : {0.0, 0.3, 0.45}) {
      for (const auto& [nx, ny, nz] : {std::array{1, 1, 1}, {2, 1, 1}, {6, 1, 1}, {3, 3, 1}, {2, 2, 2}}) {
        Bench b;
        solids(b, nx, ny, nz, warp, nu);
        expect_steady(b, nx * ny * nz == 1 ? 10000 : 2000, std::to_string(nx) + std::to_string(ny) + std::to_string(nz) + " nu " + std::to_string(nu));
      }
    }
  }
}

TEST(FreeSides, StepOfLoneElementsIsTheirLargestFrequency) {
  for (const Warp warp : {straight, skew}) {
    for (const bool solid : {false, true}) {
      for (const auto& [scale, stable] : {std::pair{0.995, true}, {1.005, false}}) {
        Bench b;
        if (solid) {
          solids(b, 1, 1, 1, warp, 0.3);
        } else {
          shells(b, 1, 1, warp, 0.3, 5.0 / 6.0);
        }
        const Peaks peaks = shake(b, 5000, scale);
        EXPECT_EQ(std::max(peaks.first, peaks.second) < 1e3, stable) << solid << " " << scale;
      }
    }
  }
}

TEST(FreeSides, SquaresAndCubesHaveTheStepOfTheirBreathing) {
  const double nu = 0.3, plate = std::sqrt(e_modulus / (density * (1 - nu * nu)));
  const double body = std::sqrt(e_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * density));
  const auto step = [](Bench& b) {
    b.forces();
    return b.elements->stable_time_step();
  };
  Bench square, plate3, cube, row, layer;
  shells(square, 1, 1, straight, nu, 5.0 / 6.0);
  EXPECT_NEAR(step(square), 0.01 / plate / std::sqrt(1 + nu), 1e-12 / plate);
  shells(plate3, 3, 3, straight, nu, 5.0 / 6.0);
  EXPECT_NEAR(step(plate3), 0.01 / plate, 1e-12 / plate);
  // lambda + 2 mu + 2 lambda and lambda + 2 mu + lambda over lambda + 2 mu.
  solids(cube, 1, 1, 1, straight, nu);
  EXPECT_NEAR(step(cube), 0.01 / body / std::sqrt((1 + nu) / (1 - nu)), 1e-9 / body);
  solids(layer, 3, 3, 1, straight, nu);
  EXPECT_GT(step(layer), 0.87 * 0.01 / body);  // its corners
  solids(row, 9, 1, 1, straight, nu);
  EXPECT_GT(step(row), 0.78 * 0.01 / body);
  EXPECT_LT(step(row), 0.84 * 0.01 / body);
}

}  // namespace
}  // namespace kardan

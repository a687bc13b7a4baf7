#include "kardan/materials/laws/plastic_plane_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/hardening_table.hpp"

namespace kardan {
namespace {

using KARDAN_ISA_NAMESPACE::Pack;
using Five = std::array<double, 5>;

PiecewisePlasticMaterial steel() {
  PiecewisePlasticMaterial m;
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.points = 8;
  m.strain = {0, 0.002, 0.01, 0.03, 0.08, 0.2, 0.5, 1.0};
  m.stress = {0.25, 0.30, 0.36, 0.42, 0.47, 0.52, 0.58, 0.60};
  return m;
}

PlasticPlaneStress law_of(const PiecewisePlasticMaterial& m, double shear_factor, const std::vector<double>& table) {
  PiecewisePlastic solid;
  solid.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  solid.rate_law = CowperSymonds::from(m.rate_constant, m.rate_exponent);
  solid.hardening = HardeningCurve(table);
  return PlasticPlaneStress::from(solid, shear_factor);
}

/// One point in lane 0 of a pack; the other lanes hold a point that is stretched elsewhere.
class Point {
 public:
  explicit Point(const PiecewisePlasticMaterial& m, double shear_factor = 1.0, std::vector<Curve> curves = {})
      : table_(hardening_table(m, curves)), law(law_of(m, shear_factor, table_)) {
    double start[2];
    law.start(start);
    std::fill_n(values_, block_lanes, start[0]);
    std::fill_n(values_ + block_lanes, block_lanes, start[1]);
  }
  void step(const Five& d, double dt = 1.0, double others = 0.01) {
    PlaneStress<Pack> increment{Pack(others), Pack(0.3 * others), Pack(-others), Pack(others), Pack(0.0)};
    Pack* const components[] = {&increment.xx, &increment.yy, &increment.xy, &increment.yz, &increment.zx};
    for (std::size_t i = 0; i < 5; ++i) components[i]->v[0] = d[i];
    law.update(stress_, increment, dt, values_);
  }
  Five stress() const { return {stress_.xx.v[0], stress_.yy.v[0], stress_.xy.v[0], stress_.yz.v[0], stress_.zx.v[0]}; }
  double mises() const {
    const auto [x, y, xy, yz, zx] = stress();
    return std::sqrt(x * x + y * y - x * y + 3 * (xy * xy + yz * yz + zx * zx));
  }
  double plastic_strain() const { return values_[0]; }
  double yield_stress() const { return values_[block_lanes]; }

 private:
  std::vector<double> table_;
  alignas(64) double values_[2 * block_lanes];
  PlaneStress<Pack> stress_{};

 public:
  PlasticPlaneStress law;
};

TEST(PlasticPlaneStress, FollowsTheOracleOfThreeDimensionalRadialReturnOnEveryPath) {
  std::ifstream file(std::string(KARDAN_SOURCE_DIR) + "/tests/oracles/j2_plane_stress.csv");
  ASSERT_TRUE(file);
  PiecewisePlasticMaterial line = steel();
  line.points = 0;
  line.yield_stress = 0.25;
  line.tangent_modulus = 2.0;
  PiecewisePlasticMaterial rated = steel();
  rated.rate_constant = 40;
  rated.rate_exponent = 5;
  std::string row, path;
  std::optional<Point> point;
  int rows = 0;
  double worst = 0;
  std::getline(file, row);
  while (std::getline(file, row)) {
    std::istringstream in(row);
    std::string name, law, rate, cell;
    std::getline(in, name, ',');
    std::getline(in, law, ',');
    std::getline(in, rate, ',');
    if (name != path) point.emplace(rate == "1" ? rated : law == "line" ? line : steel());
    path = name;
    std::array<double, 11> x{};
    for (double& value : x) {
      ASSERT_TRUE(std::getline(in, cell, ','));
      value = std::stod(cell);
    }
    point->step({x[0], x[1], x[2], x[3], x[4]}, 1e-3);
    const Five s = point->stress();
    for (std::size_t i = 0; i < 5; ++i) worst = std::max(worst, std::abs(s[i] - x[5 + i]) / 0.25);
    worst = std::max(worst, std::abs(point->plastic_strain() - x[10]));
    ASSERT_LT(worst, 1e-8) << row;
    ++rows;
  }
  EXPECT_GT(rows, 200);
  RecordProperty("worst", std::to_string(worst));
}

TEST(PlasticPlaneStress, HoldsTheYieldSurfaceAndDoesPositiveWorkOnRandomPaths) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1), decade(-5, -0.5);
  for (const double shear_factor : {1.0, 5.0 / 6.0, 0.1}) {
    Point point(steel(), shear_factor);
    const double e = 210, nu = 0.3, g = e / 2.6;
    int yielded = 0;
    for (int i = 0; i < 3000; ++i) {
      const double size = std::pow(10, decade(random)), before = point.plastic_strain();
      const Five d{size * uniform(random), size * uniform(random), size * uniform(random), size * uniform(random), size * uniform(random)};
      const Five old = point.stress();
      point.step(d);
      const Five s = point.stress();
      ASSERT_LE(point.mises(), point.yield_stress() * (1 + 1e-9));
      if (!(point.plastic_strain() > before)) {
        ASSERT_EQ(point.plastic_strain(), before);
        continue;
      }
      ++yielded;
      ASSERT_NEAR(point.mises() / point.yield_stress(), 1, 1e-9);
      // Plastic strain increment: the total one less the elastic one. Along the normal at the end, of the length dp.
      const Five plastic{d[0] - ((s[0] - old[0]) - nu * (s[1] - old[1])) / e, d[1] - ((s[1] - old[1]) - nu * (s[0] - old[0])) / e,
                         d[2] - (s[2] - old[2]) / g, d[3] - (s[3] - old[3]) / (shear_factor * g),
                         d[4] - (s[4] - old[4]) / (shear_factor * g)};
      const double f = (point.plastic_strain() - before) / point.mises();
      const Five normal{f * (s[0] - 0.5 * s[1]), f * (s[1] - 0.5 * s[0]), 3 * f * s[2], 3 * f * s[3], 3 * f * s[4]};
      double work = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        ASSERT_NEAR(plastic[k], normal[k], 1e-9 * size + 1e-14) << i << " " << k;
        work += s[k] * plastic[k];
      }
      ASSERT_GT(work, 0);
    }
    EXPECT_GT(yielded, 1000);
  }
}

TEST(PlasticPlaneStress, ElasticStepsHaveTheBitsOfMatElastic) {
  Point point(steel(), 5.0 / 6.0);
  const ElasticPlaneStress elastic = ElasticPlaneStress::from(Elastic::from(210, 0.3), 5.0 / 6.0);
  PlaneStress<Pack> s{};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);
  for (int i = 0; i < 20; ++i) {
    const Five d{uniform(random), uniform(random), uniform(random), uniform(random), uniform(random)};
    point.step(d);  // the other lanes yield
    elastic.add_increment(s, PlaneStress<Pack>{Pack(d[0]), Pack(d[1]), Pack(d[2]), Pack(d[3]), Pack(d[4])});
    EXPECT_EQ(point.stress(), (Five{s.xx.v[0], s.yy.v[0], s.xy.v[0], s.yz.v[0], s.zx.v[0]}));
  }
  EXPECT_EQ(point.plastic_strain(), 0.0);
}

TEST(PlasticPlaneStress, ALaneDoesNotFeelItsNeighbours) {
  Point alone(steel()), beside(steel());
  for (int i = 0; i < 60; ++i) {
    const Five d{2e-3 * std::sin(i), 1e-3 * std::cos(2 * i), 1e-3, 0, 1e-4};
    alone.step(d, 1.0, 0.0);
    beside.step(d, 1.0, 0.03 * std::sin(3 * i));
    ASSERT_EQ(alone.stress(), beside.stress()) << i;
    ASSERT_EQ(alone.plastic_strain(), beside.plastic_strain()) << i;
  }
  EXPECT_GT(alone.plastic_strain(), 0.01);
}

TEST(PlasticPlaneStress, ShearFollowsACurveOfManyPointsExactly) {
  PiecewisePlasticMaterial m = steel();
  m.points = 0;
  m.curve = 0;
  Curve curve;
  for (int i = 0; i < 57; ++i) {
    curve.x.push_back(0.013 * i);
    curve.y.push_back(0.3 + 0.4 * (1 - std::exp(-4 * 0.013 * i)));
  }
  Point point(m, 1.0, {curve});
  // Simple shear: the effective plastic strain is gamma_p / sqrt 3, the stress Y / sqrt 3, whatever the step.
  const double g = 210 / 2.6;
  double gamma = 0;
  for (int i = 0; i < 200; ++i) {
    point.step({0, 0, 0.004, 0, 0});
    gamma += 0.004;
    const double p = point.plastic_strain();
    const double yield = p < curve.x.back() ? curve.value(p) : curve.y.back() + (curve.y[56] - curve.y[55]) / 0.013 * (p - curve.x.back());
    ASSERT_NEAR(std::sqrt(3.0) * point.stress()[2], yield, 1e-12);
    ASSERT_NEAR(p, (gamma - point.stress()[2] / g) / std::sqrt(3.0), 1e-12);
  }
  for (int i = 0; i < 200; ++i) point.step({0, 0, 0.004, 0, 0});  // beyond the last point: its slope goes on
  const double p = point.plastic_strain();
  EXPECT_GT(p, 0.8);
  EXPECT_NEAR(point.yield_stress(), curve.y[56] + (curve.y[56] - curve.y[55]) / (curve.x[56] - curve.x[55]) * (p - curve.x[56]), 1e-12);
}

TEST(PlasticPlaneStress, TensionFollowsSigyAndEtan) {
  PiecewisePlasticMaterial m = steel();
  m.points = 0;
  m.yield_stress = 0.25;
  m.tangent_modulus = 5;
  Point point(m);
  for (int i = 0; i < 100; ++i) {
    // The lateral strain that keeps sigma_yy = 0, by secants on a copy.
    const auto trial = [&](double yy) {
      Point copy = point;
      copy.step({2e-4, yy, 0, 0, 0});
      return copy;
    };
    double a = -1e-4, b = -5e-5, fa = trial(a).stress()[1];
    for (int k = 0; k < 30 && a != b; ++k) {
      const double fb = trial(b).stress()[1];
      if (fb == fa) break;
      const double next = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb, b = next;
    }
    point.step({2e-4, b, 0, 0, 0});
    const double strain = 2e-4 * (i + 1), yield_strain = 0.25 / 210;
    const double expected = strain < yield_strain ? 210 * strain : 0.25 + 5 * (strain - yield_strain);
    ASSERT_NEAR(point.stress()[0], expected, 1e-9) << i;
  }
}

TEST(PlasticPlaneStress, RateFactorIsThatOfCowperAndSymonds) {
  for (const double exponent : {1.0, 2.0, 5.0, 8.3}) {
    for (const double rate : {1e-3, 1.0, 40.0, 1e5}) {
      PiecewisePlasticMaterial m = steel();
      m.points = 0;
      m.yield_stress = 0.25;
      m.rate_constant = 40;
      m.rate_exponent = exponent;
      Point point(m);
      const double gamma = 10, dt = gamma / std::sqrt(2.0) / rate;  // sqrt(2 (gamma/2)^2) / dt
      point.step({0, 0, gamma, 0, 0}, dt);
      EXPECT_NEAR(point.mises() / 0.25, 1 + std::pow(rate / 40, 1 / exponent), 1e-9 * (1 + std::pow(rate / 40, 1 / exponent)));
      EXPECT_NEAR(point.yield_stress(), 0.25, 1e-15);  // the static one
    }
  }
}

TEST(PlasticPlaneStress, ConvexHardeningAndHugeStepsConverge) {
  PiecewisePlasticMaterial m = steel();
  m.points = 5;
  m.strain = {0, 0.01, 0.02, 0.3, 0.31};
  m.stress = {0.2, 0.2, 0.7, 0.7, 1.1};  // flat, steep (just below E/4 more), flat, steep
  EXPECT_TRUE(PiecewisePlastic::computes(m, {}));
  for (double size = 1e-6; size < 3; size *= 1.1) {
    Point point(m, 5.0 / 6.0);
    point.step({size, -0.2 * size, 0.3 * size, 0.2 * size, 0});
    EXPECT_LE(point.mises(), point.yield_stress() * (1 + 1e-9)) << size;
    if (size > 0.01) {
      EXPECT_NEAR(point.mises() / point.yield_stress(), 1, 1e-9) << size;
    }
  }
}

TEST(SimdMath, LogarithmAndExponentialAreAccurate) {
  double worst_log = 0, worst_exp = 0;
  for (double x = 1e-200; x < 1e200; x *= 1.2345) {
    const double value = log(Pack(x)).v[0];
    worst_log = std::max(worst_log, std::abs(value - std::log(x)) / std::max(0.1, std::abs(std::log(x))));
    const double back = exp(Pack(std::log(x))).v[0];
    worst_exp = std::max(worst_exp, std::abs(back / std::exp(std::log(x)) - 1));
  }
  for (double x = 0.5; x < 2; x += 1e-4) worst_log = std::max(worst_log, std::abs(log(Pack(x)).v[0] - std::log(x)));
  EXPECT_LT(worst_log, 1e-15);
  EXPECT_LT(worst_exp, 1e-15);
  EXPECT_EQ(exp(Pack(0.0)).v[0], 1.0);
  EXPECT_EQ(log(Pack(1.0)).v[0], 0.0);
}

TEST(SimdMath, PowersAreAccurate) {
  for (const double exponent : {0.05, 0.26, 1.0, 1.03, 2.5}) {
    for (double x = 1e-12; x < 1e6; x *= 1.37) {
      const double expected = std::pow(x, exponent), size = 1 + std::abs(exponent * std::log(x));
      EXPECT_NEAR(pow(Pack(x), exponent).v[0] / expected, 1, 1e-15 * size) << x << " " << exponent;
    }
    EXPECT_EQ(pow(Pack(0.0), exponent).v[0], 0.0);
    EXPECT_EQ(pow(Pack(1.0), exponent).v[0], 1.0);
  }
}

}  // namespace
}  // namespace kardan

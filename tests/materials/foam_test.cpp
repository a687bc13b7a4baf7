#include <cmath>

#include "kardan/materials/laws/crushable_foam.hpp"
#include "kardan/materials/laws/low_density_foam.hpp"
#include "materials/law_probe.hpp"

namespace kardan {
namespace {

using test::expect_lanes_independent;
using test::LawProbe;

/// Nominal stress over compression of a soft foam: stiff, a plateau, locking.
Curve soft() {
  Curve c;
  c.x = {0, 0.05, 0.6, 0.8, 0.9};
  c.y = {0, 0.1, 0.15, 0.6, 3.0};
  return c;
}
const std::vector<double> soft_rows = CurveTable::rows_of(soft());

LowDensityFoam seat(double hu, double shape) {
  LowDensityFoam law;
  law.curve = CurveTable::from(soft_rows);
  law.youngs_modulus = law.steepest = 2;
  law.cutoff = 0.05;
  law.dissipated = 1 - hu;
  law.shape = shape;
  return law;
}

/// Brings the stretch along x from `from` to `to` in equal steps; f(stretch, nominal stress) after each.
template <class Law, class F>
void pull(LawProbe<Law>& point, double from, double to, int steps, F f) {
  for (int i = 1; i <= steps; ++i) {
    const double l0 = from + (to - from) * (i - 1) / steps, l1 = from + (to - from) * i / steps;
    point.step({2 * (l1 - l0) / (l1 + l0), 0, 0, 0, 0, 0}, l1);
    f(l1, point.stress().xx);
  }
}

TEST(CurveTable, ValueSlopeAndIntegral) {
  Curve c;
  c.x = {0.1, 0.3, 0.4};
  c.y = {1, 2, 5};
  const std::vector<double> rows = CurveTable::rows_of(c);
  const CurveTable table = CurveTable::from(rows);
  using test::Pack;
  const auto at = [&](double x) { return table.at(Pack(x)); };
  EXPECT_NEAR(at(0.2).y.v[0], 1.5, 1e-14);
  EXPECT_NEAR(at(0.0).y.v[0], 0.5, 1e-14);
  EXPECT_NEAR(at(0.5).y.v[0], 8, 1e-13);
  EXPECT_NEAR(at(0.0).integral.v[0], 0, 1e-15);
  EXPECT_NEAR(at(0.3).integral.v[0], 0.5 * (0.5 + 2) * 0.3, 1e-14);
  EXPECT_NEAR(at(0.4).integral.v[0], 0.375 + 0.35, 1e-14);
  EXPECT_NEAR(at(0.35).slope.v[0], 30, 1e-12);
}

/// Stress of a column without Poisson's effect is nominal stress: the curve itself in compression, E up to TC in tension.
TEST(LowDensityFoam, LoadingIsTheCurveAndTensionIsCutOff) {
  LawProbe<LowDensityFoam> point(seat(1, 1));
  const Curve curve = soft();
  pull(point, 1, 0.12, 500, [&](double l, double s) { ASSERT_NEAR(s, -curve.value(1 - l), 1e-12) << l; });
  pull(point, 0.12, 1, 333, [&](double l, double s) { ASSERT_NEAR(s, -curve.value(1 - l), 1e-12) << l; });
  pull(point, 1, 1.5, 100, [&](double l, double s) { ASSERT_NEAR(s, std::min(2 * (l - 1), 0.05), 1e-12) << l; });
  EXPECT_NEAR(point.stress().yy, 0, 1e-12);
}

/// Unloading from 0.3 by (1 - d); a loop dissipates what that formula says, and reloading returns to the curve.
TEST(LowDensityFoam, UnloadingLosesWhatHuAndShapeSay) {
  for (const double shape : {1.0, 4.0}) {
    const double hu = 0.2;
    LawProbe<LowDensityFoam> point(seat(hu, shape));
    const Curve curve = soft();
    const auto stored = [&](double l) { return curve.integral(1 - l); };
    pull(point, 1, 0.3, 100, [&](double l, double s) { ASSERT_NEAR(s, -curve.value(1 - l), 1e-12) << l; });
    EXPECT_NEAR(point.history(LowDensityFoam::largest_energy), stored(0.3), 1e-12);
    double stiffness = point.modulus(), before = point.stress().xx, last = 0.3;
    pull(point, 0.3, 0.95, 650, [&](double l, double s) {
      const double d = (1 - hu) * (1 - std::pow(stored(l) / stored(0.3), shape));
      ASSERT_NEAR(s, -(1 - d) * curve.value(1 - l), 1e-11) << l;
      // The time step knows how steep this is: tangent of the path against lambda^2 times it.
      EXPECT_LE((s - before) / (l - last) * last * last, std::max(stiffness, point.modulus()) * 1.01) << l;
      stiffness = point.modulus(), before = s, last = l;
    });
    pull(point, 0.95, 0.3, 10, [](double, double) {});
    EXPECT_NEAR(point.stress().xx, -curve.value(0.7), 1e-11);
  }
}

TEST(LowDensityFoam, LanesAreIndependent) {
  expect_lanes_independent(seat(1, 1), 0.02);
  expect_lanes_independent(seat(0.1, 3), 0.02);
}

Curve hard() {
  Curve c;
  c.x = {0, 0.5, 0.7, 0.8};
  c.y = {0.3, 0.5, 1.2, 4.0};
  return c;
}
const std::vector<double> hard_rows = CurveTable::rows_of(hard());
CrushableFoam crash_pad() {
  CrushableFoam law;
  law.curve = CurveTable::from(hard_rows);
  law.youngs_modulus = 20;
  law.cutoff = 0.1;
  return law;
}

/// Elastic, then the curve of the volume, elastic back to the tension cut-off, and the curve again from where it was left.
TEST(CrushableFoam, LoadingIsTheCurveAndUnloadingElastic) {
  LawProbe<CrushableFoam> point(crash_pad());
  const Curve curve = hard();
  pull(point, 1, 0.4, 2000, [&](double l, double s) {
    const double elastic = 20 * std::log(l);
    ASSERT_NEAR(s, std::max(elastic, -curve.value(1 - l)), 1e-5) << l;
    ASSERT_NEAR(s, l < 0.98 ? -curve.value(1 - l) : s, 1e-12) << l;
  });
  const double crushed = -curve.value(0.6);
  pull(point, 0.4, 0.45, 500, [&](double l, double s) { ASSERT_NEAR(s, std::min(crushed + 20 * std::log(l / 0.4), 0.1), 1e-5) << l; });
  EXPECT_DOUBLE_EQ(point.stress().xx, 0.1);
  pull(point, 0.45, 0.35, 500, [](double, double) {});
  EXPECT_NEAR(point.stress().xx, -curve.value(0.65), 1e-12);
}

TEST(CrushableFoam, LanesAreIndependent) { expect_lanes_independent(crash_pad(), 0.01); }

}  // namespace
}  // namespace kardan

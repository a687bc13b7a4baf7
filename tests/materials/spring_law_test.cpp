#include "kardan/materials/spring_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kardan {
namespace {

struct Law {
  SpringMaterial material;
  std::vector<Curve> curves;
  SpringHistory history;
  double time = 0, last = 0;

  Law(SpringLaw kind, std::array<double, 6> p) {
    material.law = kind;
    material.p = p;
  }
  Law& curve(std::size_t i, std::vector<double> x, std::vector<double> y) {
    material.curve[i] = static_cast<CurveIndex>(curves.size());
    curves.emplace_back();
    curves.back().x = std::move(x);
    curves.back().y = std::move(y);
    return *this;
  }
  /// Goes to elongation d in `steps` equal steps of dt.
  double to(double d, int steps = 1, double dt = 1e-3) {
    double f = 0;
    const double from = last;
    for (int i = 1; i <= steps; ++i) {
      const double next = from + (d - from) * i / steps;
      time += dt;
      f = spring_force(material, curves, next, (next - last) / dt, time, dt, history);
      last = next;
    }
    return f;
  }
};

TEST(SpringLaw, ElasticAndViscous) {
  EXPECT_DOUBLE_EQ(Law(SpringLaw::elastic_spring, {7}).to(0.5), 3.5);
  EXPECT_DOUBLE_EQ(Law(SpringLaw::viscous_damper, {7}).to(0.5, 1, 0.25), 14);
}

TEST(SpringLaw, ElastoplasticHardensIsotropically) {
  Law s(SpringLaw::elastoplastic_spring, {100, 20, 10});
  EXPECT_NEAR(s.to(0.05), 5, 1e-13);
  EXPECT_NEAR(s.to(0.2, 7), 10 + 20 * 0.1, 1e-12);           // yields at 0.1, then slope KT
  EXPECT_NEAR(s.to(0.1, 3), 12 - 100 * 0.1, 1e-12);          // unloads with K
  EXPECT_NEAR(s.to(0.2 - 0.24, 5), -12, 1e-12);              // yields in compression at -12: isotropic
  EXPECT_NEAR(s.to(0.2 - 0.34, 5), -12 - 20 * 0.1, 1e-12);
}

TEST(SpringLaw, NonlinearElasticIsItsCurveTimesTheRateFactor) {
  Law s(SpringLaw::nonlinear_elastic_spring, {});
  s.curve(0, {-1, 0, 1, 2}, {-4, 0, 1, 8}).curve(1, {-1000, 0, 1000}, {1, 1, 3});
  EXPECT_DOUBLE_EQ(s.to(1.5, 1, 1.5 / 500), 4.5 * 2);
  EXPECT_DOUBLE_EQ(s.to(-0.5, 1), -2);
}

TEST(SpringLaw, NonlinearDamperIsItsCurve) {
  Law s(SpringLaw::nonlinear_viscous_damper, {});
  s.curve(0, {-10, 0, 10}, {-5, 0, 50});
  EXPECT_DOUBLE_EQ(s.to(0.2, 1, 0.1), 10);
  EXPECT_DOUBLE_EQ(s.to(0.0, 1, 0.1), -1);
}

TEST(SpringLaw, GeneralNonlinearUnloadsAlongItsSecondCurve) {
  Law s(SpringLaw::general_nonlinear_spring, {});
  s.curve(0, {-2, 0, 1, 2}, {-10, 0, 10, 6}).curve(1, {-1, 0, 1}, {-50, 0, 50});
  EXPECT_NEAR(s.to(1.0, 10), 10, 1e-12);
  EXPECT_NEAR(s.to(1.5, 10), 8, 1e-12);                    // softening branch
  EXPECT_NEAR(s.to(1.4, 4), 8 - 50 * 0.1, 1e-12);          // slope of the unloading curve
  EXPECT_NEAR(s.to(1.34, 4), 0, 1e-12);
  EXPECT_NEAR(s.to(1.5, 3), 8, 1e-12);                     // back to where it left
  EXPECT_NEAR(s.to(1.34 - 0.5, 50), -2.5, 1e-12);          // compression yields on its own line, from the set of 1.34 on
}

TEST(SpringLaw, MaxwellFollowsTheConvolution) {
  const double k0 = 100, ki = 20, beta = 3, rate = 2;
  Law s(SpringLaw::maxwell_spring, {k0, ki, beta, 0, 0, 0});
  const double f = s.to(rate * 0.5, 5, 0.1);  // exact for a constant rate whatever the step
  EXPECT_NEAR(f, ki * rate * 0.5 + (k0 - ki) * rate * (1 - std::exp(-beta * 0.5)) / beta, 1e-11);
  const double relaxed = s.to(rate * 0.5, 3, 0.2);
  EXPECT_NEAR(relaxed, ki * 1.0 + (f - ki * 1.0) * std::exp(-beta * 0.6), 1e-11);
  Law cut(SpringLaw::maxwell_spring, {k0, ki, beta, 0.15, 33, 0});
  cut.to(0.1, 1, 0.1);
  EXPECT_DOUBLE_EQ(cut.to(0.2, 1, 0.1), 33);
}

TEST(SpringLaw, InelasticActsOnOneSideAndKeepsItsSet) {
  Law s(SpringLaw::inelastic_spring, {200, 1, 0, 0, 0, 0});  // compression only
  s.curve(0, {0, 1}, {0, 50});
  EXPECT_DOUBLE_EQ(s.to(0.3), 0);
  EXPECT_NEAR(s.to(-0.4, 5), -20, 1e-12);
  EXPECT_NEAR(s.to(-0.35, 5), -20 + 200 * 0.05, 1e-12);
  EXPECT_EQ(s.to(-0.25, 5), 0.0);
  EXPECT_NEAR(s.to(-0.4, 5), -20, 1e-12);
  Law t(SpringLaw::inelastic_spring, {200, -1, 0, 0, 0, 0});
  t.curve(0, {0, 1}, {0, 50});
  EXPECT_NEAR(t.to(0.4, 5), 20, 1e-12);
  EXPECT_EQ(t.to(-0.4, 5), 0.0);
}

TEST(SpringLaw, BoundsCoverTheSteepestTangent) {
  Law s(SpringLaw::nonlinear_elastic_spring, {});
  s.curve(0, {0, 1, 2}, {0, 1, 8}).curve(1, {0, 1}, {1, 3});
  const SpringBounds bounds = spring_bounds(s.material, s.curves);
  EXPECT_DOUBLE_EQ(bounds.stiffness, 7 * 3);
  EXPECT_DOUBLE_EQ(bounds.damping, 2 * 8);
}

}  // namespace
}  // namespace kardan

// Laws of three dimensions as laws of beams, against the equations of plasticity integrated in the three stresses of a beam.
#include "kardan/materials/beam_stress_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/laws/plastic_kinematic.hpp"
#include "kardan/materials/laws/power_plastic.hpp"
#include "materials/law_paths.hpp"

namespace kardan {
namespace {

using KARDAN_ISA_NAMESPACE::Pack;
using Triple = std::array<double, 3>;  // rr, rs, tr

constexpr double e_modulus = 200, nu = 0.3, shear = e_modulus / 2.6, sigma_y = 0.4, hardening = 5;

PlasticKinematic metal(double beta) {
  PlasticKinematic law;
  law.elastic = Elastic::from(e_modulus, nu);
  law.yield_stress = sigma_y;
  law.isotropic = beta * hardening;
  law.kinematic = (1 - beta) * hardening;
  return law;
}

/// A point whose lanes are all strained alike, or lane 0 only.
class Point {
 public:
  explicit Point(double beta) : law_{metal(beta)} { law_.start(values_); }
  void strain(const Triple& d, bool first_only = false) {
    BeamPoint<Pack> p;
    p.stress = stress_;
    const auto spread = [&](double value) {
      Pack pack(value);
      for (std::size_t l = 1; first_only && l < Pack::lanes; ++l) pack.v[l] = 0.3 * value * static_cast<double>(l % 3);
      return pack;
    };
    p.strain = {spread(d[0]), spread(d[1]), spread(d[2])};
    law_.update(p, StepTime{1, 0}, values_);
    stress_ = p.stress;
  }
  Triple stress() const { return {stress_.rr.v[0], stress_.rs.v[0], stress_.tr.v[0]}; }
  double plastic_strain() const { return values_[PlasticKinematic::plastic_strain * block_lanes]; }

 private:
  BeamStressOf<PlasticKinematic> law_;
  alignas(64) double values_[PlasticKinematic::history * block_lanes] = {};
  BeamStress<Pack> stress_;
};

/// Where the strains are along the path: a pull, then twist and shear while pulled, then back.
Triple path(double time) {
  const double pull = 0.01 * (time < 0.5 ? time * 2 : 2 - 2 * time), turn = 0.008 * std::max(0.0, time - 0.2), slide = 0.004 * time * time;
  return {pull, turn, slide};
}

/// Prandtl and Reuss in the stresses of a beam, isotropic hardening H: dp follows from the consistency of q^2 = s^2 + 3 t^2 + 3 u^2,
///   dp = (E s de + 3 G (t dg + u dh)) / (q H + (E s^2 + 9 G (t^2 + u^2))/q),   ds = E (de - dp s/q),  dt = G (dg - 3 dp t/q).
/// Heun's method in very small steps; a step on the surface is taken back to it by its own length only.
Triple integrate(int steps) {
  Triple s{};
  double yield = sigma_y;
  const auto rates = [](const Triple& x, const Triple& d, double& dp) {
    const double q = std::sqrt(x[0] * x[0] + 3 * (x[1] * x[1] + x[2] * x[2]));
    dp = std::max(0.0, (e_modulus * x[0] * d[0] + 3 * shear * (x[1] * d[1] + x[2] * d[2])) /
                           (q * hardening + (e_modulus * x[0] * x[0] + 9 * shear * (x[1] * x[1] + x[2] * x[2])) / q));
    return Triple{e_modulus * (d[0] - dp * x[0] / q), shear * (d[1] - 3 * dp * x[1] / q), shear * (d[2] - 3 * dp * x[2] / q)};
  };
  for (int i = 0; i < steps; ++i) {
    const Triple a = path(static_cast<double>(i) / steps), b = path(static_cast<double>(i + 1) / steps);
    const Triple d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Triple trial{s[0] + e_modulus * d[0], s[1] + shear * d[1], s[2] + shear * d[2]};
    const double q = std::sqrt(trial[0] * trial[0] + 3 * (trial[1] * trial[1] + trial[2] * trial[2]));
    if (q <= yield) {
      s = trial;
      continue;
    }
    double p1 = 0, p2 = 0;
    const Triple k1 = rates(s, d, p1);
    const Triple k2 = rates({s[0] + k1[0], s[1] + k1[1], s[2] + k1[2]}, d, p2);
    for (std::size_t c = 0; c < 3; ++c) s[c] += 0.5 * (k1[c] + k2[c]);
    yield += hardening * 0.5 * (p1 + p2);
  }
  return s;
}

Triple by_law(int steps, Point& point) {
  for (int i = 0; i < steps; ++i) {
    const Triple a = path(static_cast<double>(i) / steps), b = path(static_cast<double>(i + 1) / steps);
    point.strain({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
  }
  return point.stress();
}

TEST(BeamStress, TensionIsTheUniaxialCurveInOneStep) {
  Point p(1.0);
  p.strain({0.02, 0, 0});
  const double stress = (sigma_y * e_modulus + hardening * e_modulus * 0.02) / (e_modulus + hardening);
  EXPECT_NEAR(p.stress()[0], stress, 1e-9 * stress);
  EXPECT_NEAR(p.plastic_strain(), 0.02 - stress / e_modulus, 1e-11);
  Point k(0.0);  // kinematic: back by twice the yield stress, then plastic again
  k.strain({0.02, 0, 0});
  k.strain({-2 * sigma_y / e_modulus, 0, 0});
  EXPECT_NEAR(k.stress()[0], stress - 2 * sigma_y, 1e-8);
  k.strain({-0.01, 0, 0});
  const double slope = e_modulus * hardening / (e_modulus + hardening);
  EXPECT_NEAR(k.stress()[0], stress - 2 * sigma_y - 0.01 * slope, 1e-8);
}

TEST(BeamStress, ShearAloneYieldsAtTheRootOfThree) {
  Point p(1.0);
  p.strain({0, 0.03, 0});
  const double gamma_y = sigma_y / (std::sqrt(3.0) * shear), slope = shear * hardening / (3 * shear + hardening);
  const double stress = sigma_y / std::sqrt(3.0) + slope * (0.03 - gamma_y);
  EXPECT_NEAR(p.stress()[1], stress, 1e-9);
  EXPECT_NEAR(p.stress()[0], 0, 1e-12);
}

TEST(BeamStress, CombinedPathConvergesToTheEquationsAndStaysOnTheYieldSurface) {
  const Triple exact = integrate(400000);
  const auto error = [&](int steps) {
    Point p(1.0);
    const Triple s = by_law(steps, p);
    const double q = std::sqrt(s[0] * s[0] + 3 * (s[1] * s[1] + s[2] * s[2])), yield = sigma_y + hardening * p.plastic_strain();
    EXPECT_NEAR(q, yield, 1e-8 * yield);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += (s[c] - exact[c]) * (s[c] - exact[c]);
    return std::sqrt(sum) / sigma_y;
  };
  const double coarse = error(500), fine = error(4000);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / fine, 8, 1.5);  // backward Euler: of first order
}

/// Law 98 in steady viscoplastic flow (VP = 1), in tension and in shear: sigma = sqrt(3) tau = (A + B p^n)(1 + C log(dp/dt/EPS0)), and the
/// elastic part of the strain is sigma/E or tau/G.
TEST(BeamStress, RateDependentMetalFollowsItsCurve) {
  FieldMaterial m;
  m.number = 98;
  m.keyword = "*MAT_SIMPLIFIED_JOHNSON_COOK";
  m.density = 1, m.youngs_modulus = e_modulus, m.poissons_ratio = nu;
  m.values = {{"a", 0.3}, {"b", 0.4}, {"n", 0.26}, {"c", 0.05}, {"epso", 0.2}, {"vp", 1}, {"psfail", 1e17}, {"sigmax", 1e28}, {"sigsat", 1e28}};
  const Model model;
  std::vector<std::shared_ptr<std::vector<double>>> kept;
  const BeamStressOf<PowerPlastic> law{law_paths::made<PowerPlastic>(m, model, kept)};
  for (const bool sheared : {false, true}) {
    alignas(64) double values[PowerPlastic::history * block_lanes] = {};
    BeamStress<Pack> stress;
    double plastic = 0;
    for (int i = 0; i < 50; ++i) {
      BeamPoint<Pack> p;
      p.stress = stress;
      (sheared ? p.strain.rs : p.strain.rr) = Pack(1e-3);
      law.update(p, StepTime{1e-3, 0}, values);
      stress = p.stress;
      const double now = values[PowerPlastic::plastic_strain * block_lanes], rate = (now - plastic) / 1e-3;
      plastic = now;
      if (i < 5) continue;
      const double yield = (0.3 + 0.4 * std::pow(now, 0.26)) * (1 + 0.05 * std::log(rate / 0.2));
      const double effective = sheared ? std::sqrt(3.0) * stress.rs.v[0] : stress.rr.v[0];
      ASSERT_NEAR(effective, yield, 1e-9);
      const double total = 1e-3 * (i + 1);
      ASSERT_NEAR(now, sheared ? (total - stress.rs.v[0] / shear) / std::sqrt(3.0) : total - effective / e_modulus, 1e-9);
    }
  }
}

TEST(BeamStress, ALaneGetsWhatItWouldGetAlone) {
  Point alone(0.5), beside(0.5);
  for (int i = 0; i < 40; ++i) {
    const Triple d{0.001 * std::cos(i), 0.0008 * std::sin(2 * i), 0.0005};
    alone.strain(d);
    beside.strain(d, true);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(alone.stress()[c], beside.stress()[c]);
  }
}

}  // namespace
}  // namespace kardan

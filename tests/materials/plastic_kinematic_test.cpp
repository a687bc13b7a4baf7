#include "kardan/materials/laws/plastic_kinematic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/plane_stress_of.hpp"

namespace kardan {
namespace {

using KARDAN_ISA_NAMESPACE::Pack;

constexpr double e_modulus = 200, nu = 0.3, sigma_y = 0.4, tangent = 20;

PlasticKinematic metal(double beta) {
  const double plastic_modulus = e_modulus * tangent / (e_modulus - tangent);
  PlasticKinematic law;
  law.elastic = Elastic::from(e_modulus, nu);
  law.yield_stress = sigma_y;
  law.isotropic = beta * plastic_modulus;
  law.kinematic = (1 - beta) * plastic_modulus;
  return law;
}

/// Pulled along x in small steps with free sides: plane stress does the thickness, the width is iterated here.
class Bar {
 public:
  explicit Bar(double beta) : law_{metal(beta), 1.0} { law_.start(values_); }
  void pull(double strain) {
    double width = -0.5 * strain, residual = 0;
    for (int i = 0; i < 60; ++i) {
      double trial[history * block_lanes];
      std::copy_n(values_, history * block_lanes, trial);
      point_ = attempt(strain, width, trial);
      residual = point_.stress.yy.v[0];
      if (std::abs(residual) < 1e-14) break;
      width -= residual / e_modulus;
    }
    point_ = attempt(strain, width, values_);
    stress_ = point_.stress;
  }
  double stress() const { return stress_.xx.v[0]; }
  double plastic_strain() const { return values_[PlasticKinematic::plastic_strain * block_lanes]; }

 private:
  static constexpr std::size_t history = PlasticKinematic::history;
  ShellPoint<Pack> attempt(double strain, double width, double* values) const {
    ShellPoint<Pack> p;
    p.stress = stress_;
    p.strain.xx = Pack(strain);
    p.strain.yy = Pack(width);
    law_.update(p, StepTime{1, 0}, values);
    return p;
  }
  PlaneStressOf<PlasticKinematic> law_;
  alignas(64) double values_[history * block_lanes] = {};
  PlaneStress<Pack> stress_;
  ShellPoint<Pack> point_;
};

/// Pulled to yield, beyond, and back: the bilinear law is a closed form. Width of the elastic range: 2 Y isotropic, 2 sigma_y kinematic.
TEST(PlasticKinematic, BarFollowsTheBilinearLawAndYieldsBackAsBetaSays) {
  for (const double beta : {0.0, 0.4, 1.0}) {
    Bar bar(beta);
    const double step = 1e-5, yield_strain = sigma_y / e_modulus;
    double strain = 0;
    while (strain < 0.02) {
      bar.pull(step);
      strain += step;
      const double expected = strain < yield_strain ? e_modulus * strain : sigma_y + tangent * (strain - yield_strain);
      ASSERT_NEAR(bar.stress(), expected, 1e-6 * expected) << strain;
    }
    const double top = bar.stress(), p = bar.plastic_strain(), turn = strain;
    EXPECT_NEAR(p, strain - top / e_modulus, 1e-8);
    const double range = 2 * sigma_y + 2 * beta * (top - sigma_y), back_yield = top - range;
    while (strain > turn - range / e_modulus - 0.01) {
      bar.pull(-step);
      strain -= step;
      const double elastic = top - e_modulus * (turn - strain);
      const double expected = elastic > back_yield ? elastic : back_yield - tangent * (turn - range / e_modulus - strain);
      ASSERT_NEAR(bar.stress(), expected, 1e-6 * top) << strain;
    }
  }
}

/// Simple shear at a constant rate, VP = 1: q = f (sigma_y + beta E_p p) + (1 - beta) E_p p with f of the rate of p, which tends to
/// gamma_rate/sqrt 3. At every step the stress is the one of the step's own plastic increment, in closed form.
TEST(PlasticKinematic, ViscoplasticShearIsAsFastAsItsOwnPlasticStrain) {
  for (const double beta : {0.0, 0.4, 1.0}) {
    PlasticKinematic law = metal(beta);
    law.rate_law = CowperSymonds::from(40, 5);
    law.viscoplastic = true;
    alignas(64) double values[PlasticKinematic::history * block_lanes] = {};
    const double* const strain = values + PlasticKinematic::plastic_strain * block_lanes;
    MaterialPoint<Pack> p;
    const double dt = 1e-3, plastic_modulus = law.isotropic + law.kinematic;
    for (int i = 0; i < 400; ++i) {
      const double before = *strain;
      p.strain = {};
      p.strain.xy = Pack(0.5 * (i < 200 ? 1e-4 : 5e-3));
      law.update(p, StepTime{dt, i * dt}, values);
      const double dp = *strain - before;
      if (dp == 0) continue;
      const double factor = 1 + std::pow(dp / dt / 40, 0.2);
      const double expected = factor * (sigma_y + beta * plastic_modulus * *strain) + (1 - beta) * plastic_modulus * *strain;
      ASSERT_NEAR(std::sqrt(3.0) * p.stress.xy.v[0], expected, 1e-10 * expected) << i;
      if (i == 199 || i == 399) {  // steady: dq = 3 mu (dgamma/sqrt 3 - dp) = (f beta + 1 - beta) E_p dp
        const double stiffness = 3 * law.elastic.shear(), hardening = factor * law.isotropic + law.kinematic;
        EXPECT_NEAR(dp * (stiffness + hardening) / ((i < 200 ? 1e-4 : 5e-3) / std::sqrt(3.0) * stiffness), 1, 1e-4) << i;
      }
    }
    EXPECT_GT(*strain, 0.5);
  }
}

TEST(PlasticKinematic, FailsWhereThePlasticStrainReachesFs) {
  PlasticKinematic law = metal(1);
  law.failure_strain = 0.01;
  alignas(64) double values[PlasticKinematic::history * block_lanes] = {};
  MaterialPoint<Pack> p;
  double failed_at = 0;
  for (int i = 0; i < 200 && failed_at == 0; ++i) {
    p.strain = {};
    p.strain.xy = Pack(1e-4);
    law.update(p, StepTime{1, 0}, values);
    if (p.failed.v[0] > 0) failed_at = values[PlasticKinematic::plastic_strain * block_lanes];
  }
  EXPECT_GE(failed_at, 0.01);
  EXPECT_LT(failed_at, 0.01 + 2e-4);
}

}  // namespace
}  // namespace kardan

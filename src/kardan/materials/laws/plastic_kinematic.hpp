// *MAT_PLASTIC_KINEMATIC (003), on a number type R: von Mises' yield condition with linear hardening, from isotropic (BETA = 1) to
// kinematic (BETA = 0).
//
// Source: Krieg and Key 1976, in Constitutive Equations in Viscoplasticity, ASME AMD 20, 125-137; Hallquist, LS-DYNA Theory Manual 2006,
// Material Model 3. With the back stress alpha, xi = s_trial - alpha, q = sqrt(3/2 xi:xi), E_p = E E_t/(E - E_t),
//   Y = f (sigma_y + beta E_p p),   f = 1 + (rate/C)^(1/P)                       yield stress and Cowper and Symonds' factor
//   dp = (q - Y)/(3 mu + (1 - beta) E_p + f beta E_p)                            effective plastic strain
//   s = s_trial - 3 mu dp xi/q,   d alpha = (1 - beta) E_p dp xi/q.
// Backward Euler, exact for linear hardening and a constant direction. VP = 0: the rate is sqrt(e_ij e_ij) of the total strain over the
// step. VP = 1: it is dp/dt, and the equation for dp is solved by bracketed_root.hpp. A point fails when p reaches FS.
#pragma once

#include <cstddef>
#include <optional>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/bracketed_root.hpp"
#include "kardan/materials/hardening.hpp"
#include "kardan/materials/laws/elastic.hpp"

namespace kardan {

/// A point keeps its back stress (deviator) and its effective plastic strain.
struct PlasticKinematic {
  static constexpr std::size_t history = 7, tensors = 1, plastic_strain = 6;

  Elastic elastic;
  double yield_stress = 0, isotropic = 0, kinematic = 0;  ///< sigma_y, beta E_p, (1 - beta) E_p
  CowperSymonds rate_law;
  bool viscoplastic = false;  ///< VP = 1 with a rate effect
  double failure_strain = 0;  ///< FS; 0 = none

  /// From *MAT_PLASTIC_KINEMATIC; complains where it cannot be computed.
  static std::optional<PlasticKinematic> make(LawSource& source);

  double longitudinal() const { return elastic.longitudinal(); }
  double shear() const { return elastic.shear(); }
  bool can_fail() const { return failure_strain > 0; }
  void start(double* values) const {
    for (std::size_t i = 0; i < history; ++i) values[i] = 0;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    SymmetricTensor<R>& s = p.stress;
    elastic.add_increment(s, p.strain);
    const SymmetricTensor<R> back = load_tensor<R>(values);
    const R kept = R::load(values + plastic_strain * block_lanes), mean = (s.xx + s.yy + s.zz) * R(1.0 / 3.0);
    const SymmetricTensor<R> xi{s.xx - mean - back.xx, s.yy - mean - back.yy, s.zz - mean - back.zz,
                                s.xy - back.xy,        s.yz - back.yz,        s.zx - back.zx};
    const R square = R(1.5) * contraction(xi, xi);
    R rate(1.0), zero(0.0);
    if (rate_law.active() && !viscoplastic) rate = rate_law.factor(contraction(p.strain, p.strain), t.dt);
    const R yield = rate * (R(yield_stress) + R(isotropic) * kept);
    const auto plastic = square > yield * yield;
    R strain = kept;
    if (R::any(plastic)) {
      const R q = select(plastic, sqrt(square), R(1.0));
      R increment = select(plastic, (q - yield) / (R(3.0 * elastic.shear() + kinematic) + rate * R(isotropic)), zero);
      if (viscoplastic) increment = viscoplastic_increment(q, kept, t.dt, increment, plastic);
      const R away = R(3.0 * elastic.shear()) * increment / q, shift = R(kinematic) * increment / q;
      s = {s.xx - away * xi.xx, s.yy - away * xi.yy, s.zz - away * xi.zz, s.xy - away * xi.xy, s.yz - away * xi.yz, s.zx - away * xi.zx};
      store_tensor(SymmetricTensor<R>{back.xx + shift * xi.xx, back.yy + shift * xi.yy, back.zz + shift * xi.zz, back.xy + shift * xi.xy,
                                      back.yz + shift * xi.yz, back.zx + shift * xi.zx},
                   values);
      strain = kept + increment;
      strain.store(values + plastic_strain * block_lanes);
    }
    if (failure_strain > 0) p.failed = select(strain < R(failure_strain), zero, R(1.0));
  }

 private:
  /// q - (3 mu + (1 - beta) E_p) dp = f(dp/dt) (sigma_y + beta E_p (p + dp)).
  template <class R, class Mask>
  [[gnu::always_inline]] R viscoplastic_increment(const R& q, const R& kept, double dt, const R& most, const Mask& plastic) const {
    const R stiffness(3.0 * elastic.shear() + kinematic), per_time(dt > 0 ? 1 / dt : 0.0), one(1.0);
    return bracketed_root(most, q / stiffness, plastic, 1e-13, [&](const R& dp) {
      const R rate = dp * per_time, factor = rate_law.factor_of_rate(rate), still = R(yield_stress) + R(isotropic) * (kept + dp);
      const R factor_slope = (factor - one) * R(rate_law.power) / max(dp, R(1e-300));
      return ValueAndSlope<R>{(factor * still + stiffness * dp) / q - one, (factor_slope * still + factor * R(isotropic) + stiffness) / q};
    });
  }
};

}  // namespace kardan

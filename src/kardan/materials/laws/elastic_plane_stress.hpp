// *MAT_ELASTIC (001) in plane stress, on a number type R.
//
// Hooke's law in rate form in the axes that turn with the element:
//   d sigma_xx = E/(1-nu^2) (d eps_xx + nu d eps_yy),  d sigma_yy = E/(1-nu^2) (nu d eps_xx + d eps_yy),
//   d sigma_xy = G d gamma_xy,  d sigma_yz = k G d gamma_yz,  d sigma_zx = k G d gamma_zx,   G = E/(2 (1+nu)),
// k the shear correction factor (SHRF). Stresses [force/length^2], engineering shear strains.
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 1 with the plane stress condition of shells.
#pragma once

#include <cstddef>

#include "kardan/materials/laws/elastic.hpp"

namespace kardan {

/// Constants of the law, ready for the kernel.
struct ElasticPlaneStress {
  static constexpr std::size_t history = 0;

  double c11 = 0, c12 = 0;   ///< E/(1-nu^2), nu E/(1-nu^2)
  double shear = 0;          ///< G
  double transverse = 0;     ///< k G
  double thinning = 0;       ///< nu/E: strain normal to the plane is -(nu/E) d(sigma_xx + sigma_yy)

  static ElasticPlaneStress from(const Elastic& m, double shear_factor) {
    const double g = m.shear(), nu = m.lambda / (2 * (m.lambda + g));
    return from(2 * g * (1 + nu), nu, shear_factor);
  }
  static ElasticPlaneStress from(double youngs_modulus, double poissons_ratio, double shear_factor) {
    const double plate = youngs_modulus / (1 - poissons_ratio * poissons_ratio);
    const double g = youngs_modulus / (2 * (1 + poissons_ratio));
    return {plate, poissons_ratio * plate, g, shear_factor * g, poissons_ratio / youngs_modulus};
  }

  void start(double*) const {}

  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime&, double*) const {
    const R sum = p.stress.xx + p.stress.yy;
    add_increment(p.stress, p.strain);
    p.thickness_strain = R(-thinning) * (p.stress.xx + p.stress.yy - sum);
  }
  /// The elastic (trial) stress.
  template <class R>
  [[gnu::always_inline]] void add_increment(PlaneStress<R>& s, const PlaneStress<R>& d) const {
    s.xx += c11 * d.xx + c12 * d.yy;
    s.yy += c12 * d.xx + c11 * d.yy;
    s.xy += shear * d.xy;
    s.yz += transverse * d.yz;
    s.zx += transverse * d.zx;
  }
};

}  // namespace kardan

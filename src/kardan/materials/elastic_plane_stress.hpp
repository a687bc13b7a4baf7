// *MAT_ELASTIC (001) in plane stress, on a number type R.
//
// Hooke's law in rate form in the axes that turn with the element:
//   d sigma_xx = E/(1-nu^2) (d eps_xx + nu d eps_yy),  d sigma_yy = E/(1-nu^2) (nu d eps_xx + d eps_yy),
//   d sigma_xy = G d gamma_xy,  d sigma_yz = k G d gamma_yz,  d sigma_zx = k G d gamma_zx,   G = E/(2 (1+nu)),
// k the shear correction factor (SHRF). Stresses [force/length^2], engineering shear strains.
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 1 with the plane stress condition of shells.
#pragma once

#include <cstddef>

#include "kardan/materials/plane_stress.hpp"

namespace kardan {

/// Constants of the law, ready for the kernel.
struct ElasticPlaneStress {
  static constexpr std::size_t history = 0;

  double c11 = 0, c12 = 0;   ///< E/(1-nu^2), nu E/(1-nu^2)
  double shear = 0;          ///< G
  double transverse = 0;     ///< k G

  static ElasticPlaneStress from(double youngs_modulus, double poissons_ratio, double shear_factor) {
    const double plate = youngs_modulus / (1 - poissons_ratio * poissons_ratio);
    const double g = youngs_modulus / (2 * (1 + poissons_ratio));
    return {plate, poissons_ratio * plate, g, shear_factor * g};
  }

  void start(double*) const {}

  template <class R>
  [[gnu::always_inline]] void update(PlaneStress<R>& s, const PlaneStress<R>& d, double, double*) const {
    s.xx += c11 * d.xx + c12 * d.yy;
    s.yy += c12 * d.xx + c11 * d.yy;
    s.xy += shear * d.xy;
    s.yz += transverse * d.yz;
    s.zx += transverse * d.zx;
  }
};

}  // namespace kardan

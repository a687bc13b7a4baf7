// *MAT_ELASTIC (001) in three dimensions, on a number type R.
//
// Hooke's law in rate form in axes that turn with the material:
//   d sigma_ij = lambda d eps_kk delta_ij + 2 mu d eps_ij,   lambda = nu E/((1+nu)(1-2nu)),   mu = E/(2 (1+nu)).
// Stresses [force/length^2]; shear strains are entries of the tensor, half the engineering strain.
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 1.
#pragma once

#include <cstddef>
#include <optional>

#include "kardan/materials/point.hpp"

namespace kardan {

struct LawSource;

/// Constants of the law, ready for the kernel.
struct Elastic {
  static constexpr std::size_t history = 0, tensors = 0;

  double lambda = 0, two_mu = 0;

  static Elastic from(double youngs_modulus, double poissons_ratio) {
    const double nu = poissons_ratio;
    return {nu * youngs_modulus / ((1 + nu) * (1 - 2 * nu)), youngs_modulus / (1 + nu)};
  }
  /// From *MAT_ELASTIC; complains where it cannot be computed.
  static std::optional<Elastic> make(LawSource& source);
  /// Modulus of the dilatational wave, lambda + 2 mu.
  double longitudinal() const { return lambda + two_mu; }
  double shear() const { return 0.5 * two_mu; }
  void start(double*) const {}

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double*) const {
    add_increment(p.stress, p.strain);
  }
  /// The elastic (trial) stress.
  template <class R>
  [[gnu::always_inline]] void add_increment(SymmetricTensor<R>& s, const SymmetricTensor<R>& d) const {
    const R mean = lambda * (d.xx + d.yy + d.zz);
    s.xx += mean + two_mu * d.xx;
    s.yy += mean + two_mu * d.yy;
    s.zz += mean + two_mu * d.zz;
    s.xy += two_mu * d.xy;
    s.yz += two_mu * d.yz;
    s.zx += two_mu * d.zx;
  }
};

}  // namespace kardan

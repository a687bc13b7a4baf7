// *MAT_CRUSHABLE_FOAM (063), on a number type R: crushes at a yield stress of its volume, unloads elastically.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 63: sigma_trial = sigma + E de (no Poisson's effect); a principal stress
// below -Y(1 - V/V0), Y the curve LCID, is brought to it, one above TSC to that. Stresses [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/curve_table.hpp"
#include "kardan/materials/finite_strain.hpp"
#include "kardan/materials/principal.hpp"

namespace kardan {

struct LawSource;

struct CrushableFoam {
  static constexpr std::size_t history = 0, tensors = 0;

  CurveTable curve;
  double youngs_modulus = 0, cutoff = 0;  ///< E, TSC

  /// From *MAT_CRUSHABLE_FOAM; complains where it cannot be computed.
  static std::optional<CrushableFoam> make(LawSource& source);
  double longitudinal() const { return youngs_modulus; }
  double shear() const { return 0.5 * youngs_modulus; }
  void start(double*) const {}

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double*) const {
    const SymmetricTensor<R>&s = p.stress, &d = p.strain;
    const R e(youngs_modulus);
    const Principal<R> main = principal(SymmetricTensor<R>{s.xx + e * d.xx, s.yy + e * d.yy, s.zz + e * d.zz,
                                                           s.xy + e * d.xy, s.yz + e * d.yz, s.zx + e * d.zx});
    const R yield = max(curve.at(R(1.0) - p.volume).y, R(0.0));
    const R sigma[3] = {min(max(main.value[0], -yield), R(cutoff)), min(max(main.value[1], -yield), R(cutoff)),
                        min(max(main.value[2], -yield), R(cutoff))};
    p.stress = main.assemble(sigma);
    p.modulus = e * max(p.volume, R(1.0));
  }
};

}  // namespace kardan

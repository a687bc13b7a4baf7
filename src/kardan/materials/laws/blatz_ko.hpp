// *MAT_BLATZ-KO_RUBBER (007), on a number type R: a compressible rubber with one constant.
//
// Source: Blatz and Ko 1962, Trans. Soc. Rheol. 6, 223-251, their solid rubber:
//   W = G/2 [I1 - 3 + (1/q) (J^(-2q) - 1)],   q = nu/(1 - 2 nu),   I1 = tr b,
//   sigma = G/J (b - J^(-2q) 1),   nu = 0.463.
// The LS-DYNA Theory Manual 2006, Material Model 7, prints V^-1 C - V^(-1/(1-2 nu)) 1 as the second Piola-Kirchhoff stress over G. With b in
// the place of C that is the Cauchy stress above; pushed forward from C it would have no potential. Blatz and Ko's is taken.
// Principal stiffness: lambda_i^2 d2W/dlambda_i^2 = G lambda_i^2 + G (1 + 2q) J^(-2q). Stresses [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/finite_strain.hpp"

namespace kardan {

struct LawSource;

struct BlatzKo {
  static constexpr std::size_t history = 6, tensors = 1;  ///< b
  static constexpr bool finite_strain = true;
  static constexpr double poissons_ratio = 0.463;
  static constexpr double q = poissons_ratio / (1 - 2 * poissons_ratio);

  double g = 0;

  /// From *MAT_BLATZ-KO_RUBBER; complains where it cannot be computed.
  static std::optional<BlatzKo> make(LawSource& source);
  double longitudinal() const { return g * (2 + 2 * q); }
  double shear() const { return g; }
  void start(double* values) const { start_deformation(values); }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double* values) const {
    const auto d = Deformation<R>::advance(p, values);
    const R hydrostatic = exp(log(d.volume) * R(-2.0 * q)), f = R(g) / d.volume;
    p.stress = scaled(d.b, f, -f * hydrostatic);
    p.modulus = R(g) * largest_principal_bound(d.b) + R(g * (1 + 2 * q)) * hydrostatic;
  }
};

}  // namespace kardan

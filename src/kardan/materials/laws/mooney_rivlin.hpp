// *MAT_MOONEY-RIVLIN_RUBBER (027), on a number type R.
//
// Source: Mooney 1940, J. Appl. Phys. 11, 582-592; Rivlin 1948, Phil. Trans. Roy. Soc. A 241, 379-397; Hallquist, LS-DYNA Theory Manual
// 2006, Material Model 27, whose volumetric terms are
//   W = A (I - 3) + B (II - 3) + C (III^-2 - 1) + D (III - 1)^2,   C = A/2 + B,   D = [A (5 nu - 2) + B (11 nu - 5)]/(2 (1 - 2 nu)),
// I, II, III = J^2 the invariants of b. With I b - b^2 = II 1 - III b^-1,
//   J sigma = 2 A b + 2 B (I b - b^2) + (4 D (III - 1) III - 4 C III^-2) 1.
// Principal stiffness: lambda^2 d2W/dlambda^2 = 2 A lambda^2 + 2 B lambda^2 (I - lambda^2) + 20 C III^-2 + 12 D III^2 - 4 D III;
// lambda^2 (I - lambda^2) <= II. mu = 2 (A + B). A, B [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/finite_strain.hpp"

namespace kardan {

struct LawSource;

struct MooneyRivlin {
  static constexpr std::size_t history = 6, tensors = 1;  ///< b
  static constexpr bool finite_strain = true;

  double a = 0, b = 0, c = 0, d = 0;

  static MooneyRivlin from(double a, double b, double nu) {
    return {a, b, 0.5 * a + b, (a * (5 * nu - 2) + b * (11 * nu - 5)) / (2 * (1 - 2 * nu))};
  }
  /// From *MAT_MOONEY-RIVLIN_RUBBER; complains where it cannot be computed.
  static std::optional<MooneyRivlin> make(LawSource& source);
  double longitudinal() const { return 2 * a + 4 * b + 20 * c + 8 * d; }
  double shear() const { return 2 * (a + b); }
  void start(double* values) const { start_deformation(values); }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double* values) const {
    const auto now = Deformation<R>::advance(p, values);
    const SymmetricTensor<R>& left = now.b;
    const SymmetricTensor<R> square = squared(left);
    const R one(1.0), first = trace(left), second = R(0.5) * (first * first - trace(square)), third = now.volume * now.volume;
    const R inverse = one / third, inverse2 = inverse * inverse, over_j = one / now.volume;
    const R linear = over_j * (R(2.0 * a) + R(2.0 * b) * first), quadratic = R(-2.0 * b) * over_j;
    const R hydrostatic = over_j * (R(4.0 * d) * (third - one) * third - R(4.0 * c) * inverse2);
    p.stress = {linear * left.xx + quadratic * square.xx + hydrostatic,
                linear * left.yy + quadratic * square.yy + hydrostatic,
                linear * left.zz + quadratic * square.zz + hydrostatic,
                linear * left.xy + quadratic * square.xy,
                linear * left.yz + quadratic * square.yz,
                linear * left.zx + quadratic * square.zx};
    p.modulus = abs(R(2.0 * a)) * largest_principal_bound(left) + abs(R(2.0 * b)) * second + R(20.0 * c) * inverse2 +
                R(4.0 * d) * third * (R(3.0) * third - one);
  }
};

}  // namespace kardan

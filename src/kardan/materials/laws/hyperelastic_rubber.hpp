// *MAT_HYPERELASTIC_RUBBER (077_H), on a number type R: a polynomial of the invariants of the isochoric stretch.
//
// Source: Rivlin and Saunders 1951, Phil. Trans. Roy. Soc. A 243, 251-288; isochoric invariants and volumetric term of Sussman and Bathe
// 1987, Comput. Struct. 26, 357-409; Hallquist, LS-DYNA Theory Manual 2006, Material Model 77:
//   W = sum C_pq (J1 - 3)^p (J2 - 3)^q + K/2 (J - 1)^2,   J1 = I III^(-1/3),   J2 = II III^(-2/3)
// with C10, C01, C11, C20, C02, C30; mu = 2 (C10 + C01), K = 2 mu (1 + nu)/(3 (1 - 2 nu)). With c = J^(-2/3) b, W1 = dW/dJ1 …,
//   J sigma = 2 dev [W1 c + W2 (J1 c - c^2)] + K J (J - 1) 1,
// beside it the Prony series of prony.hpp. Stiffness for the time step, from above, with x the largest eigenvalue of c, y of c^-1,
// a >= |x_i - J1/3|, e >= |1/x_i - J2/3| (logarithmic strains e_i: d2W/de_i^2 - dW/de_i):
//   |W1| (4/3 x + 4/9 J1 + 2 a) + |W2| (4/3 y + 4/9 J2 + 2 e) + 4 (|W11| a^2 + 2 |W12| a e + |W22| e^2) + K J^2.
// C_pq [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/prony.hpp"

namespace kardan {

struct LawSource;

struct HyperelasticRubber {
  static constexpr std::size_t history = 6 * (1 + PronySeries::most), tensors = 1 + PronySeries::most;  ///< at most: b, h_i
  static constexpr bool finite_strain = true;

  double c10 = 0, c01 = 0, c11 = 0, c20 = 0, c02 = 0, c30 = 0, bulk = 0;
  PronySeries prony;

  /// From *MAT_HYPERELASTIC_RUBBER; complains where it cannot be computed.
  static std::optional<HyperelasticRubber> make(LawSource& source);
  double longitudinal() const { return bulk + 4.0 / 3.0 * shear(); }
  double shear() const { return 2 * (c10 + c01) + prony.instantaneous(); }
  std::size_t used_tensors() const { return 1 + prony.terms; }
  std::size_t used_history() const { return 6 * used_tensors(); }
  void start(double* values) const {
    start_deformation(values);
    for (std::size_t i = 6; i < used_history(); ++i) values[i] = 0;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    const auto now = Deformation<R>::advance(p, values);
    const R one(1.0), two(2.0), third(1.0 / 3.0), j = now.volume;
    const SymmetricTensor<R> c = scaled(now.b, exp(log(j) * R(-2.0 / 3.0)), R(0.0)), square = squared(c);
    const R j1 = trace(c), j2 = R(0.5) * (j1 * j1 - trace(square)), m = j1 - R(3.0), n = j2 - R(3.0);
    const R w1 = R(c10) + R(c11) * n + m * (R(2.0 * c20) + R(3.0 * c30) * m), w2 = R(c01) + R(c11) * m + R(2.0 * c02) * n;
    const R over_j = one / j, linear = two * over_j * (w1 + w2 * j1), quadratic = R(-2.0) * over_j * w2;
    const R mean = third * (linear * j1 + quadratic * trace(square)), hydrostatic = R(bulk) * (j - one) - mean;
    p.stress = {linear * c.xx + quadratic * square.xx + hydrostatic,
                linear * c.yy + quadratic * square.yy + hydrostatic,
                linear * c.zz + quadratic * square.zz + hydrostatic,
                linear * c.xy + quadratic * square.xy,
                linear * c.yz + quadratic * square.yz,
                linear * c.zx + quadratic * square.zx};
    prony.add(p, t, values + 6 * block_lanes);

    const SymmetricTensor<R> inverse{square.xx - j1 * c.xx + j2, square.yy - j1 * c.yy + j2, square.zz - j1 * c.zz + j2,
                                     square.xy - j1 * c.xy,      square.yz - j1 * c.yz,      square.zx - j1 * c.zx};
    const R x = largest_principal_bound(c), y = largest_principal_bound(inverse), a = x - third * j1, e = y - third * j2;
    p.modulus = abs(w1) * (R(4.0 / 3.0) * x + R(4.0 / 9.0) * j1 + two * a) + abs(w2) * (R(4.0 / 3.0) * y + R(4.0 / 9.0) * j2 + two * e) +
                R(4.0) * (abs(R(2.0 * c20) + R(6.0 * c30) * m) * a * a + two * abs(R(c11)) * a * e + abs(R(2.0 * c02)) * e * e) +
                R(4.0 / 3.0 * prony.instantaneous()) + R(bulk) * j * j;
  }
};

}  // namespace kardan

// Stress of an energy W(J1 - 3, J2 - 3) + K/2 (J - 1)^2 of the invariants J1, J2 of the isochoric stretch c = J^(-2/3) b.
//
// Source: Sussman and Bathe 1987, Comput. Struct. 26, 357-409. J1 = I III^(-1/3), J2 = II III^(-2/3); with W1 = dW/dJ1 ...,
//   J sigma = 2 dev [W1 c + W2 (J1 c - c^2)] + K J (J - 1) 1.
// Stiffness for the time step, from above, with x the largest eigenvalue of c, y of c^-1, a >= |x_i - J1/3|, e >= |1/x_i - J2/3|
// (logarithmic strains e_i: d2W/de_i^2 - dW/de_i):
//   |W1| (4/3 x + 4/9 J1 + 2 a) + |W2| (4/3 y + 4/9 J2 + 2 e) + 4 (|W11| a^2 + 2 |W12| a e + |W22| e^2) + K J^2.
#pragma once

#include "kardan/materials/finite_strain.hpp"

namespace kardan {

template <class R>
struct EnergyDerivatives {
  R w1, w2, w11, w12, w22;
};

/// Sets stress and modulus. @param energy EnergyDerivatives of (J1 - 3, J2 - 3)
template <class R, class Energy>
[[gnu::always_inline]] inline void isochoric_stress(MaterialPoint<R>& p, const Deformation<R>& now, const R& bulk, Energy&& energy) {
  const R one(1.0), two(2.0), third(1.0 / 3.0), j = now.volume;
  const SymmetricTensor<R> c = scaled(now.b, exp(log(j) * R(-2.0 / 3.0)), R(0.0)), square = squared(c);
  const R j1 = trace(c), j2 = R(0.5) * (j1 * j1 - trace(square));
  const EnergyDerivatives<R> w = energy(j1 - R(3.0), j2 - R(3.0));
  const R over_j = one / j, linear = two * over_j * (w.w1 + w.w2 * j1), quadratic = R(-2.0) * over_j * w.w2;
  const R mean = third * (linear * j1 + quadratic * trace(square)), hydrostatic = bulk * (j - one) - mean;
  p.stress = {linear * c.xx + quadratic * square.xx + hydrostatic,
              linear * c.yy + quadratic * square.yy + hydrostatic,
              linear * c.zz + quadratic * square.zz + hydrostatic,
              linear * c.xy + quadratic * square.xy,
              linear * c.yz + quadratic * square.yz,
              linear * c.zx + quadratic * square.zx};
  const SymmetricTensor<R> inverse{square.xx - j1 * c.xx + j2, square.yy - j1 * c.yy + j2, square.zz - j1 * c.zz + j2,
                                   square.xy - j1 * c.xy,      square.yz - j1 * c.yz,      square.zx - j1 * c.zx};
  const R x = largest_principal_bound(c), y = largest_principal_bound(inverse), a = x - third * j1, e = y - third * j2;
  p.modulus = abs(w.w1) * (R(4.0 / 3.0) * x + R(4.0 / 9.0) * j1 + two * a) + abs(w.w2) * (R(4.0 / 3.0) * y + R(4.0 / 9.0) * j2 + two * e) +
              R(4.0) * (abs(w.w11) * a * a + two * abs(w.w12) * a * e + abs(w.w22) * e * e) + bulk * j * j;
}

}  // namespace kardan

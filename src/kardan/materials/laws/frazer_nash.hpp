// *MAT_FRAZER-NASH_RUBBER (031), on a number type R: a polynomial of the invariants of the Green-St. Venant strain.
//
// Source: Kenchington 1988, "A non-linear elastic material model for DYNA3D", DYNA3D user group conference; Hallquist, LS-DYNA Theory Manual
// 2006, Material Model 31:
//   U = C100 I1 + C200 I1^2 + C300 I1^3 + C400 I1^4 + C110 I1 I2 + C210 I1^2 I2 + C010 I2 + C020 I2^2 + f(J),
//   I1 = E_ii, I2 = (E_ii E_jj - E_ij E_ij)/2.
// The manual does not say what f(J) is. Kardan's reading: E is that of the isochoric stretch, so that the body at rest is free of stress, and
// f = K/2 (J - 1)^2; for the incompressible specimens that the constants are fitted to this is the same. With J1, J2 of
// invariant_energy.hpp
//   I1 = (J1 - 3)/2, I2 = (J2 - 3)/4 - (J1 - 3)/2,
//   W1 = (U1 - U2)/2, W2 = U2/4, W11 = (U11 - 2 U12 + U22)/4, W12 = (U12 - U22)/8, W22 = U22/16   (U1 = dU/dI1 ...),
// mu = C100 - C010/2, K = 2 mu (1 + nu)/(3 (1 - 2 nu)). C [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/invariant_energy.hpp"

namespace kardan {

struct LawSource;

struct FrazerNash {
  static constexpr std::size_t history = 6, tensors = 1;  ///< b
  static constexpr bool finite_strain = true;

  double c100 = 0, c200 = 0, c300 = 0, c400 = 0, c110 = 0, c210 = 0, c010 = 0, c020 = 0, bulk = 0;

  /// From *MAT_FRAZER-NASH_RUBBER; complains where it cannot be computed.
  static std::optional<FrazerNash> make(LawSource& source);
  double longitudinal() const { return bulk + 4.0 / 3.0 * shear(); }
  double shear() const { return c100 - 0.5 * c010; }
  void start(double* values) const { start_deformation(values); }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double* values) const {
    const auto now = Deformation<R>::advance(p, values);
    isochoric_stress(p, now, R(bulk), [&](const R& m, const R& n) {
      const R half(0.5), i1 = half * m, i2 = R(0.25) * n - i1;
      const R u1 = R(c100) + i1 * (R(2 * c200) + i1 * (R(3 * c300) + R(4 * c400) * i1)) + i2 * (R(c110) + R(2 * c210) * i1);
      const R u2 = R(c010) + i1 * (R(c110) + R(c210) * i1) + R(2 * c020) * i2;
      const R u11 = R(2 * c200) + i1 * (R(6 * c300) + R(12 * c400) * i1) + R(2 * c210) * i2;
      const R u12 = R(c110) + R(2 * c210) * i1, u22(2 * c020);
      return EnergyDerivatives<R>{half * (u1 - u2), R(0.25) * u2, R(0.25) * (u11 - u12 - u12 + u22), R(0.125) * (u12 - u22),
                                  R(0.0625) * u22};
    });
  }
};

}  // namespace kardan

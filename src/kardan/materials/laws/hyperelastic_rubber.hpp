// *MAT_HYPERELASTIC_RUBBER (077_H), on a number type R: a polynomial of the invariants of the isochoric stretch.
//
// Source: Rivlin and Saunders 1951, Phil. Trans. Roy. Soc. A 243, 251-288; isochoric invariants and volumetric term of Sussman and Bathe
// 1987, Comput. Struct. 26, 357-409; Hallquist, LS-DYNA Theory Manual 2006, Material Model 77:
//   W = sum C_pq (J1 - 3)^p (J2 - 3)^q + K/2 (J - 1)^2,   J1 = I III^(-1/3),   J2 = II III^(-2/3)
// with C10, C01, C11, C20, C02, C30; mu = 2 (C10 + C01), K = 2 mu (1 + nu)/(3 (1 - 2 nu)); stress and stiffness: invariant_energy.hpp,
// beside them the Prony series of prony.hpp.
// C_pq [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/invariant_energy.hpp"
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
    isochoric_stress(p, now, R(bulk), [&](const R& m, const R& n) {
      return EnergyDerivatives<R>{R(c10) + R(c11) * n + m * (R(2.0 * c20) + R(3.0 * c30) * m), R(c01) + R(c11) * m + R(2.0 * c02) * n,
                                  R(2.0 * c20) + R(6.0 * c30) * m, R(c11), R(2.0 * c02)};
    });
    prony.add(p, t, values + 6 * block_lanes);
    p.modulus += R(4.0 / 3.0 * prony.instantaneous());
  }
};

}  // namespace kardan

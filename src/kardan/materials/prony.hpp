// Viscoelastic stress beside a hyperelastic one: Maxwell elements side by side (Prony series), s = sum_i h_i,
//   d h_i/dt = 2 G_i e' - beta_i h_i,   e' the deviator of the strain rate (co-rotated),
//   h_i(t_n) = exp(-x) h_i(t_(n-1)) + 2 G_i (1 - exp(-x))/x de',   x = beta_i dt,
// exact for a constant rate in the step. Sources: Herrmann and Peterson 1968, Proc. 7th ICRPG Working Group on Mechanical Behavior;
// Taylor, Pister and Goudreau 1970, Int. J. Numer. Meth. Eng. 2, 45-59; Hallquist, LS-DYNA Theory Manual 2006, Material Models 6 and 77.
// G_i [stress], beta_i [1/time].
#pragma once

#include <cstddef>

#include "kardan/materials/finite_strain.hpp"

namespace kardan {

/// Stress of one Maxwell element at t_n; `h` its stress at t_(n-1), `d` the strain increment's deviator.
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> relaxed(const SymmetricTensor<R>& h, const SymmetricTensor<R>& d, double shear, double beta,
                                                         double dt) {
  const R x(beta * dt), kept = exp(-min(x, R(690.0))), gained = R(2.0 * shear) * decay_mean(x);
  return {kept * h.xx + gained * d.xx, kept * h.yy + gained * d.yy, kept * h.zz + gained * d.zz,
          kept * h.xy + gained * d.xy, kept * h.yz + gained * d.yz, kept * h.zx + gained * d.zx};
}

struct PronySeries {
  static constexpr std::size_t most = 12;

  std::size_t terms = 0;
  double shear[most] = {}, beta[most] = {};

  /// Shear modulus of a sudden strain.
  double instantaneous() const {
    double sum = 0;
    for (std::size_t i = 0; i < terms; ++i) sum += shear[i];
    return sum;
  }
  /// Brings the h_i, from `history` on, to t_n and adds them to the stress.
  template <class R>
  [[gnu::always_inline]] void add(MaterialPoint<R>& p, const StepTime& t, double* history) const {
    const SymmetricTensor<R> d = scaled(p.strain, R(1.0), trace(p.strain) * R(-1.0 / 3.0));
    for (std::size_t i = 0; i < terms; ++i) {
      double* own = history + 6 * i * block_lanes;
      const SymmetricTensor<R> h = relaxed(load_tensor<R>(own), d, shear[i], beta[i], t.dt);
      store_tensor(h, own);
      p.stress = {p.stress.xx + h.xx, p.stress.yy + h.yy, p.stress.zz + h.zz, p.stress.xy + h.xy, p.stress.yz + h.yz, p.stress.zx + h.zx};
    }
  }
};

}  // namespace kardan

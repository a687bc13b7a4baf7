// *MAT_VISCOELASTIC (006), on a number type R: elastic in volume, a standard solid in shear.
//
// Source: Herrmann and Peterson 1968, Proc. 7th ICRPG Working Group on Mechanical Behavior; Hallquist, LS-DYNA Theory Manual 2006, Material
// Model 6:
//   G(t) = GI + (G0 - GI) exp(-BETA t),   s = 2 int G(t - t') e'(t') dt',   p = -K log V,
// s co-rotated: the elastic part 2 GI e' beside one Maxwell element (prony.hpp). K, G [force/length^2], BETA [1/time].
#pragma once

#include <optional>

#include "kardan/materials/prony.hpp"

namespace kardan {

struct LawSource;

struct Viscoelastic {
  static constexpr std::size_t history = 6, tensors = 1;  ///< stress of the Maxwell element

  double bulk = 0, long_term = 0, decaying = 0, beta = 0;  ///< K, GI, G0 - GI, BETA

  /// From *MAT_VISCOELASTIC; complains where it cannot be computed.
  static std::optional<Viscoelastic> make(LawSource& source);
  double longitudinal() const { return bulk + 4.0 / 3.0 * shear(); }
  double shear() const { return long_term + decaying; }
  void start(double* values) const {
    for (std::size_t i = 0; i < history; ++i) values[i] = 0;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    const R volumetric = trace(p.strain), third(1.0 / 3.0);
    const SymmetricTensor<R> d = scaled(p.strain, R(1.0), -third * volumetric);
    const SymmetricTensor<R> before = load_tensor<R>(values), now = relaxed(before, d, decaying, beta, t.dt);
    store_tensor(now, values);
    const R two_g(2.0 * long_term), mean = R(bulk) * volumetric;
    SymmetricTensor<R>& s = p.stress;
    s = {s.xx + two_g * d.xx + mean + (now.xx - before.xx), s.yy + two_g * d.yy + mean + (now.yy - before.yy),
         s.zz + two_g * d.zz + mean + (now.zz - before.zz), s.xy + two_g * d.xy + (now.xy - before.xy),
         s.yz + two_g * d.yz + (now.yz - before.yz),        s.zx + two_g * d.zx + (now.zx - before.zx)};
  }
};

}  // namespace kardan

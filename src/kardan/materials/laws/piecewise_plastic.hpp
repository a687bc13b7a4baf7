// *MAT_PIECEWISE_LINEAR_PLASTICITY (024) in three dimensions, on a number type R: von Mises' yield condition, associated flow,
// isotropic hardening that neither falls nor suddenly steepens. The law of shells is plastic_plane_stress.hpp; what else the keyword may ask
// for is in rate_plastic.hpp.
//
// Radial return (Wilkins 1964, Meth. Comput. Phys. 3, 211-263; Krieg and Krieg 1977, J. Press. Vessel Technol. 99, 510-515): with the
// deviator s of the elastic trial stress, q = sqrt(3/2 s:s), yield stress Y(p) and increment dp of the effective plastic strain,
//   q - 3 mu dp = Y(p + dp),   s_new = s Y/q,
// which is linear on a straight piece of hardening, dp = (q - Y(p))/(3 mu + Y'). Where p + dp leaves the piece the next one is taken.
//
// Rate: Y = (1 + (rate/C)^(1/P)) Y_static, VP = 0: the rate is sqrt(e_ij e_ij) of the total strain over the step.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/laws/elastic.hpp"
#include "kardan/materials/hardening.hpp"

namespace kardan {

struct Curve;
struct LawSource;
struct PiecewisePlasticMaterial;

/// Complains where the hardening of *MAT_PIECEWISE_LINEAR_PLASTICITY cannot be computed.
bool check_piecewise(LawSource& source);

/// Constants of the law. A point keeps its effective plastic strain and its static yield stress.
struct PiecewisePlastic {
  static constexpr std::size_t history = 2, tensors = 0;
  static constexpr std::size_t plastic_strain = 0;  ///< its place in the history
  static constexpr int iterations = 64;  ///< pieces that one step may pass, at most

  Elastic elastic;
  CowperSymonds rate_law;
  HardeningCurve hardening;

  /// From *MAT_PIECEWISE_LINEAR_PLASTICITY; complains where it cannot be computed.
  static std::optional<PiecewisePlastic> make(LawSource& source);
  /// Whether this law does what the deck asks for; else laws/rate_plastic.hpp does.
  static bool computes(const PiecewisePlasticMaterial& material, const std::vector<Curve>& curves);

  double longitudinal() const { return elastic.longitudinal(); }
  double shear() const { return elastic.shear(); }
  void start(double* values) const {
    values[0] = 0;
    values[1] = hardening.initial();
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    SymmetricTensor<R>& s = p.stress;
    elastic.add_increment(s, p.strain);
    const R mean = (s.xx + s.yy + s.zz) * R(1.0 / 3.0);
    const SymmetricTensor<R> d{s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.yz, s.zx};
    const R square = R(1.5) * contraction(d, d), kept_yield = R::load(values + block_lanes);
    auto plastic = square > kept_yield * kept_yield;
    if (!R::any(plastic)) return;
    R rate(1.0);
    if (rate_law.active()) {
      rate = rate_law.factor(contraction(p.strain, p.strain), t.dt);
      const R yield = rate * kept_yield;
      plastic = square > yield * yield;
      if (!R::any(plastic)) return;
    }
    const R q = sqrt(square), strain = R::load(values), three_mu(1.5 * elastic.two_mu);
    auto h = hardening.piece(strain);
    R increment{}, yield;
    for (int i = 0; i < iterations; ++i) {
      const R slope = rate * h.slope;
      increment = (q - rate * (h.stress + h.slope * (strain - h.from))) / (three_mu + slope);
      yield = h.stress + h.slope * (strain + increment - h.from);
      const auto left = plastic & (strain + increment > h.to);
      if (hardening.row_count == 1 || !R::any(left)) break;
      const auto next = hardening.piece(h.to);
      h = {select(left, next.from, h.from), select(left, next.stress, h.stress), select(left, next.slope, h.slope),
           select(left, next.to, h.to)};
    }
    const R factor = select(plastic, rate * yield / q, R(1.0));
    s = {mean + d.xx * factor, mean + d.yy * factor, mean + d.zz * factor, d.xy * factor, d.yz * factor, d.zx * factor};
    select(plastic, strain + increment, strain).store(values);
    select(plastic, yield, kept_yield).store(values + block_lanes);
  }
};

}  // namespace kardan

// The update of erosion.hpp on packs.
#pragma once

#include "kardan/base/simd_math.hpp"
#include "kardan/materials/erosion.hpp"
#include "kardan/materials/point.hpp"
#include "kardan/materials/principal.hpp"

namespace kardan {

/// What the criteria look at: stress at the end of the step, strain increment or strain; shells have their stress in three dimensions too.
template <class R>
struct ErodingPoint {
  SymmetricTensor<R> stress, strain;
};

/// How many criteria hold, plus a large number if FAILTM does.
template <class R>
[[gnu::always_inline]] inline R count_criteria(const Erosion& e, const ErodingPoint<R>& p, const StepTime& t, bool shell, double* values) {
  const ErosionCriteria& c = e.criteria;
  const R zero(0.0), one(1.0);
  R count(t.time < c.time ? 0.0 : 1e3);
  const auto at_least = [&](const R& value, double limit) { count += select(value < R(limit), zero, one); };
  const auto at_most = [&](const R& value, double limit) { count += select(value > R(limit), zero, one); };
  const SymmetricTensor<R>&s = p.stress, &x = p.strain;
  const R mean = (s.xx + s.yy + s.zz) * R(1.0 / 3.0), volume = x.xx + x.yy + x.zz;
  at_most(mean, -c.max_pressure);
  at_least(mean, -c.min_pressure);
  const R square = contraction(s, s) - R(3.0) * mean * mean;
  at_least(sqrt(R(1.5) * max(square, zero)), c.mises);
  at_least(volume, c.expansion);
  at_most(volume, c.compaction);
  const R strain_square = contraction(x, x) - volume * volume * R(1.0 / 3.0);
  at_least(sqrt(R(2.0 / 3.0) * max(strain_square, zero)), c.effective_strain);
  if (c.plastic_strain < ErosionCriteria::never) {
    at_least(R::load(values + (Erosion::law_begin + e.law_plastic_strain) * block_lanes), c.plastic_strain);
  }
  if (e.wants_principal_stress()) {
    const R largest = principal_range(s).largest, excess = max(largest - R(c.impulse_stress), zero);
    at_least(largest, c.principal_stress);
    double* const kept = values + e.impulse_place() * block_lanes;
    const R impulse = R::load(kept) + excess * excess * R(t.dt);
    impulse.store(kept);
    at_least(impulse, c.impulse);
  }
  if (e.wants_principal_strains()) {
    const PrincipalRange<R> strain = principal_range(x);
    at_least(strain.largest, c.max_strain);
    at_most(strain.smallest, c.min_strain);
    at_least(R(0.5) * (strain.largest - strain.smallest), c.shear_strain);
  }
  if (shell) {
    at_least(zero - x.zz, c.thinning);
    const R half_difference = R(0.5) * (x.xx - x.yy);
    at_least(R(0.5) * (x.xx + x.yy) + sqrt(half_difference * half_difference + x.xy * x.xy), c.major_strain);
  }
  return count;
}

/// After the law's update: sums the strain, decides, and unloads what has failed.
template <class R>
[[gnu::always_inline]] inline R decide_erosion(const Erosion& e, const ErodingPoint<R>& now, const R& law_failed, const StepTime& t, bool shell,
                                               double* values) {
  const SymmetricTensor<R> before = load_tensor<R>(values);
  const SymmetricTensor<R>& d = now.strain;
  const SymmetricTensor<R> strain{before.xx + d.xx, before.yy + d.yy, before.zz + d.zz, before.xy + d.xy, before.yz + d.yz, before.zx + d.zx};
  store_tensor(strain, values);
  const R count = count_criteria(e, ErodingPoint<R>{now.stress, strain}, t, shell, values);
  double* const kept = values + e.failed_place() * block_lanes;
  const R own = select(count < R(e.criteria.needed), R(0.0), R(1.0));
  const R failed = max(R::load(kept), max(own, law_failed));
  failed.store(kept);
  return failed;
}

template <class R>
[[gnu::always_inline]] inline void erode(const Erosion& e, MaterialPoint<R>& p, const StepTime& t, double* values) {
  const SymmetricTensor<R> strain = p.strain;
  e.update(e.law, &p, t, values + Erosion::law_begin * block_lanes);
  p.failed = decide_erosion(e, ErodingPoint<R>{p.stress, strain}, p.failed, t, false, values);
  unload_failed(p);
}

template <class R>
[[gnu::always_inline]] inline void erode(const Erosion& e, ShellPoint<R>& p, const StepTime& t, double* values) {
  const PlaneStress<R> d = p.strain;
  e.update(e.law, &p, t, values + Erosion::law_begin * block_lanes);
  const R half(0.5), zero(0.0);
  const PlaneStress<R>& s = p.stress;
  const ErodingPoint<R> now{{s.xx, s.yy, zero, s.xy, s.yz, s.zx}, {d.xx, d.yy, p.thickness_strain, half * d.xy, half * d.yz, half * d.zx}};
  p.failed = decide_erosion(e, now, p.failed, t, true, values);
  unload_failed(p);
}

}  // namespace kardan

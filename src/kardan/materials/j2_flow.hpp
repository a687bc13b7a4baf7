// von Mises' yield condition with associated flow and isotropic hardening for any law of the yield stress, in three dimensions and in
// plane stress, on a number type R. What differs from material to material is the yield stress, a plain struct `Yield`:
//   static constexpr std::size_t history;       values of a point; the first one is the effective plastic strain
//   void start(double* values) const;
//   bool can_fail() const;                      ElementDeletion deletion() const;
//   Flow<R> begin(const StrainIncrement<R>&, double dt, const double* values) const;   what stays the same during the step's iterations
//   ValueAndSlope<R> at(const Flow<R>&, const R& dp) const;                            yield stress after the plastic increment dp, its slope
//   R finish(const Flow<R>&, const R& dp, const R& mean, const R& effective, double* values) const;
//                                               keeps the history; mean and effective stress at the end; 1 where the point has failed
//
// Radial return (Wilkins 1964, Meth. Comput. Phys. 3, 211-263; Krieg and Krieg 1977, J. Press. Vessel Technol. 99, 510-515), backward
// Euler: with the effective stress q of the elastic trial stress, the increment dp of the effective plastic strain solves
//   q - 3 mu dp = Y(dp),   0 <= dp <= q/(3 mu),
// where Y may depend on dp by hardening and by the rate dp/dt (viscoplastic, VP = 1). In plane stress (Simo and Taylor 1986; the notation is that
// of laws/plastic_plane_stress.hpp) it solves S(dp) = 1 with Y = Y(dp), 0 <= dp <= q/min(k). In both the left side falls to nothing
// at the bound, so there is a root for any Y >= 0, and bracketed_root.hpp finds one also where Y falls (softening). Where Y falls faster
// than 3 mu (in plane stress than min(k)) the stress drops within one step, as the material cannot follow the curve in equilibrium.
#pragma once

#include <cstddef>
#include <optional>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/bracketed_root.hpp"
#include "kardan/materials/laws/elastic.hpp"
#include "kardan/materials/laws/elastic_plane_stress.hpp"

namespace kardan {

struct LawSource;

/// Invariants of a step's strain increment, for rates.
template <class R>
struct StrainIncrement {
  R square;  ///< e_ij e_ij
  R volume;  ///< e_kk
};

inline constexpr double flow_tolerance = 1e-13;  ///< of the yield condition, relative to the trial stress

template <class Yield>
struct J2Flow {
  static constexpr std::size_t history = Yield::history, tensors = 0, plastic_strain = 0;

  Elastic elastic;
  Yield yield;

  static std::optional<J2Flow> make(LawSource& source);
  double longitudinal() const { return elastic.longitudinal(); }
  double shear() const { return elastic.shear(); }
  bool can_fail() const { return yield.can_fail(); }
  ElementDeletion deletion() const { return yield.deletion(); }
  void start(double* values) const { yield.start(values); }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    SymmetricTensor<R>& s = p.stress;
    const StrainIncrement<R> increment{contraction(p.strain, p.strain), p.strain.xx + p.strain.yy + p.strain.zz};
    elastic.add_increment(s, p.strain);
    const R mean = (s.xx + s.yy + s.zz) * R(1.0 / 3.0);
    const SymmetricTensor<R> d{s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.yz, s.zx};
    const R q = sqrt(R(1.5) * contraction(d, d)), three_mu(1.5 * elastic.two_mu), zero(0.0);
    const auto flow = yield.begin(increment, t.dt, values);
    ValueAndSlope<R> y = yield.at(flow, zero);
    const auto plastic = q > y.value;
    R dp(0.0), effective = q;
    if (R::any(plastic)) {
      const R safe = select(plastic, q, R(1.0)), high = q / three_mu;
      const R guess = select(plastic, (q - y.value) / (three_mu + min(max(y.slope, zero), three_mu)), zero);
      dp = bracketed_root(guess, high, plastic, flow_tolerance, [&](const R& x) {
        y = yield.at(flow, x);
        return ValueAndSlope<R>{(y.value + three_mu * x) / safe - R(1.0), (y.slope + three_mu) / safe};
      });
      const R factor = select(plastic, y.value / safe, R(1.0));
      s = {mean + d.xx * factor, mean + d.yy * factor, mean + d.zz * factor, d.xy * factor, d.yz * factor, d.zx * factor};
      effective = q * factor;
    }
    p.failed = yield.finish(flow, dp, mean, effective, values);
  }
};

/// The same in plane stress, with the transverse shears in the yield condition.
template <class Yield>
struct J2PlaneStress {
  static constexpr std::size_t history = Yield::history;

  ElasticPlaneStress elastic;
  double k_a = 0, k_b = 0, k_t = 0;  ///< E/(2 (1-nu)), 3 G, 3 k G
  double elastic_bulk = 0;           ///< (1 - 2 nu)/E
  Yield yield;

  static J2PlaneStress from(const J2Flow<Yield>& law, double shear_factor) {
    J2PlaneStress m;
    m.elastic = ElasticPlaneStress::from(law.elastic, shear_factor);
    m.k_a = 0.5 * (m.elastic.c11 + m.elastic.c12);
    m.k_b = 3 * m.elastic.shear;
    m.k_t = 3 * m.elastic.transverse;
    m.elastic_bulk = 1 / (3 * law.elastic.lambda + law.elastic.two_mu);
    m.yield = law.yield;
    return m;
  }
  void start(double* values) const { yield.start(values); }

  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime& t, double* values) const {
    PlaneStress<R>& s = p.stress;
    const PlaneStress<R>& e = p.strain;
    const R sum_before = s.xx + s.yy, e_zz = e.xx + e.yy, zero(0.0), one(1.0);
    // The thickness rate is that of plastic flow.
    const StrainIncrement<R> increment{
        e.xx * e.xx + e.yy * e.yy + e_zz * e_zz + R(0.5) * (e.xy * e.xy + e.yz * e.yz + e.zx * e.zx), zero};
    elastic.add_increment(s, e);
    const R a = s.xx + s.yy, b = s.xx - s.yy;
    const R in_plane_sum = R(0.25) * (a * a), in_plane_rest = R(0.75) * (b * b) + R(3.0) * (s.xy * s.xy),
            transverse = R(3.0) * (s.yz * s.yz + s.zx * s.zx), q = sqrt(in_plane_sum + in_plane_rest + transverse);
    const auto flow = yield.begin(increment, t.dt, values);
    ValueAndSlope<R> y = yield.at(flow, zero);
    const auto plastic = q > y.value;
    R dp(0.0), effective = q;
    if (R::any(plastic)) {
      const double k_least = k_t > 0 && k_t < k_a ? (k_t < k_b ? k_t : k_b) : (k_a < k_b ? k_a : k_b);
      R to_sum, to_rest, to_transverse;
      const auto distance = [&](const R& x) {  // S^(-1/2) - 1
        const R inverse_a = one / select(plastic, y.value + R(k_a) * x, one), inverse_b = one / select(plastic, y.value + R(k_b) * x, one),
                inverse_t = one / select(plastic, y.value + R(k_t) * x, one);
        const R u = in_plane_sum * (inverse_a * inverse_a), v = in_plane_rest * (inverse_b * inverse_b),
                w = transverse * (inverse_t * inverse_t);
        const R square = max(u + v + w, R(1e-200)), root = one / sqrt(square);
        const R fall = u * inverse_a * (y.slope + R(k_a)) + v * inverse_b * (y.slope + R(k_b)) + w * inverse_t * (y.slope + R(k_t));
        to_sum = y.value * inverse_a;
        to_rest = y.value * inverse_b;
        to_transverse = y.value * inverse_t;
        return ValueAndSlope<R>{root - one, root * root * root * fall};
      };
      const R high = q * R(1.0 / k_least), cap(k_least);
      y = {max(y.value, q * R(1e-6)), min(max(y.slope, zero), cap)};  // of the guess only: a step of Newton's from 0
      const ValueAndSlope<R> start = distance(zero);
      const R guess = select(plastic, min(zero - start.value / start.slope, high), zero);
      dp = bracketed_root(guess, high, plastic, flow_tolerance, [&](const R& x) {
        y = yield.at(flow, x);
        return distance(x);
      });
      const R sum = a * to_sum, rest = b * to_rest;
      s.xx = select(plastic, R(0.5) * (sum + rest), s.xx);
      s.yy = select(plastic, R(0.5) * (sum - rest), s.yy);
      s.xy = select(plastic, s.xy * to_rest, s.xy);
      s.yz = select(plastic, s.yz * to_transverse, s.yz);
      s.zx = select(plastic, s.zx * to_transverse, s.zx);
      effective = select(plastic, y.value, q);
    }
    // Elastic part -(nu/E) d(sum); the plastic part keeps the volume.
    const R sum_now = s.xx + s.yy;
    p.thickness_strain = R(elastic_bulk) * (sum_now - sum_before) - (e.xx + e.yy);
    p.failed = yield.finish(flow, dp, sum_now * R(1.0 / 3.0), effective, values);
  }
};

}  // namespace kardan

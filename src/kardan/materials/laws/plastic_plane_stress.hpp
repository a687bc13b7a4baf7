// *MAT_PIECEWISE_LINEAR_PLASTICITY (024) in plane stress, on a number type R: von Mises' yield condition, associated flow, isotropic
// hardening.
//
// Return mapping of Simo and Taylor 1986, Int. J. Numer. Meth. Eng. 22, 649-670 (backward Euler, exact for the plane stress
// condition), with the transverse shears in the yield condition. In the sums and differences of the elastic trial stress,
//   a = xx + yy,  b = xx - yy,   q^2 = a^2/4 + 3 b^2/4 + 3 xy^2 + 3 (yz^2 + zx^2),
// elasticity and flow rule are both diagonal. With the increment p of the effective plastic strain and Y the yield stress at its end,
//   a = a_trial Y/(Y + k_a p),  b, xy likewise with k_b,  yz, zx with k_t,   k_a = E/(2 (1-nu)), k_b = 3 G, k_t = 3 k G,
// and the condition q = Y is, with the trial values,
//   S(p) = (a^2/4)/(Y + k_a p)^2 + (3 b^2/4 + 3 xy^2)/(Y + k_b p)^2 + 3 (yz^2 + zx^2)/(Y + k_t p)^2 = 1.
// Newton's method is applied to S^(-1/2) = 1. On a straight piece of hardening S^(-1/2) is concave and nearly linear in p (a straight
// line where the three k are equal): it converges from p = 0 without overshooting, mostly in two steps. Where p leaves a piece of the
// hardening curve, the next piece is looked up and the iteration goes on. A lane that has converged is not touched any more, so its
// result does not depend on its neighbours.
//
// Rate: Y = (1 + (rate/C)^(1/P)) Y_static (Cowper and Symonds 1957), VP = 0: the rate is that of the total strain over the step,
// sqrt(e_ij e_ij) with e_zz = -(e_xx + e_yy), that is with the thickness rate of plastic flow.
#pragma once

#include <cstddef>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/laws/elastic_plane_stress.hpp"
#include "kardan/materials/laws/piecewise_plastic.hpp"

namespace kardan {

/// Constants of the law, ready for the kernel. A point keeps its effective plastic strain and its static yield stress.
struct PlasticPlaneStress {
  static constexpr std::size_t history = 2;
  static constexpr int iterations = 40;       ///< at most; far more than are needed
  static constexpr double tolerance = 1e-10;  ///< of q/Y - 1

  ElasticPlaneStress elastic;
  double k_a = 0, k_b = 0, k_t = 0;           ///< E/(2 (1-nu)), 3 G, 3 k G
  double elastic_bulk = 0;                    ///< (1 - 2 nu)/E
  CowperSymonds rate_law;
  HardeningCurve hardening;

  static PlasticPlaneStress from(const PiecewisePlastic& law, double shear_factor) {
    PlasticPlaneStress m;
    m.elastic = ElasticPlaneStress::from(law.elastic, shear_factor);
    m.k_a = 0.5 * (m.elastic.c11 + m.elastic.c12);
    m.k_b = 3 * m.elastic.shear;
    m.k_t = 3 * m.elastic.transverse;
    m.elastic_bulk = 1 / (3 * law.elastic.lambda + law.elastic.two_mu);
    m.rate_law = law.rate_law;
    m.hardening = law.hardening;
    return m;
  }

  void start(double* values) const {
    values[0] = 0;
    values[1] = hardening.initial();
  }

  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime& t, double* history_values) const {
    const R sum = p.stress.xx + p.stress.yy;
    update(p.stress, p.strain, t.dt, history_values);
    // Elastic part -(nu/E) d(sum); the plastic part keeps the volume.
    p.thickness_strain = R(elastic_bulk) * (p.stress.xx + p.stress.yy - sum) - (p.strain.xx + p.strain.yy);
  }
  template <class R>
  [[gnu::always_inline]] void update(PlaneStress<R>& s, const PlaneStress<R>& d, double dt, double* history_values) const {
    elastic.add_increment(s, d);
    double* const yield_values = history_values + block_lanes;
    const R static_yield = R::load(yield_values);
    const Trial<R> t(s);
    constexpr double margin = (1 + tolerance) * (1 + tolerance);
    auto plastic = t.in_plane_sum + t.in_plane_rest + t.transverse > R(margin) * (static_yield * static_yield);
    if (!R::any(plastic)) return;
    R rate(1.0);
    if (rate_law.active()) {
      const R zz = d.xx + d.yy;
      rate = rate_law.factor(d.xx * d.xx + d.yy * d.yy + zz * zz + R(0.5) * (d.xy * d.xy + d.yz * d.yz + d.zx * d.zx), dt);
      const R yield = rate * static_yield;
      plastic = t.in_plane_sum + t.in_plane_rest + t.transverse > R(margin) * (yield * yield);
      if (!R::any(plastic)) return;
    }
    const R strain = R::load(history_values);
    const Return<R> end = return_map(t, plastic, strain, rate);
    const R a = (s.xx + s.yy) * end.sum, b = (s.xx - s.yy) * end.rest;
    s.xx = select(plastic, R(0.5) * (a + b), s.xx);
    s.yy = select(plastic, R(0.5) * (a - b), s.yy);
    s.xy = select(plastic, s.xy * end.rest, s.xy);
    s.yz = select(plastic, s.yz * end.transverse, s.yz);
    s.zx = select(plastic, s.zx * end.transverse, s.zx);
    (strain + end.increment).store(history_values);
    select(plastic, end.static_yield, static_yield).store(yield_values);
  }

 private:
  /// The three parts of q^2 of the trial stress.
  template <class R>
  struct Trial {
    R in_plane_sum, in_plane_rest, transverse;
    [[gnu::always_inline]] explicit Trial(const PlaneStress<R>& s) {
      const R a = s.xx + s.yy, b = s.xx - s.yy;
      in_plane_sum = R(0.25) * (a * a);
      in_plane_rest = R(0.75) * (b * b) + R(3.0) * (s.xy * s.xy);
      transverse = R(3.0) * (s.yz * s.yz + s.zx * s.zx);
    }
  };
  /// Increment of the effective plastic strain, factors on the parts of the trial stress, static yield stress at the end.
  template <class R>
  struct Return {
    R increment, sum, rest, transverse, static_yield;
  };
  template <class R, class Mask>
  [[gnu::always_inline]] Return<R> return_map(const Trial<R>& t, const Mask& plastic, const R& strain, const R& rate) const {
    auto h = hardening.piece(strain);
    Return<R> r{};
    R yield, to_sum, to_rest, to_transverse;
    for (int i = 0; i < iterations; ++i) {
      r.static_yield = h.stress + h.slope * (strain + r.increment - h.from);
      yield = rate * r.static_yield;
      const R a = yield + R(k_a) * r.increment, b = yield + R(k_b) * r.increment, c = yield + R(k_t) * r.increment;
      const R bc = b * c, inverse = R(1.0) / (a * bc);
      to_sum = bc * inverse;
      to_rest = a * c * inverse;
      to_transverse = a * b * inverse;
      const R u = t.in_plane_sum * (to_sum * to_sum), v = t.in_plane_rest * (to_rest * to_rest),
              w = t.transverse * (to_transverse * to_transverse);
      const R square = u + v + w, excess = sqrt(square) - R(1.0);
      const Mask active = plastic & (abs(excess) > R(tolerance));
      if (!R::any(active)) break;
      const R slope = rate * h.slope;
      const R fall = u * to_sum * (slope + R(k_a)) + v * to_rest * (slope + R(k_b)) + w * to_transverse * (slope + R(k_t));
      r.increment += select(active, square * excess / fall, R(0.0));
      const R now = strain + r.increment;
      const Mask left = active & ((now > h.to) | (now < h.from));
      if (hardening.row_count > 1 && R::any(left)) {
        const auto other = hardening.piece(now);
        h = {select(left, other.from, h.from), select(left, other.stress, h.stress), select(left, other.slope, h.slope),
             select(left, other.to, h.to)};
      }
    }
    r.sum = yield * to_sum;
    r.rest = yield * to_rest;
    r.transverse = yield * to_transverse;
    return r;
  }
};

}  // namespace kardan

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
// Halley's method is applied to g = S^(-1/2) = 1. On a straight piece of hardening g is concave and nearly linear in p (a straight line
// where the three k are equal). With the parts u of S, the increases d = (Y' + k)/(Y + k p) of their denominators, F1 and F2 the sums of
// u d and u d^2,
//   dp = S (sqrt(S) - 1)/F1 (1 + e),   e = 3/2 (sqrt(S) - 1) (F2 S - F1^2)/F1^2.
// Roots and divisions are what a step costs. sqrt(S) - 1 is taken as (S - 1) (S + 3)/(4 (S + 1)), Heron's step from the mean of S and 1,
// which is too large by less than (S - 1)^4/128 near the end and shares its division with 1/F1. Far from it, sqrt(S) >> 4, a step goes too
// far by sqrt(S)/4 at most; beyond the solution S is small, and the steps go back to a quarter each, as long as that is needed.
// At p = 0 all denominators are Y, so that the first step costs little. A step from where |q/Y - 1| is below 5e-4 leaves less than 1e-10:
// the lane is done with it, and the reciprocals of its denominators follow by their series. Where p leaves a piece of the
// hardening curve, the next piece is looked up and the iteration goes on. A lane that is done is not touched any more, so its result
// does not depend on its neighbours.
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
  static constexpr std::size_t elastic_step_reads = 1;  ///< place of the only value that elastic_step() reads
  static constexpr int iterations = 40;       ///< at most; far more than are needed
  static constexpr double tolerance = 1e-10;  ///< of q/Y - 1
  static constexpr double last_step = 5e-4;   ///< from |q/Y - 1| below this one more step is enough

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
    find_thickness_strain(p, sum);
  }
  /// update() where the static yield stress is reached nowhere; if it is, false, and nothing has changed.
  template <class R>
  [[gnu::always_inline]] bool elastic_step(ShellPoint<R>& p, const double* history_values) const {
    PlaneStress<R> s = p.stress;
    elastic.add_increment(s, p.strain);
    if (R::any(exceeded(Trial<R>(s), R::load(history_values + block_lanes)))) return false;
    const R sum = p.stress.xx + p.stress.yy;
    p.stress = s;
    find_thickness_strain(p, sum);
    return true;
  }
  template <class R>
  [[gnu::always_inline]] void update(PlaneStress<R>& s, const PlaneStress<R>& d, double dt, double* history_values) const {
    elastic.add_increment(s, d);
    double* const yield_values = history_values + block_lanes;
    const R static_yield = R::load(yield_values);
    const Trial<R> t(s);
    auto plastic = exceeded(t, static_yield);
    if (!R::any(plastic)) return;
    R rate(1.0);
    if (rate_law.active()) {
      const R zz = d.xx + d.yy;
      rate = rate_law.factor(d.xx * d.xx + d.yy * d.yy + zz * zz + R(0.5) * (d.xy * d.xy + d.yz * d.yz + d.zx * d.zx), dt);
      plastic = exceeded(t, rate * static_yield);
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
  /// Where the trial stress is beyond the yield stress.
  template <class R>
  [[gnu::always_inline]] static auto exceeded(const Trial<R>& t, const R& yield) {
    constexpr double margin = (1 + tolerance) * (1 + tolerance);
    return t.in_plane_sum + t.in_plane_rest + t.transverse > R(margin) * (yield * yield);
  }
  /// Elastic part -(nu/E) d(sum); the plastic part keeps the volume. @param sum xx + yy before
  template <class R>
  [[gnu::always_inline]] void find_thickness_strain(ShellPoint<R>& p, const R& sum) const {
    p.thickness_strain = R(elastic_bulk) * (p.stress.xx + p.stress.yy - sum) - (p.strain.xx + p.strain.yy);
  }
  /// Increment of the effective plastic strain, factors on the parts of the trial stress, static yield stress at the end.
  template <class R>
  struct Return {
    R increment, sum, rest, transverse, static_yield;
  };
  /// Estimate of the increment by one step of Halley's method from none; 0 in lanes that are not plastic.
  template <class R, class Mask>
  [[gnu::always_inline]] R first_increment(const Trial<R>& t, const Mask& plastic, const R& yield, const R& slope) const {
    const R d_a = slope + R(k_a), d_b = slope + R(k_b), d_t = slope + R(k_t);
    const R ua = t.in_plane_sum * d_a, ub = t.in_plane_rest * d_b, ut = t.transverse * d_t;
    const R square = t.in_plane_sum + t.in_plane_rest + t.transverse, f1 = ua + ub + ut, f2 = ua * d_a + ub * d_b + ut * d_t;
    const R y2 = yield * yield, f1_square = f1 * f1, below = R(4.0) * y2 * (square + y2), inverse = R(1.0) / (below * f1_square);
    const R excess = excess_above(square, y2) * f1_square * inverse, by_f1_square = below * inverse;
    const R e = min(R(1.5) * excess * (f2 * square - f1_square) * by_f1_square, R(0.25));
    return select(plastic, yield * excess * square * f1 * by_f1_square * (R(1.0) + e + e * e), R(0.0));
  }
  template <class R, class Mask>
  [[gnu::always_inline]] Return<R> return_map(const Trial<R>& t, const Mask& plastic, const R& strain, const R& rate) const {
    auto h = hardening.piece(strain);
    Return<R> r{};
    const R start = rate * (h.stress + h.slope * (strain - h.from));
    r.increment = first_increment(t, plastic, start, rate * h.slope);
    follow(h, plastic & (strain + r.increment > h.to), strain + r.increment);
    Mask open = plastic;
    for (int i = 0; i < iterations; ++i) {
      const R slope = rate * h.slope, yield = rate * (h.stress + h.slope * (strain + r.increment - h.from));
      const R a = yield + R(k_a) * r.increment, b = yield + R(k_b) * r.increment, c = yield + R(k_t) * r.increment;
      const R bc = b * c, inverse = R(1.0) / (a * bc), ac = a * inverse;
      const R to_sum = bc * inverse, to_rest = c * ac, to_transverse = b * ac;
      const R u = t.in_plane_sum * (to_sum * to_sum), v = t.in_plane_rest * (to_rest * to_rest),
              w = t.transverse * (to_transverse * to_transverse);
      const R d_a = to_sum * (slope + R(k_a)), d_b = to_rest * (slope + R(k_b)), d_t = to_transverse * (slope + R(k_t));
      const R ua = u * d_a, ub = v * d_b, ut = w * d_t, square = u + v + w, f1 = ua + ub + ut, f2 = ua * d_a + ub * d_b + ut * d_t;
      const R below = R(4.0) * (square + R(1.0)), both = R(1.0) / (f1 * below);
      const R excess = excess_above(square, R(1.0)) * f1 * both, by_f1 = below * both, ratio = square * by_f1;
      const R step = excess * ratio * (R(1.0) + R(1.5) * excess * (f2 * ratio - f1) * by_f1), end = yield + slope * step;
      r.increment += select(open, step, R(0.0));
      r.sum = select(open, end * to_sum * reciprocal_near_one(d_a * step), r.sum);
      r.rest = select(open, end * to_rest * reciprocal_near_one(d_b * step), r.rest);
      r.transverse = select(open, end * to_transverse * reciprocal_near_one(d_t * step), r.transverse);
      const R now = strain + r.increment, size = abs(excess);
      r.static_yield = select(open, h.stress + h.slope * (now - h.from), r.static_yield);
      const Mask left = open & (size > R(tolerance)) & ((now > h.to) | (now < h.from));
      open = left | (open & (size > R(last_step)));
      if (!R::any(open)) break;
      follow(h, left, now);
    }
    return r;
  }
  /// 4 Y^2 (q^2 + Y^2) (q/Y - 1) from the squares of q and Y.
  template <class R>
  [[gnu::always_inline]] static R excess_above(const R& q2, const R& y2) { return (q2 - y2) * (q2 + R(3.0) * y2); }
  /// 1/(1 + x) for small x, but for x^4.
  template <class R>
  [[gnu::always_inline]] static R reciprocal_near_one(const R& x) { return (R(1.0) - x) * (R(1.0) + x * x); }
  /// Takes the piece that holds the strain `now` in the lanes that have left theirs.
  template <class R, class Mask>
  [[gnu::always_inline]] void follow(HardeningCurve::Piece<R>& h, const Mask& left, const R& now) const {
    if (hardening.row_count == 1 || !R::any(left)) return;
    const auto other = hardening.piece(now);
    h = {select(left, other.from, h.from), select(left, other.stress, h.stress), select(left, other.slope, h.slope),
         select(left, other.to, h.to)};
  }
};

}  // namespace kardan

// The quadratic hexahedron with eight nodes that turn (ELFORM 3), fourteen points.
//
// Sources: Yunus, Pawlak and Cook 1991, Int. J. Numer. Meth. Eng. 31, 573-592 (solids with rotational degrees of freedom); Hallquist,
// LS-DYNA Theory Manual 2006, "Fully integrated brick element with 48 degrees-of-freedom"; Irons' fourteen points: quadratic_points.hpp.
//
// It is the serendipity element of twenty nodes whose edges are straight and whose nodes in the middle of the edges follow the corners:
// with d = x_j - x_i of an edge, as a cubic beam does,
//   v_k = (v_i + v_j)/2 + w,   w = d x (omega_j - omega_i)/8.
// The shape function of a middle node of an edge along r is (1 - r^2)(1 + s s_k)(1 + t t_k)/4, so the velocity is the trilinear one plus
//   (1 - r^2) A(s, t) + (1 - s^2) B(t, r) + (1 - t^2) C(r, s),
// where A, B, C are bilinear and have the values w on the four edges along r, s, t. With X(s, t) = dx/dr and W(s, t) = d omega/dr on these
// edges (d = 2 X, omega_j - omega_i = 2 W) A = X x W/2 there. Forces by virtual power: with G the forces that act on the coefficients of
// A, the coefficients of W feel those of G x X/2, the product taken on the edges as before.
//
// A linear velocity field with omega half its curl, equal at all nodes, has no bulges and is exact on any shape. The rule of integration
// is exact for the integrals of the gradients of all shape functions: r^2 s^2 t^2, the one monomial of these that the rule misses, cancels between the three
// terms v_a c_a^T. So patches are passed with the forces, too. Fields that the points do not see: equal turning of all nodes, and on
// bricks turning about an edge that changes along it. They have no stiffness, feel no force and do no work.
//
// Rotary inertia of a node: m l^2/8, l the longest edge at t = 0 (lumped_mass.hpp). Stable step: kappa min(1, l_0/l) times that of the
// one-point hexahedron. kappa = 3/4 covers what the rotations add to the largest frequency of an element: for cubes of nu = 0, the worst, its step
// is 0.766 of that without rotations, for distorted bricks 0.80 and more (test QuadraticHexahedron.StepIsBelowThatOfTheLargestFrequency).
#pragma once

#include "kardan/elements/solid/hexahedron_modes.hpp"
#include "kardan/elements/solid/natural_gradient.hpp"
#include "kardan/elements/solid/quadratic_points.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// A bilinear field over the four edges along one direction: c + u U + v V + uv U V, where U and V are the natural coordinates that follow
/// it in the order r, s, t, r, s.
template <class R>
struct EdgeField {
  Vec3T<R> c, u, v, uv;

  KARDAN_INLINE Vec3T<R> at(const R& pu, const R& pv) const { return c + u * pu + v * pv + uv * (pu * pv); }
  /// Its values on the edges (U, V) = (-1, -1), (1, -1), (-1, 1), (1, 1).
  KARDAN_INLINE void edges(Vec3T<R> (&e)[4]) const {
    const Vec3T<R> low = c - v, high = c + v, low_u = u - uv, high_u = u + uv;
    e[0] = low - low_u;
    e[1] = low + low_u;
    e[2] = high - high_u;
    e[3] = high + high_u;
  }
};

/// Derivatives of a nodal field along the edges of r, s and t.
template <class R>
struct EdgeFields {
  EdgeField<R> r, s, t;

  EdgeFields() = default;
  KARDAN_INLINE explicit EdgeFields(const Modes<R>& m)
      : r{m.a[0], m.a[3], m.a[5], m.a[6]}, s{m.a[1], m.a[4], m.a[3], m.a[6]}, t{m.a[2], m.a[5], m.a[4], m.a[6]} {}
  /// Forces that act on these derivatives, as forces on the coefficients of the nodal field.
  KARDAN_INLINE Modes<R> to_modes() const {
    return {{r.c, s.c, t.c, r.u + s.v, s.u + t.v, r.v + t.u, r.uv + s.uv + t.uv}};
  }
};

/// Half the cross product of two fields on the edges.
template <class R>
KARDAN_INLINE EdgeField<R> half_product(const EdgeField<R>& a, const EdgeField<R>& b) {
  Vec3T<R> p[4], q[4];
  a.edges(p);
  b.edges(q);
  const R eighth(0.125);
  for (int i = 0; i < 4; ++i) p[i] = cross(p[i], q[i]) * eighth;
  const Vec3T<R> low = p[0] + p[1], high = p[2] + p[3], low_u = p[1] - p[0], high_u = p[3] - p[2];
  return {low + high, low_u + high_u, high - low, high_u - low_u};
}

template <class R>
KARDAN_INLINE EdgeFields<R> half_products(const EdgeFields<R>& a, const EdgeFields<R>& b) {
  EdgeFields<R> p;
  p.r = half_product(a.r, b.r);
  p.s = half_product(a.s, b.s);
  p.t = half_product(a.t, b.t);
  return p;
}

/// Adds the derivatives of (1 - p^2) f(u, v) with respect to its own coordinate p and to u and v.
template <class R>
KARDAN_INLINE void add_gradient(const EdgeField<R>& f, const R& p, const R& u, const R& v, Vec3T<R>& by_p, Vec3T<R>& by_u, Vec3T<R>& by_v) {
  const R bubble = R(1.0) - p * p;
  by_p -= f.at(u, v) * (p + p);
  by_u += (f.u + f.uv * v) * bubble;
  by_v += (f.v + f.uv * u) * bubble;
}

/// The transpose: adds what forces on these derivatives do to the coefficients of f.
template <class R>
KARDAN_INLINE void add_forces(EdgeField<R>& f, const R& p, const R& u, const R& v, const Vec3T<R>& by_p, const Vec3T<R>& by_u,
                              const Vec3T<R>& by_v) {
  const R bubble = R(1.0) - p * p;
  const Vec3T<R> own = by_p * (p + p), fu = by_u * bubble, fv = by_v * bubble;
  f.c -= own;
  f.u += fu - own * u;
  f.v += fv - own * v;
  f.uv += fu * v + fv * u - own * (u * v);
}

/// Square of the longest edge.
template <class R>
KARDAN_INLINE R longest_edge_square(const EdgeFields<R>& x) {
  R longest{};
  for (const EdgeField<R>* f : {&x.r, &x.s, &x.t}) {
    Vec3T<R> half[4];
    f->edges(half);
    for (const Vec3T<R>& e : half) longest = max(longest, dot(e, e));
  }
  return R(4.0) * longest;
}

/// What the points of an element sum up.
template <class R>
struct QuadraticSums {
  R work{}, smallest = R(1e300), modulus, failed{};
  Modes<R> force{};
  EdgeFields<R> bulge_force{};
};

/// An element's motion: that of the trilinear hexahedron and the bulges of its edges (eight times them, as v8), on the geometry of the
/// middle of the step.
template <class R>
struct QuadraticMotion {
  HexahedronMotion<R, 6> m;
  EdgeFields<R> bulge8;

  KARDAN_INLINE explicit QuadraticMotion(const PackPlace& place) : m(place) {
    Vec3T<R> omega[8];
    gather_spins(place, omega);
    bulge8 = half_products(EdgeFields<R>(m.middle), EdgeFields<R>(mode_sums(omega)));
  }
  /// Eight times the derivatives of the velocity at a point.
  KARDAN_INLINE NaturalGradient<R> velocity8(const R& r, const R& s, const R& t) const {
    NaturalGradient<R> v(m.v8, r, s, t);
    add_gradient(bulge8.r, r, s, t, v.r, v.s, v.t);
    add_gradient(bulge8.s, s, t, r, v.s, v.t, v.r);
    add_gradient(bulge8.t, t, r, s, v.t, v.r, v.s);
    return v;
  }
};

/// One point: its stress to t_n, its share of the forces. `jacobian` is where its Jacobian of t = 0 is kept.
template <class R, class Law>
KARDAN_INLINE void quadratic_point(const Law& law, const StepTime& step, const QuadraticMotion<R>& motion, const QuadraticPoint& q,
                                   const MaterialPoint<R>& fresh, double* jacobian, double* stress, QuadraticSums<R>& sum) {
  const R r(q.r), s(q.s), t(q.t), weight(q.weight), dt(step.dt);
  const Cofactors<R> c_mid(NaturalGradient<R>(motion.m.middle, r, s, t)), c(NaturalGradient<R>(motion.m.x, r, s, t));
  const NaturalGradient<R> v8 = motion.velocity8(r, s, t);
  const R inverse = R(0.125) / c_mid.jacobian;
  Mat3T<R> l;
  for (std::size_t k = 0; k < 3; ++k) l[k] = (c_mid.r * v8.r[k] + c_mid.s * v8.s[k] + c_mid.t * v8.t[k]) * inverse;
  MaterialPoint<R> point = fresh;
  point.volume = c.jacobian / R::load(jacobian);
  sum.work += weight * c_mid.jacobian * update_point(law, step, point_motion(l, dt), point, stress);
  sum.modulus = max(sum.modulus, point.modulus);
  sum.failed += point.failed;
  sum.smallest = min(sum.smallest, c.jacobian);

  const Mat3T<R> tensor = full_tensor(point.stress);
  const Vec3T<R> fr = tensor * c.r * weight, fs = tensor * c.s * weight, ft = tensor * c.t * weight;
  add_mode_forces(sum.force, r, s, t, fr, fs, ft);
  add_forces(sum.bulge_force.r, r, s, t, fr, fs, ft);
  add_forces(sum.bulge_force.s, s, t, r, fs, ft, fr);
  add_forces(sum.bulge_force.t, t, r, s, ft, fr, fs);
}

/// The lanes of `place`; `history` begins with their values.
template <class R, class Law>
KARDAN_INLINE void quadratic_hexahedron_pack(const SolidProperties& p, const Law& law, const PackPlace& place, SolidBlock<8, 6>& block,
                                             double* history) {
  const StepTime& step = place.work.step;
  const R dt(step.dt), zero(0.0), one(1.0);
  const QuadraticMotion<R> motion(place);
  const HexahedronMotion<R, 6>& m = motion.m;
  R divergence{};
  for (int k = 0; k < 6; ++k) divergence += dot(m.v8.a[k], m.between.b[k]);
  divergence *= m.inverse_between;
  const BulkViscosity<R> bulk(p, m.now.volume, m.inverse_now, m.length, divergence, history);

  MaterialPoint<R> fresh;
  fresh.viscosity = bulk.mean();
  fresh.modulus = R(p.longitudinal);
  QuadraticSums<R> sum;
  sum.modulus = R(p.longitudinal);
  double* const own = history + solid_history::own * block_lanes;
  double* values = own + quadratic_history::count * block_lanes;
  for (std::size_t i = 0; i < quadratic_point_count; ++i, values += (6 + law.history()) * block_lanes) {
    quadratic_point(law, step, motion, quadratic_points[i], fresh, own + (quadratic_history::jacobian + i) * block_lanes, values, sum);
  }
  sum.work += bulk.work(divergence, dt) * m.between.volume;
  const EdgeFields<R> edges(m.x);
  Modes<R> moment = half_products(sum.bulge_force, edges).to_modes();
  for (int k = 0; k < 7; ++k) {
    sum.force.a[k] = sum.force.a[k] * R(0.125);
    moment.a[k] = moment.a[k] * R(0.125);
  }
  for (int k = 0; k < 6; ++k) sum.force.a[k] -= m.now.b[k] * bulk.pressure;
  Vec3T<R> force[8], moments[8];
  to_nodes(sum.force, force);
  to_nodes(moment, moments);
  const auto good = sum.smallest > zero;
  report_life(p, block, place.first, sum.work, zero, sum.failed, good);
  for (std::size_t a = 0; a < 8; ++a) block.force.set(a, place.first, force[a], moments[a]);
  const R grown = R::load(own + quadratic_history::longest_edge_square * block_lanes) / longest_edge_square(edges);
  const R length = m.length * (R(0.75) * sqrt(min(one, grown)));
  stable_step(p, length, divergence, sum.modulus, good).store(block.time_step + place.first);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

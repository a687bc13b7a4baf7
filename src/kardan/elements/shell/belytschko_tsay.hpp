// The Belytschko-Tsay shell (ELFORM 2): four nodes, one point in the plane, co-rotational.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Sources: Belytschko, Lin and Tsay 1984, Comput. Meth. Appl. Mech. Eng. 42, 225-251 (element); Belytschko and Tsay 1983,
// Int. J. Numer. Meth. Eng. 19, 405-419, and Hallquist, LS-DYNA Theory Manual 2006, "Belytschko-Lin-Tsay shell" (hourglass).
//
// Axes: e3 = (x3-x1) x (x4-x2) normalised, e1 along side 1-2 made normal to e3, e2 = e3 x e1. A = area. In these axes
//   b1 = [y2-y4, y3-y1, y4-y2, y1-y3]/(2A),   b2 = [x4-x2, x1-x3, x2-x4, x3-x1]/(2A)
// are the gradients of the shape functions at the centre, N their values there: 1/4 each, on a triangle (node 4 = node 3)
// 1/3, 1/3, 1/6, 1/6. With nodal velocities v and angular velocities w, at the height z above the surface of the nodes:
//   d_xx = b1.vx + z b1.wy,   d_yy = b2.vy - z b2.wx,   2 d_xy = b2.vx + b1.vy + z (b2.wy - b1.wx),
//   2 d_yz = b2.vz - N.wx,    2 d_zx = b1.vz + N.wy.
// Resultants of the stresses over the thickness h, (f, q) = integral s dz and m = integral z s dz, make the nodal forces
//   fx = A (b1 f_xx + b2 f_xy),  fy = A (b2 f_yy + b1 f_xy),  fz = A (b1 q_x + b2 q_y),
//   mx = -A (b2 m_yy + b1 m_xy + N q_y),  my = A (b1 m_xx + b2 m_xy + N q_x),  mz = 0.
//
// Strain increments are taken on the geometry at t_{n-1/2}, x_n - v dt/2, forces on that at t_n. LS-DYNA does so with OSU = 1 of
// *CONTROL_ACCURACY; by default it takes t_n for both, and an element turning at the rate w then stretches by w^2 dt/2 per unit of
// time - harmless in a crash, wrong in a mechanism that turns all day. With the middle a rigid rotation x_n - x_{n-1} =
// dt w x (x_n + x_{n-1})/2 (Hughes-Winget) strains nothing, to rounding.
//
// Hourglass: h = [1, -1, 1, -1], g = h - (h.x) b1 - (h.y) b2, rates q = g.v, B = sum(b1^2 + b2^2), forces g Q with
//   membrane  Q' = r E h A B/8 q,   bending  Q' = r E h^3 A B/192 q,   warping  Q' = r k G h^3 B/12 q           (IHQ 4, 5)
//     with r = QM/64, QB/64, QW/64 (docs/theory/hourglass.md)
//   membrane  Q = QM rho c h sqrt(A)/4 q; bending and warping in the same proportion to it as above, B A = 2    (IHQ 1, 2, 3)
// The viscous constants are Kardan's reading: Flanagan and Belytschko 1981, QM rho V^(2/3) c/4, with h sqrt(A) for V^(2/3).
// On a warped element g.z = 4 z0 does not vanish, and a rigid rotation would feed the in-plane rates. The element's own spin
// about x and y, b2.vz and -b1.vz, is taken out of them, and the conjugate forces (b1 Qx + b2 Qy) g.z are added to fz: the
// hourglass forces then do no work in a rigid rotation and have no resultant moment. (LS-DYNA leaves this term out.)
#pragma once

#include "kardan/base/pack_pair.hpp"
#include "kardan/base/pack_trio.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/elements/tiles/tile_loop.hpp"
#include "kardan/elements/tiles/tile_nodes.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Nodes 3 and 4 have the opposite of what nodes 1 and 2 have in b1, b2 and a.
template <class R>
struct ShellAxes {
  Vec3T<R> e1, e2, e3;
  R b1[2], b2[2];  ///< of nodes 1 and 2
  R hx, hy;        ///< h.x, h.y
  R a[2];          ///< hx b1 + hy b2: g = [1 - a1, -1 - a2, 1 + a1, -1 + a2]
  R area;
  R gamma_z;       ///< g.z
};

template <class R>
KARDAN_INLINE ShellAxes<R> shell_axes(const Vec3T<R> (&p)[4]) {
  ShellAxes<R> s;
  const Vec3T<R> d1 = p[2] - p[0], d2 = p[3] - p[1], side = p[1] - p[0];
  const Vec3T<R> normal = cross(d1, d2);
  const R square = dot(normal, normal), along = dot(side, normal);
  // The side made normal to the normal, times |normal|^2: so the two roots do not wait for one another.
  const Vec3T<R> flat = side * square - normal * along;
  const R f = inverse_sqrt(square), g = inverse_sqrt(dot(flat, flat));  // f = 1/(2A)
  s.area = R(0.5) * square * f;
  s.e3 = normal * f;
  s.e1 = flat * g;
  s.e2 = cross(s.e3, s.e1);
  // The diagonals are normal to e3: z1 = z3, z2 = z4.
  s.gamma_z = R(-2.0) * along * f;
  s.b1[0] = -(dot(d2, s.e2) * f);
  s.b1[1] = dot(d1, s.e2) * f;
  s.b2[0] = dot(d2, s.e1) * f;
  s.b2[1] = -(dot(d1, s.e1) * f);
  const Vec3T<R> h = p[2] - p[3] - side;
  s.hx = dot(h, s.e1);
  s.hy = dot(h, s.e2);
  for (int i = 0; i < 2; ++i) s.a[i] = s.hx * s.b1[i] + s.hy * s.b2[i];
  return s;
}

/// The axes on two geometries, computed side by side: either is a long chain of operations, of which the processor overlooks a part.
KARDAN_INLINE void shell_axes(const Vec3T<Pack> (&p)[4], const Vec3T<Pack> (&q)[4], ShellAxes<Pack>& of_p, ShellAxes<Pack>& of_q) {
  const auto both = [](const Vec3T<Pack>& a, const Vec3T<Pack>& b) { return Vec3T<PackPair>{{a.x, b.x}, {a.y, b.y}, {a.z, b.z}}; };
  const Vec3T<PackPair> x[4] = {both(p[0], q[0]), both(p[1], q[1]), both(p[2], q[2]), both(p[3], q[3])};
  const ShellAxes<PackPair> s = shell_axes(x);
  const auto a = [](const Vec3T<PackPair>& v) { return Vec3T<Pack>{v.x.a, v.y.a, v.z.a}; };
  const auto b = [](const Vec3T<PackPair>& v) { return Vec3T<Pack>{v.x.b, v.y.b, v.z.b}; };
  of_p = {a(s.e1), a(s.e2), a(s.e3), {s.b1[0].a, s.b1[1].a}, {s.b2[0].a, s.b2[1].a}, s.hx.a, s.hy.a, {s.a[0].a, s.a[1].a}, s.area.a, s.gamma_z.a};
  of_q = {b(s.e1), b(s.e2), b(s.e3), {s.b1[0].b, s.b1[1].b}, {s.b2[0].b, s.b2[1].b}, s.hx.b, s.hy.b, {s.a[0].b, s.a[1].b}, s.area.b, s.gamma_z.b};
}

/// What a block's elements report and give to their nodes.
struct ShellBlock : BlockReport {
  NodalForces<4, 6> force;
};

/// Generalised strains of one element in its axes, increments over the step; rates of the hourglass modes.
template <class R>
struct ShellStrains {
  R xx{}, yy{}, xy{}, yz{}, zx{};  ///< at the surface of the nodes
  R kxx{}, kyy{}, kxy{};           ///< per height
  R q[5]{};                        ///< hourglass rates: vx, vy, vz, wx, wy
};

template <class R>
KARDAN_INLINE ShellStrains<R> shell_strains(const ShellAxes<R>& s, const Vec3T<R> (&v)[4], const Vec3T<R> (&w)[4], const R (&n)[2],
                                            const R& dt) {
  const auto local = [&s](const Vec3T<R>& u) { return Vec3T<R>{dot(u, s.e1), dot(u, s.e2), dot(u, s.e3)}; };
  const auto turn = [&s](const Vec3T<R>& u) { return Vec3T<R>{dot(u, s.e1), dot(u, s.e2), R{}}; };
  const auto b1 = [&s](const R& of_13, const R& of_24) { return s.b1[0] * of_13 + s.b1[1] * of_24; };
  const auto b2 = [&s](const R& of_13, const R& of_24) { return s.b2[0] * of_13 + s.b2[1] * of_24; };
  const Vec3T<R> v13 = local(v[0] - v[2]), v24 = local(v[1] - v[3]), w13 = turn(w[0] - w[2]), w24 = turn(w[1] - w[3]);
  const R b1vx = b1(v13.x, v24.x), b1vy = b1(v13.y, v24.y), b1vz = b1(v13.z, v24.z);
  const R b2vx = b2(v13.x, v24.x), b2vy = b2(v13.y, v24.y), b2vz = b2(v13.z, v24.z);
  const R b1wx = b1(w13.x, w24.x), b1wy = b1(w13.y, w24.y), b2wx = b2(w13.x, w24.x), b2wy = b2(w13.y, w24.y);
  const Vec3T<R> mean = turn((w[0] + w[1]) * n[0] + (w[2] + w[3]) * n[1]);
  const Vec3T<R> hv = local(v[0] - v[1] + (v[2] - v[3])), hw = turn(w[0] - w[1] + (w[2] - w[3]));
  ShellStrains<R> r;
  r.xx = b1vx * dt;
  r.yy = b2vy * dt;
  r.xy = (b2vx + b1vy) * dt;
  r.yz = (b2vz - mean.x) * dt;
  r.zx = (b1vz + mean.y) * dt;
  r.kxx = b1wy * dt;
  r.kyy = -b2wx * dt;
  r.kxy = (b2wy - b1wx) * dt;
  r.q[0] = hv.x - s.hx * b1vx - s.hy * b2vx + b1vz * s.gamma_z;
  r.q[1] = hv.y - s.hx * b1vy - s.hy * b2vy + b2vz * s.gamma_z;
  r.q[2] = hv.z - s.hx * b1vz - s.hy * b2vz;
  r.q[3] = hw.x - s.hx * b1wx - s.hy * b2wx;
  r.q[4] = hw.y - s.hx * b1wy - s.hy * b2wy;
  return r;
}

/// Thickness of an element and the height of its mid surface over the nodes.
template <class R>
struct ShellThickness {
  double* kept;
  R value, half, offset;

  KARDAN_INLINE ShellThickness(const ShellProperties& p, double* kept_values)
      : kept(kept_values), value(R::load(kept + kept_thickness * block_lanes)), half(R(0.5) * value),
        offset(p.offsets ? R::load(kept + kept_offset * block_lanes) : R(0.0)) {}

  /// Follows the mean normal strain of the step; returns the ratio of new to old.
  KARDAN_INLINE R update(const ShellProperties& p, const R& strain) const {
    if (!p.thins) return R(1.0);
    const R half_strain = R(0.5) * strain, ratio = (R(1.0) + half_strain) / (R(1.0) - half_strain);
    (value * ratio).store(kept + kept_thickness * block_lanes);
    return ratio;
  }
};

/// Resultants over the thickness.
template <class R>
struct ShellResultants {
  R fxx{}, fyy{}, fxy{}, qx{}, qy{}, mxx{}, myy{}, mxy{};
  R thinning{};  ///< increment of the mean normal strain, where the thickness follows it
  R work{};    ///< of the stresses over the step, per area
  R failed{};  ///< points that have failed
  R intact{};  ///< 0 where those are too many
  R stiffening{1.0};

  /// The same stresses over a thickness `ratio` times as large.
  KARDAN_INLINE void scale(const R& ratio) {
    const R square = ratio * ratio;
    for (R* force : {&fxx, &fyy, &fxy, &qx, &qy}) *force *= ratio;
    for (R* moment : {&mxx, &myy, &mxy}) *moment *= square;
  }
};

/// Adds the resultants of the stress s of a point at height z with weight w, both times half the thickness.
template <class R>
KARDAN_INLINE void add_stress(const PlaneStress<R>& s, const R& z, const R& w, ShellResultants<R>& t) {
  const R wz = w * z;
  t.fxx += w * s.xx;
  t.fyy += w * s.yy;
  t.fxy += w * s.xy;
  t.qy += w * s.yz;
  t.qx += w * s.zx;
  t.mxx += wz * s.xx;
  t.myy += wz * s.yy;
  t.mxy += wz * s.xy;
}

template <class G>
KARDAN_INLINE PlaneStress<G> load_stress(const double* h) {
  return {G::load(h), G::load(h + block_lanes), G::load(h + 2 * block_lanes), G::load(h + 3 * block_lanes), G::load(h + 4 * block_lanes)};
}
template <class G>
KARDAN_INLINE void store_stress(const PlaneStress<G>& s, double* h) {
  s.xx.store(h);
  s.yy.store(h + block_lanes);
  s.xy.store(h + 2 * block_lanes);
  s.yz.store(h + 3 * block_lanes);
  s.zx.store(h + 4 * block_lanes);
}

/// The points of a pack of shells through the thickness, one after the other, or three at a time: with the same operations on each, since
/// it depends on the width of the pack how they are taken.
template <class R, class Law>
struct ThicknessPoints {
  const ShellProperties& p;
  const Law& law;
  const ShellStrains<R>& r;
  const StepTime& step;
  const ShellThickness<R>& thickness;
  double* history;
  const std::size_t next = shell_history_size(p, law.history()) * block_lanes;  ///< from here to the values of the next block

  KARDAN_INLINE double* values(int i) const { return history + static_cast<std::size_t>(i) * shell_point_values(law.history()) * block_lanes; }
  KARDAN_INLINE R height(int i) const { return thickness.half * R(p.zeta[i]) + thickness.offset; }
  KARDAN_INLINE R weight(int i) const { return thickness.half * R(p.weight[i]); }
  /// A point, or three, at t_{n-1}; G is R or a trio.
  template <class G>
  KARDAN_INLINE ShellPoint<G> at(const G& z, const double* h) const {
    ShellPoint<G> point;
    point.stress = load_stress<G>(h);
    point.strain = {G(r.xx) + z * G(r.kxx), G(r.yy) + z * G(r.kyy), G(r.xy) + z * G(r.kxy), G(r.yz), G(r.zx)};
    point.spin = G(R(-0.5) * r.xy);  // the axes follow a line of the material along x, which turns by half of the shear more than it
    return point;
  }
  /// @param twice double the work per volume; @param strain normal increment
  KARDAN_INLINE void add_work(int i, const R& twice, ShellResultants<R>& t) const { t.work += R(0.5) * weight(i) * twice; }
  KARDAN_INLINE void add_thinning(int i, const R& strain, ShellResultants<R>& t) const { t.thinning += R(0.5 * p.weight[i]) * strain; }
  /// Point i to t_n, its resultants added to t. @return with Elastic: false where something yields; nothing has changed then.
  template <bool Elastic>
  KARDAN_INLINE bool add_one(int i, ShellResultants<R>& t) const {
    double* const h = values(i);
    if constexpr (Elastic) {
      ask_for(h + next, 5);
      Law::ask_for_elastic_step(h + next + 5 * block_lanes);
    } else {
      ask_for(h + next, shell_point_values(law.history()));
    }
    const R z = height(i), w = weight(i);
    ShellPoint<R> point = at(z, h);
    const R old_sum = point.stress.xx + point.stress.yy, old_work = contraction(point.stress, point.strain);
    if constexpr (Elastic) {
      if (!law.elastic_step(point, h + 5 * block_lanes)) return false;
    } else {
      law.update(point, step, h + 5 * block_lanes);
    }
    const PlaneStress<R>& s = point.stress;
    store_stress(s, h);
    add_work(i, old_work + contraction(s, point.strain), t);
    if (p.thins) add_thinning(i, point.thickness_strain + R(p.elastic_thinning) * (s.xx + s.yy - old_sum), t);
    t.stiffening = max(t.stiffening, point.stiffening);
    t.failed += point.failed;
    add_stress(s, z, w, t);
    return true;
  }
  /// Points i, i + 1, i + 2, likewise.
  KARDAN_INLINE void add_three(int i, ShellResultants<R>& t) const {
    using Three = PackTrio<shell_point_values(Law::history()) * block_lanes>;
    double* const h = values(i);
    ask_for(h + next, 3 * shell_point_values(law.history()));
    const Three z{height(i), height(i + 1), height(i + 2)};
    ShellPoint<Three> point = at(z, h);
    const PlaneStress<Three>& s = point.stress;
    const Three old_sum = s.xx + s.yy, old_work = contraction(s, point.strain);
    law.update(point, step, h + 5 * block_lanes);
    store_stress(s, h);
    const Three work = old_work + contraction(s, point.strain);
    add_work(i, work.a, t), add_work(i + 1, work.b, t), add_work(i + 2, work.c, t);
    if (p.thins) {
      const Three own = point.thickness_strain + Three(p.elastic_thinning) * (s.xx + s.yy - old_sum);
      add_thinning(i, own.a, t), add_thinning(i + 1, own.b, t), add_thinning(i + 2, own.c, t);
    }
#pragma GCC unroll 1
    for (int k = i; k < i + 3; ++k) add_stress(load_stress<R>(values(k)), height(k), weight(k), t);
  }
};

template <class R, class Law>
KARDAN_INLINE ShellResultants<R> through_thickness(const ShellProperties& p, const Law& law, const ShellStrains<R>& r,
                                                   const StepTime& step, const ShellThickness<R>& thickness, double* history) {
  ShellResultants<R> t;
  const ThicknessPoints<R, Law> points{p, law, r, step, thickness, history};
  int i = 0;
  if constexpr (Law::yields) {
    while (i < p.points && points.template add_one<true>(i, t)) ++i;
    // A return mapping is a chain of roots and divisions: three of them side by side.
    for (; i + 3 <= p.points; i += 3) points.add_three(i, t);
  }
  for (; i < p.points; ++i) points.template add_one<false>(i, t);
  t.intact = select(t.failed < R(p.failing_points), R(1.0), R(0.0));
  return t;
}

/// Hourglass forces at t_n; returns their work over the step.
template <class R>
KARDAN_INLINE R hourglass_forces(const ShellProperties& p, const ShellAxes<R>& s, const ShellStrains<R>& r, R dt, R thickness,
                                 double* history, R (&force)[5]) {
  const R t3 = thickness * thickness * thickness;
  R factor[3];
  if (p.stiffness_hourglass) {
    const R half_b = s.b1[0] * s.b1[0] + s.b1[1] * s.b1[1] + s.b2[0] * s.b2[0] + s.b2[1] * s.b2[1], b = half_b + half_b;
    factor[0] = R(p.hourglass_membrane) * thickness * s.area * b * dt;
    factor[1] = R(p.hourglass_warping) * t3 * b * dt;
    factor[2] = R(p.hourglass_bending) * t3 * s.area * b * dt;
  } else {
    const R root = inverse_sqrt(s.area), side = s.area * root;
    factor[0] = R(p.hourglass_membrane) * thickness * side;
    factor[1] = R(p.hourglass_warping) * t3 * root;
    factor[2] = R(p.hourglass_bending) * t3 * side;
  }
  R power{};
  for (int k = 0; k < 5; ++k) {
    const R own = factor[k < 2 ? 0 : (k == 2 ? 1 : 2)] * r.q[k];
    const R old = R::load(history + k * block_lanes);
    force[k] = p.stiffness_hourglass ? old + own : own;
    power += (old + force[k]) * r.q[k];
    force[k].store(history + k * block_lanes);
  }
  return R(0.5) * power * dt;
}

template <class R>
KARDAN_INLINE R stable_step(const ShellProperties& p, const ShellAxes<R>& s, const Vec3T<R> (&x)[4], R triangle, R stiffening) {
  R longest{};
  if (p.side_lengths) {
    for (int a = 0; a < 4; ++a) {
      const Vec3T<R> d = x[(a + 1) % 4] - x[a];
      longest = max(longest, dot(d, d));
    }
  } else {
    const Vec3T<R> d1 = x[2] - x[0], d2 = x[3] - x[1];
    longest = max(dot(d1, d1), dot(d2, d2));
  }
  return (R(1.0) + triangle) * s.area * inverse_sqrt(longest * stiffening) * R(1.0 / p.wave_speed);
}

/// Forces and moments on the nodes, global components. Nodes 1 and 3, and 2 and 4, have the same up to signs:
///   f1 = A + H, f3 = -A + H, f2 = B - H, f4 = -B - H, likewise the moments but for the transverse shears N A (-q_y, q_x).
template <class R>
KARDAN_INLINE void nodal_forces(const ShellAxes<R>& s, const ShellResultants<R>& t, const R (&hg)[5], const R (&n)[2],
                                NodalForces<4, 6>& force, std::size_t first) {
  const auto global = [&s](const R& x, const R& y, const R& z) { return s.e1 * x + s.e2 * y + s.e3 * z; };
  const auto turned = [&s](const R& x, const R& y) { return s.e1 * x + s.e2 * y; };
  Vec3T<R> f[2], m[2];
  for (int i = 0; i < 2; ++i) {
    const R b1 = s.area * s.b1[i], b2 = s.area * s.b2[i], a = s.a[i];
    f[i] = global(b1 * t.fxx + b2 * t.fxy - a * hg[0], b2 * t.fyy + b1 * t.fxy - a * hg[1],
                  b1 * t.qx + b2 * t.qy + (s.b1[i] * hg[0] + s.b2[i] * hg[1]) * s.gamma_z - a * hg[2]);
    m[i] = turned(-(b2 * t.myy + b1 * t.mxy) - a * hg[3], b1 * t.mxx + b2 * t.mxy - a * hg[4]);
  }
  const Vec3T<R> hf = global(hg[0], hg[1], hg[2]), hm = turned(hg[3], hg[4]), q = turned(-(s.area * t.qy), s.area * t.qx);
  const Vec3T<R> q12 = q * n[0], q34 = q * n[1];
  force.set(0, first, hf + f[0], q12 + hm + m[0]);
  force.set(1, first, f[1] - hf, q12 - hm + m[1]);
  force.set(2, first, hf - f[0], q34 + hm - m[0]);
  force.set(3, first, -f[1] - hf, q34 - hm - m[1]);
}

/// The lanes in which two nodes of the elements are the same.
KARDAN_INLINE Pack::Mask same_index(const std::uint16_t* a, const std::uint16_t* b) {
  typedef std::uint16_t Indices __attribute__((vector_size(native_lanes * sizeof(std::uint16_t))));
  return __builtin_convertvector(load_as<Indices>(a), Pack::Mask) == __builtin_convertvector(load_as<Indices>(b), Pack::Mask);
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Law>
KARDAN_INLINE void shell_pack(const ShellProperties& p, const Law& law, const TileWork& work, const std::uint16_t* connectivity,
                              ShellBlock& block, double* history, std::size_t first) {
  const R dt(work.step.dt), half_dt(0.5 * work.step.dt), zero(0.0);
  const auto triangle = same_index(connectivity + 2 * block_lanes + first, connectivity + 3 * block_lanes + first);
  const R n[2] = {select(triangle, R(1.0 / 3.0), R(0.25)), select(triangle, R(1.0 / 6.0), R(0.25))};
  history += first;
  double* kept = history + static_cast<std::size_t>(p.points) * shell_point_values(law.history()) * block_lanes;
  const ShellThickness<R> thickness(p, kept);
  const std::uint16_t* const index = connectivity + first;
  const auto gathered = [&](std::size_t a, std::size_t vector) {
    return gather_vectors<node_stride(6)>(work.node + 4 * vector, index + a * block_lanes);
  };
  const Vec3T<R> x[4] = {gathered(0, 0), gathered(1, 0), gathered(2, 0), gathered(3, 0)};
  const Vec3T<R> v[4] = {gathered(0, 1), gathered(1, 1), gathered(2, 1), gathered(3, 1)};
  const Vec3T<R> middle[4] = {x[0] - v[0] * half_dt, x[1] - v[1] * half_dt, x[2] - v[2] * half_dt, x[3] - v[3] * half_dt};
  ShellAxes<R> before, now;
  shell_axes(middle, x, before, now);
  R hg[5];
  ShellResultants<R> t;
  {
    const Vec3T<R> w[4] = {gathered(0, 2), gathered(1, 2), gathered(2, 2), gathered(3, 2)};
    const ShellStrains<R> strains = shell_strains(before, v, w, n, dt);
    t = through_thickness(p, law, strains, work.step, thickness, history);
    const R active = R::load(block.alive + first);
    select(active > zero, t.work * before.area, zero).store(block.internal + first);
    ask_for(kept + shell_history_size(p, law.history()) * block_lanes, shell_history_size(p, 0) - shell_kept(p, 0));
    const R hourglass_work = hourglass_forces(p, before, strains, dt, thickness.value, kept, hg);
    select(active > zero, hourglass_work, zero).store(block.hourglass + first);
    (active * t.intact).store(block.alive + first);
  }
  if (p.thins) t.scale(thickness.update(p, t.thinning));
  stable_step(p, now, x, select(triangle, R(1.0), zero), t.stiffening).store(block.time_step + first);
  nodal_forces(now, t, hg, n, block.force, first);
}

/// The loop over a tile of shells of any formulation; Law is Inlined or Called, `pack` computes the lanes from `first` on.
template <class Law, class ElementPack>
KARDAN_INLINE void for_each_shell_pack(TileWork& work, ElementPack&& pack) {
  const ShellProperties& p = *static_cast<const ShellProperties*>(work.properties);
  const Law law(p.law);
  ShellBlock block;
  for_each_block<4, 6>(work, shell_history_size(p, law.history()), block,
                       [&](const std::uint16_t* connectivity, std::size_t, double* history) {
                         for (std::size_t first = 0; first < block_lanes; first += Pack::lanes) {
                           pack(p, law, connectivity, block, history, first);
                         }
                         block.force.scatter(connectivity, block.alive, work.sum);
                       });
}

template <class Law>
void shell_tile(TileWork& work) {
  for_each_shell_pack<Law>(work, [&work](const ShellProperties& p, const Law& law, const std::uint16_t* connectivity, ShellBlock& block,
                                         double* history, std::size_t first) {
    shell_pack<Pack>(p, law, work, connectivity, block, history, first);
  });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

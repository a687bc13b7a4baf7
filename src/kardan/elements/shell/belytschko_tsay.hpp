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
//   membrane  Q = QM rho c h sqrt(A)/4 q; bending and warping in the same proportion to it as above, B A = 2    (IHQ 1, 2, 3)
// The viscous constants are Kardan's reading: Flanagan and Belytschko 1981, QM rho V^(2/3) c/4, with h sqrt(A) for V^(2/3).
// On a warped element g.z = 4 z0 does not vanish, and a rigid rotation would feed the in-plane rates. The element's own spin
// about x and y, b2.vz and -b1.vz, is taken out of them, and the conjugate forces (b1 Qx + b2 Qy) g.z are added to fz: the
// hourglass forces then do no work in a rigid rotation and have no resultant moment. (LS-DYNA leaves this term out.)
#pragma once

#include "kardan/base/vec3.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/elements/tiles/tile_loop.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

template <class R>
struct ShellAxes {
  Vec3T<R> e1, e2, e3;
  R x[4], y[4];  ///< coordinates of the nodes from node 1
  R b1[4], b2[4];
  R area;
  R gamma_z;     ///< g.z
};

template <class R>
KARDAN_INLINE ShellAxes<R> shell_axes(const Vec3T<R> (&p)[4]) {
  ShellAxes<R> s;
  const Vec3T<R> normal = cross(p[2] - p[0], p[3] - p[1]);
  const R length = sqrt(dot(normal, normal));
  s.e3 = normal * (R(1.0) / length);
  const Vec3T<R> side = p[1] - p[0], flat = side - s.e3 * dot(side, s.e3);
  s.e1 = flat * (R(1.0) / sqrt(dot(flat, flat)));
  s.e2 = cross(s.e3, s.e1);
  s.area = R(0.5) * length;
  R z[4];
  for (int a = 0; a < 4; ++a) {
    const Vec3T<R> d = p[a] - p[0];
    s.x[a] = dot(d, s.e1);
    s.y[a] = dot(d, s.e2);
    z[a] = dot(d, s.e3);
  }
  s.gamma_z = z[0] - z[1] + z[2] - z[3];
  const R f = R(1.0) / length;  // 1/(2A)
  s.b1[0] = (s.y[1] - s.y[3]) * f;
  s.b1[1] = (s.y[2] - s.y[0]) * f;
  s.b1[2] = -s.b1[0];
  s.b1[3] = -s.b1[1];
  s.b2[0] = (s.x[3] - s.x[1]) * f;
  s.b2[1] = (s.x[0] - s.x[2]) * f;
  s.b2[2] = -s.b2[0];
  s.b2[3] = -s.b2[1];
  return s;
}

/// g of the hourglass modes.
template <class R>
KARDAN_INLINE void hourglass_shape(const ShellAxes<R>& s, R (&g)[4]) {
  const R hx = s.x[0] - s.x[1] + s.x[2] - s.x[3], hy = s.y[0] - s.y[1] + s.y[2] - s.y[3];
  for (int a = 0; a < 4; ++a) g[a] = R(a % 2 == 0 ? 1.0 : -1.0) - hx * s.b1[a] - hy * s.b2[a];
}

/// Nodal values of a block, gathered: [node][component][lane].
struct ShellBlock : BlockReport {
  double x[4][3][block_lanes];
  double v[4][6][block_lanes];
  double share[2][block_lanes];  ///< N of nodes 1, 2 and of nodes 3, 4
  double triangle[block_lanes];  ///< 1 or 0
  double force[4][6][block_lanes];
};

/// Rates of the generalised strains of one element in its axes.
template <class R>
struct ShellRates {
  R xx{}, yy{}, xy{}, yz{}, zx{};     ///< at the surface of the nodes
  R kxx{}, kyy{}, kxy{};              ///< per height
  R q[5]{};                           ///< hourglass: vx, vy, vz, wx, wy
};

template <class R>
KARDAN_INLINE ShellRates<R> shell_rates(const ShellAxes<R>& s, const R (&g)[4], const Vec3T<R> (&v)[4], const Vec3T<R> (&w)[4],
                                        const R (&n)[4]) {
  ShellRates<R> r;
  R tilt_x{}, tilt_y{};  // b2.vz and b1.vz
  for (int a = 0; a < 4; ++a) {
    const R vx = dot(v[a], s.e1), vy = dot(v[a], s.e2), vz = dot(v[a], s.e3);
    const R wx = dot(w[a], s.e1), wy = dot(w[a], s.e2);
    r.xx += s.b1[a] * vx;
    r.yy += s.b2[a] * vy;
    r.xy += s.b2[a] * vx + s.b1[a] * vy;
    r.kxx += s.b1[a] * wy;
    r.kyy -= s.b2[a] * wx;
    r.kxy += s.b2[a] * wy - s.b1[a] * wx;
    tilt_x += s.b2[a] * vz;
    tilt_y += s.b1[a] * vz;
    r.yz -= n[a] * wx;
    r.zx += n[a] * wy;
    r.q[0] += g[a] * vx;
    r.q[1] += g[a] * vy;
    r.q[2] += g[a] * vz;
    r.q[3] += g[a] * wx;
    r.q[4] += g[a] * wy;
  }
  r.yz += tilt_x;
  r.zx += tilt_y;
  r.q[0] += tilt_y * s.gamma_z;
  r.q[1] += tilt_x * s.gamma_z;
  return r;
}

/// Resultants over the thickness.
template <class R>
struct ShellResultants {
  R fxx{}, fyy{}, fxy{}, qx{}, qy{}, mxx{}, myy{}, mxy{};
  R work{};    ///< of the stresses over the step, per area
  R intact{};  ///< 0 where too many points have failed
  R stiffening{1.0};
};

template <class R, class Law>
KARDAN_INLINE ShellResultants<R> through_thickness(const ShellProperties& p, const Law& law, const ShellRates<R>& r,
                                                   const StepTime& step, R half, double* history) {
  const R dt(step.dt);
  ShellResultants<R> t;
  R failed{};
  const R spin = R(-0.5) * r.xy * dt;  // the axes follow a line of the material along x, which turns by half of the shear more than it
  for (int i = 0; i < p.points; ++i) {
    double* h = history + static_cast<std::size_t>(i) * shell_point_values(law.history()) * block_lanes;
    ShellPoint<R> point;
    PlaneStress<R>& s = point.stress;
    s = {R::load(h), R::load(h + block_lanes), R::load(h + 2 * block_lanes), R::load(h + 3 * block_lanes),
         R::load(h + 4 * block_lanes)};
    const PlaneStress<R> old = s;
    const R z = half * R(p.zeta[i]), w = half * R(p.weight[i]);
    const PlaneStress<R>& d = point.strain = {(r.xx + z * r.kxx) * dt, (r.yy + z * r.kyy) * dt, (r.xy + z * r.kxy) * dt, r.yz * dt, r.zx * dt};
    point.spin = spin;
    law.update(point, step, h + 5 * block_lanes);
    t.stiffening = max(t.stiffening, point.stiffening);
    failed += point.failed;
    t.work += R(0.5) * w * ((old.xx + s.xx) * d.xx + (old.yy + s.yy) * d.yy + (old.xy + s.xy) * d.xy + (old.yz + s.yz) * d.yz +
                            (old.zx + s.zx) * d.zx);
    s.xx.store(h);
    s.yy.store(h + block_lanes);
    s.xy.store(h + 2 * block_lanes);
    s.yz.store(h + 3 * block_lanes);
    s.zx.store(h + 4 * block_lanes);
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
  t.intact = select(failed < R(p.failing_points), R(1.0), R(0.0));
  return t;
}

/// Hourglass forces at t_n; returns their work over the step.
template <class R>
KARDAN_INLINE R hourglass_forces(const ShellProperties& p, const ShellAxes<R>& s, const ShellRates<R>& r, R dt, R thickness,
                                 double* history, R (&force)[5]) {
  const R t3 = thickness * thickness * thickness;
  R factor[3];
  if (p.stiffness_hourglass) {
    R b{};
    for (int a = 0; a < 4; ++a) b += s.b1[a] * s.b1[a] + s.b2[a] * s.b2[a];
    factor[0] = R(p.hourglass_membrane) * thickness * s.area * b * dt;
    factor[1] = R(p.hourglass_warping) * t3 * b * dt;
    factor[2] = R(p.hourglass_bending) * t3 * s.area * b * dt;
  } else {
    const R root = sqrt(s.area);
    factor[0] = R(p.hourglass_membrane) * thickness * root;
    factor[1] = R(p.hourglass_warping) * t3 / root;
    factor[2] = R(p.hourglass_bending) * t3 * root;
  }
  R work{};
  for (int k = 0; k < 5; ++k) {
    const R own = factor[k < 2 ? 0 : (k == 2 ? 1 : 2)] * r.q[k];
    const R old = R::load(history + k * block_lanes);
    force[k] = p.stiffness_hourglass ? old + own : own;
    work += R(0.5) * (old + force[k]) * r.q[k] * dt;
    force[k].store(history + k * block_lanes);
  }
  return work;
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
  return (R(1.0) + triangle) * s.area / (sqrt(longest * stiffening) * R(p.wave_speed));
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Law>
KARDAN_INLINE void shell_pack(const ShellProperties& p, const Law& law, const StepTime& step, ShellBlock& block, double* history,
                              std::size_t first) {
  const R dt(step.dt), half_dt(0.5 * step.dt), zero(0.0);
  Vec3T<R> x[4], v[4], w[4], middle[4];
  for (int a = 0; a < 4; ++a) {
    for (std::size_t c = 0; c < 3; ++c) {
      x[a][c] = R::load(block.x[a][c] + first);
      v[a][c] = R::load(block.v[a][c] + first);
      w[a][c] = R::load(block.v[a][c + 3] + first);
    }
    middle[a] = x[a] - v[a] * half_dt;
  }
  const R n12 = R::load(block.share[0] + first), n34 = R::load(block.share[1] + first);
  const R n[4] = {n12, n12, n34, n34};
  history += first;
  double* kept = history + static_cast<std::size_t>(p.points) * shell_point_values(law.history()) * block_lanes;
  const R thickness = R::load(kept + 5 * block_lanes);

  R g[4], hg[5], active;
  ShellResultants<R> t;
  {
    const ShellAxes<R> s = shell_axes(middle);
    hourglass_shape(s, g);
    const ShellRates<R> rates = shell_rates(s, g, v, w, n);
    t = through_thickness(p, law, rates, step, R(0.5) * thickness, history);
    active = R::load(block.alive + first);
    select(active > zero, t.work * s.area, zero).store(block.internal + first);
    const R hourglass_work = hourglass_forces(p, s, rates, dt, thickness, kept, hg);
    select(active > zero, hourglass_work, zero).store(block.hourglass + first);
  }

  active = active * t.intact;
  active.store(block.alive + first);
  const auto alive = active > zero;
  const ShellAxes<R> s = shell_axes(x);
  hourglass_shape(s, g);
  stable_step(p, s, x, R::load(block.triangle + first), t.stiffening).store(block.time_step + first);
  for (int a = 0; a < 4; ++a) {
    const R fx = s.area * (s.b1[a] * t.fxx + s.b2[a] * t.fxy) + g[a] * hg[0];
    const R fy = s.area * (s.b2[a] * t.fyy + s.b1[a] * t.fxy) + g[a] * hg[1];
    const R fz = s.area * (s.b1[a] * t.qx + s.b2[a] * t.qy) + g[a] * hg[2] + (s.b1[a] * hg[0] + s.b2[a] * hg[1]) * s.gamma_z;
    const R mx = g[a] * hg[3] - s.area * (s.b2[a] * t.myy + s.b1[a] * t.mxy + n[a] * t.qy);
    const R my = g[a] * hg[4] + s.area * (s.b1[a] * t.mxx + s.b2[a] * t.mxy + n[a] * t.qx);
    const Vec3T<R> f = s.e1 * fx + s.e2 * fy + s.e3 * fz, m = s.e1 * mx + s.e2 * my;
    for (std::size_t c = 0; c < 3; ++c) {
      select(alive, f[c], zero).store(block.force[a][c] + first);
      select(alive, m[c], zero).store(block.force[a][c + 3] + first);
    }
  }
}

KARDAN_INLINE void gather(const TileWork& work, const std::uint16_t* connectivity, ShellBlock& block) {
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t l = 0; l < block_lanes; ++l) {
      const double* node = work.node + node_stride(6) * connectivity[a * block_lanes + l];
      for (std::size_t c = 0; c < 3; ++c) {
        block.x[a][c][l] = node[c];
        block.v[a][c][l] = node[c + 4];
        block.v[a][c + 3][l] = node[c + 8];
      }
    }
  }
  for (std::size_t l = 0; l < block_lanes; ++l) {
    const bool triangle = connectivity[2 * block_lanes + l] == connectivity[3 * block_lanes + l];
    block.triangle[l] = triangle ? 1.0 : 0.0;
    block.share[0][l] = triangle ? 1.0 / 3.0 : 0.25;
    block.share[1][l] = triangle ? 1.0 / 6.0 : 0.25;
  }
}

KARDAN_INLINE void scatter(const TileWork& work, const std::uint16_t* connectivity, std::size_t lanes, const ShellBlock& block) {
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t l = 0; l < lanes; ++l) {
      double* f = work.force + 6 * connectivity[a * block_lanes + l];
      for (std::size_t c = 0; c < 6; ++c) f[c] -= block.force[a][c][l];
    }
  }
}

/// A tile; Law is Inlined or Called.
template <class Law>
void shell_tile(TileWork& work) {
  const ShellProperties& p = *static_cast<const ShellProperties*>(work.properties);
  const Law law(p.law);
  ShellBlock block;
  for_each_block<4>(work, 6, shell_history_size(p.points, law.history()), block,
                    [&](const std::uint16_t* connectivity, std::size_t lanes, double* history) {
                      gather(work, connectivity, block);
                      for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) {
                        shell_pack<Pack>(p, law, work.step, block, history, l);
                      }
                      scatter(work, connectivity, lanes, block);
                    });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

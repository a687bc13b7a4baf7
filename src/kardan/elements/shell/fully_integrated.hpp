// The fully integrated shell (ELFORM 16) and membrane (ELFORM 9): four nodes, 2 x 2 points in the plane, co-rotational.
// Included by translation units that are compiled for one instruction set each; see base/simd.hpp.
//
// Axes, mean gradients b1, b2 and hourglass rates q = g.v are those of belytschko_tsay.hpp. The gradients of the bilinear shape functions
// are exactly N,x = b1 + h,x g/4 with h = xi eta, so what a Gauss point has beside the mean strains comes from q alone:
//   d_xx += (h,x q_x + c h,y q_y)/4,   d_yy += (h,y q_y + c h,x q_x)/4,   2 d_xy += 0,
//   kxx += h,x q_wy/4,   kyy -= h,y q_wx/4,   kxy += (h,y q_wy - h,x q_wx)/4.
// The in-plane strains are assumed ones that bend in the plane without locking: the shear is the mean one, and c = -nu gives the
// strips across a bending beam their lateral contraction (Belytschko and Bindeman 1991, Comput. Meth. Appl. Mech. Eng. 88,
// 311-340, "ASQBI"). The transverse shears are interpolated from the middles of the edges, in natural coordinates (Dvorkin and
// Bathe 1984, Eng. Comput. 1, 77-88):
//   g_xi = (1 - eta)/2 g_12 + (1 + eta)/2 g_43,   g_eta = (1 - xi)/2 g_14 + (1 + xi)/2 g_23,
//   g_ij = (w_j - w_i)/2 + ((wy_i + wy_j)/2 dx - (wx_i + wx_j)/2 dy)/2,   2 d_zx = xi,x g_xi + eta,x g_eta, 2 d_yz likewise,
// so thin plates do not lock. Every mode but those of rigid motion and of the spins about the normal is stiff: there is no hourglass control.
// Sources of the element: Hallquist, LS-DYNA Theory Manual 2006, "Fully integrated shell (Type 16)"; Engelmann, Whirley and Goudreau 1989.
#pragma once

#include "kardan/elements/shell/belytschko_tsay.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// x = xr xi + xs eta + xh xi eta, likewise y, from the middle of the element in its axes.
template <class R>
struct PlaneModes {
  R xr, xs, xh, yr, ys, yh;

  KARDAN_INLINE explicit PlaneModes(const ShellAxes<R>& s) {
    const R half(0.5), area = s.area;
    // The diagonals are (-b2, b1) 2 A of node 2, and (b2, -b1) 2 A of node 1.
    const R x13 = -s.b2[1], x24 = s.b2[0], y13 = s.b1[1], y24 = -s.b1[0];
    xr = half * (x13 - x24) * area;
    xs = half * (x13 + x24) * area;
    yr = half * (y13 - y24) * area;
    ys = half * (y13 + y24) * area;
    xh = R(0.25) * s.hx;
    yh = R(0.25) * s.hy;
  }
};

/// A Gauss point: determinant of the Jacobian, gradients of xi, eta and h.
template <class R>
struct PlanePoint {
  double xi, eta;
  R jacobian, rx, ry, sx, sy, hx, hy;

  KARDAN_INLINE PlanePoint(const PlaneModes<R>& m, int g) {
    constexpr double place = 0.57735026918962576;  // 1/sqrt(3)
    xi = g == 0 || g == 3 ? -place : place;
    eta = g < 2 ? -place : place;
    const R x_r = m.xr + R(eta) * m.xh, x_s = m.xs + R(xi) * m.xh, y_r = m.yr + R(eta) * m.yh, y_s = m.ys + R(xi) * m.yh;
    jacobian = x_r * y_s - x_s * y_r;
    const R inverse = R(1.0) / jacobian;
    rx = y_s * inverse;
    ry = -x_s * inverse;
    sx = -y_r * inverse;
    sy = x_r * inverse;
    hx = R(eta) * rx + R(xi) * sx;
    hy = R(eta) * ry + R(xi) * sy;
  }
};

/// Natural shears at the middles of the edges, or the forces that do work on them.
template <class R>
struct EdgeShears {
  R e12{}, e43{}, e14{}, e23{};
};

template <class R>
KARDAN_INLINE EdgeShears<R> edge_shears(const ShellAxes<R>& s, const PlaneModes<R>& m, const Vec3T<R> (&v)[4], const Vec3T<R> (&w)[4], const R& dt) {
  const auto edge = [&](int i, int j, const R& dx, const R& dy) {
    const Vec3T<R> turn = w[i] + w[j];
    return R(0.5) * (dot(v[j] - v[i], s.e3) + dot(turn, s.e2) * dx - dot(turn, s.e1) * dy) * dt;
  };
  return {edge(0, 1, m.xr - m.xh, m.yr - m.yh), edge(3, 2, m.xr + m.xh, m.yr + m.yh), edge(0, 3, m.xs - m.xh, m.ys - m.yh),
          edge(1, 2, m.xs + m.xh, m.ys + m.yh)};
}

/// Strain increments at a Gauss point from the mean ones and the hourglass rates.
template <class R>
KARDAN_INLINE ShellStrains<R> strains_at(const PlanePoint<R>& at, const ShellStrains<R>& mean, const EdgeShears<R>& e, const R& cross, const R& dt) {
  const R quarter = R(0.25) * dt, hx = quarter * at.hx, hy = quarter * at.hy;
  const R xx = hx * mean.q[0], yy = hy * mean.q[1];
  ShellStrains<R> d = mean;
  d.xx += xx + cross * yy;
  d.yy += yy + cross * xx;
  d.kxx += hx * mean.q[4];
  d.kyy -= hy * mean.q[3];
  d.kxy += hy * mean.q[4] - hx * mean.q[3];
  const R along_r = R(0.5 * (1 - at.eta)) * e.e12 + R(0.5 * (1 + at.eta)) * e.e43;
  const R along_s = R(0.5 * (1 - at.xi)) * e.e14 + R(0.5 * (1 + at.xi)) * e.e23;
  d.zx = at.rx * along_r + at.sx * along_s;
  d.yz = at.ry * along_r + at.sy * along_s;
  return d;
}

/// What the stresses of all points do work on: mean strains (times the area), hourglass rates, edge shears.
template <class R>
struct PlaneForces {
  ShellResultants<R> mean;
  R q[5]{};
  EdgeShears<R> e;

  KARDAN_INLINE void add(const PlanePoint<R>& at, const ShellResultants<R>& t, const R& cross) {
    const R j = at.jacobian, hx = R(0.25) * j * at.hx, hy = R(0.25) * j * at.hy;
    mean.fxx += j * t.fxx;
    mean.fyy += j * t.fyy;
    mean.fxy += j * t.fxy;
    mean.mxx += j * t.mxx;
    mean.myy += j * t.myy;
    mean.mxy += j * t.mxy;
    q[0] += hx * (t.fxx + cross * t.fyy);
    q[1] += hy * (t.fyy + cross * t.fxx);
    q[3] -= hy * t.myy + hx * t.mxy;
    q[4] += hx * t.mxx + hy * t.mxy;
    const R along_r = R(0.5) * j * (at.rx * t.qx + at.ry * t.qy), along_s = R(0.5) * j * (at.sx * t.qx + at.sy * t.qy);
    e.e12 += R(1 - at.eta) * along_r;
    e.e43 += R(1 + at.eta) * along_r;
    e.e14 += R(1 - at.xi) * along_s;
    e.e23 += R(1 + at.xi) * along_s;
  }
};

/// Forces and moments on the nodes: those of the mean strains and hourglass rates as in the one-point element, and the edges' own.
template <class R>
KARDAN_INLINE void plane_nodal_forces(const ShellAxes<R>& s, const PlaneModes<R>& m, const PlaneForces<R>& p, NodalForces<4, 6>& force,
                                      std::size_t first) {
  const ShellResultants<R>& t = p.mean;
  Vec3T<R> f[4], moment[4];  // in the element's axes
  for (int i = 0; i < 4; ++i) {
    const R sign(i < 2 ? 1.0 : -1.0), b1 = sign * s.b1[i % 2], b2 = sign * s.b2[i % 2];
    const R g = R(i % 2 == 0 ? 1.0 : -1.0) - sign * s.a[i % 2];
    f[i] = {b1 * t.fxx + b2 * t.fxy + g * p.q[0], b2 * t.fyy + b1 * t.fxy + g * p.q[1], (b1 * p.q[0] + b2 * p.q[1]) * s.gamma_z};
    moment[i] = {g * p.q[3] - b2 * t.myy - b1 * t.mxy, g * p.q[4] + b1 * t.mxx + b2 * t.mxy, R{}};
  }
  const auto edge = [&](int i, int j, const R& shear, const R& dx, const R& dy) {
    const R half = R(0.5) * shear;
    f[i].z -= half;
    f[j].z += half;
    for (const int k : {i, j}) {
      moment[k].x -= half * dy;
      moment[k].y += half * dx;
    }
  };
  edge(0, 1, p.e.e12, m.xr - m.xh, m.yr - m.yh);
  edge(3, 2, p.e.e43, m.xr + m.xh, m.yr + m.yh);
  edge(0, 3, p.e.e14, m.xs - m.xh, m.ys - m.yh);
  edge(1, 2, p.e.e23, m.xs + m.xh, m.ys + m.yh);
  for (std::size_t i = 0; i < 4; ++i) {
    force.set(i, first, s.e1 * f[i].x + s.e2 * f[i].y + s.e3 * f[i].z, s.e1 * moment[i].x + s.e2 * moment[i].y);
  }
}

/// Lanes [first, first + R::lanes) of a block.
template <class R, class Law>
KARDAN_INLINE void fully_integrated_pack(const ShellProperties& p, const Law& law, const TileWork& work, const std::uint16_t* connectivity,
                                         ShellBlock& block, double* history, std::size_t first) {
  const R dt(work.step.dt), half_dt(0.5 * work.step.dt), zero(0.0), cross_strain(p.cross_strain);
  const R n[2] = {R(0.25), R(0.25)};
  history += first;
  const std::size_t of_point = static_cast<std::size_t>(p.points) * shell_point_values(law.history()) * block_lanes;
  ShellThickness<R> thickness(p, history + 4 * of_point);
  Vec3T<R> x[4];
  ShellResultants<R> t[4];
  R intact{}, stiffening(1.0), thinning{};
  {
    Vec3T<R> v[4], w[4], middle[4];
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint16_t* index = connectivity + a * block_lanes + first;
      x[a] = gather_vectors<node_stride(6)>(work.node, index);
      v[a] = gather_vectors<node_stride(6)>(work.node + 4, index);
      w[a] = gather_vectors<node_stride(6)>(work.node + 8, index);
      middle[a] = x[a] - v[a] * half_dt;
    }
    const ShellAxes<R> s = shell_axes(middle);
    const PlaneModes<R> modes(s);
    const ShellStrains<R> mean = shell_strains(s, v, w, n, dt);
    const EdgeShears<R> edges = edge_shears(s, modes, v, w, dt);
    R energy{};
#pragma GCC unroll 1
    for (int g = 0; g < 4; ++g) {
      const PlanePoint<R> at(modes, g);
      const ShellStrains<R> d = strains_at(at, mean, edges, cross_strain, dt);
      t[g] = through_thickness(p, law, d, work.step, thickness, history + static_cast<std::size_t>(g) * of_point);
      energy += at.jacobian * t[g].work;
      intact = max(intact, t[g].intact);
      stiffening = max(stiffening, t[g].stiffening);
      thinning += R(0.25) * t[g].thinning;
    }
    select(R::load(block.alive + first) > zero, energy, zero).store(block.internal + first);
    zero.store(block.hourglass + first);
  }
  (R::load(block.alive + first) * intact).store(block.alive + first);
  const ShellAxes<R> s = shell_axes(x);
  stable_step(p, s, x, zero, stiffening).store(block.time_step + first);
  const PlaneModes<R> modes(s);
  const R ratio = thickness.update(p, thinning);
  PlaneForces<R> forces;
  for (int g = 0; g < 4; ++g) {
    if (p.thins) t[g].scale(ratio);
    forces.add(PlanePoint<R>(modes, g), t[g], cross_strain);
  }
  plane_nodal_forces(s, modes, forces, block.force, first);
}

template <class Law>
void fully_integrated_tile(TileWork& work) {
  for_each_shell_pack<Law>(work, [&work](const ShellProperties& p, const Law& law, const std::uint16_t* connectivity, ShellBlock& block,
                                         double* history, std::size_t first) {
    fully_integrated_pack<Pack>(p, law, work, connectivity, block, history, first);
  });
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

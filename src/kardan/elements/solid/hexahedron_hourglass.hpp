// Hourglass control of the one-point hexahedron.
//
// Modes a = 4 ... 7 of hexahedron_modes.hpp, h_a their sign patterns, g_a = h_a - (8/V) B.x_a, rates q_a = g_a.v = 8 (v_a - L x_a),
// forces g_a Q_a, in coefficients F_a += Q_a and sigma -= (8/V) sum Q_a x_a^T. The vectors g are orthogonal to every linear
// field: constant strains and rotations are free of them, also at distorted elements.
//
// Flanagan and Belytschko 1981, Int. J. Numer. Meth. Eng. 17, 679-706:
//   Q_a = QM rho c V^(2/3)/4 q_a/G                        (IHQ 1, 2, 3)
//   dQ_a/dt = QM (lambda + 2 mu) (B:B/V)/16 q_a/G         (IHQ 4, 5), which turns with the material.
// G is Kardan's, 1 on parallelepipeds: a bound of the largest eigenvalue of g_a.g_b/8 (hourglass_size()). With it no mode of any shape
// decays faster than 8 QM rho c V^(2/3)/(4 m) = 16 QM c/V^(1/3), m = rho V/8, as with the patterns h_a themselves, which LS-DYNA's IHQ 1
// uses: stable where 16 QM c dt < 2 V^(1/3); with c dt <= 0.9 L and L <= V^(1/3) up to QM = 0.139. The vectors g of a flat element warped
// by w across its thickness t are 2 w/t times as long; without G the rate would grow with their square, past 2/dt at a few thicknesses.
//
// Belytschko and Bindeman 1993, Comput. Meth. Appl. Mech. Eng. 105, 225-260, assumed strains of the type ASQBI, as in Hallquist,
// LS-DYNA Theory Manual 2006, "Hourglass control type 6" (IHQ 6): the stiffness that the element's modes have on the brick, without
// shear in bending and with the stress normal to it zero. In axes e_i of the element (e_1 along x_1, e_2 in the plane of x_1 and
// x_2), with half edges l_i = e_i.x_i and the modes numbered 1: st, 2: tr, 3: rs, 4: rst, k another axis than i and j,
//   H_ii = (8/3) l_j l_k/l_i,   H_ij = (8/3) l_k,
//   dQ_ii = mu ((H_jj + H_kk) q_ii + H_ij q_jj + H_ik q_kk)
//   dQ_ij = 2 mu/(1 - nu) (H_ii q_ij + nu H_ij q_ji)
//   dQ_i4 = 2 mu (1 + nu)/3 H_ii q_i4,
// times QM; q_ia is the rate of component i of mode a over 8, because their vectors are gamma = g/8. QM = 1 makes bending of bricks
// exact.
#pragma once

#include "kardan/elements/solid/hexahedron_modes.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Increments of the forces Q of IHQ 6 from the rates of the four modes (rs, st, rt, rst), global axes.
template <class R>
KARDAN_INLINE void assumed_strain_increments(const SolidProperties& p, const Modes<R>& x, const Vec3T<R> (&rate)[4], const R& dt,
                                             Vec3T<R> (&increment)[4]) {
  const R one(1.0), nu(p.poissons_ratio);
  const R l1 = sqrt(dot(x.a[0], x.a[0]));
  const Vec3T<R> e1 = x.a[0] * (one / l1), across = x.a[1] - e1 * dot(e1, x.a[1]);
  const R l2 = sqrt(dot(across, across));
  const Vec3T<R> e2 = across * (one / l2), e3 = cross(e1, e2);
  const R l3 = dot(e3, x.a[2]), third(8.0 / 3.0);
  const R h11 = third * l2 * l3 / l1, h22 = third * l3 * l1 / l2, h33 = third * l1 * l2 / l3;
  const R h12 = third * l3, h23 = third * l1, h13 = third * l2;
  const auto local = [&](const Vec3T<R>& g) { return Vec3T<R>{dot(e1, g), dot(e2, g), dot(e3, g)}; };
  const Vec3T<R> m1 = local(rate[1]), m2 = local(rate[2]), m3 = local(rate[0]), m4 = local(rate[3]);
  const R shear = R(p.hourglass_scale / 64) * dt, bending = shear * R(2.0) / (one - nu);
  const R warping = shear * R(2.0 / 3.0) * (one + nu);
  const Vec3T<R> q1{shear * ((h22 + h33) * m1.x + h12 * m2.y + h13 * m3.z), bending * (h22 * m1.y + nu * h12 * m2.x),
                    bending * (h33 * m1.z + nu * h13 * m3.x)};
  const Vec3T<R> q2{bending * (h11 * m2.x + nu * h12 * m1.y), shear * ((h33 + h11) * m2.y + h12 * m1.x + h23 * m3.z),
                    bending * (h33 * m2.z + nu * h23 * m3.y)};
  const Vec3T<R> q3{bending * (h11 * m3.x + nu * h13 * m1.z), bending * (h22 * m3.y + nu * h23 * m2.z),
                    shear * ((h11 + h22) * m3.z + h13 * m1.x + h23 * m2.y)};
  const Vec3T<R> q4{warping * h11 * m4.x, warping * h22 * m4.y, warping * h33 * m4.z};
  const auto global = [&](const Vec3T<R>& l) { return e1 * l.x + e2 * l.y + e3 * l.z; };
  increment[0] = global(q3);
  increment[1] = global(q1);
  increment[2] = global(q2);
  increment[3] = global(q4);
}

/// sum_k a_k a_k^T.
template <int Count, class R>
KARDAN_INLINE SymmetricTensor<R> sum_of_squares(const Vec3T<R>* a) {
  SymmetricTensor<R> s{a->x * a->x, a->y * a->y, a->z * a->z, a->x * a->y, a->y * a->z, a->z * a->x};
  for (int k = 1; k < Count; ++k) {
    s.xx += a[k].x * a[k].x, s.yy += a[k].y * a[k].y, s.zz += a[k].z * a[k].z;
    s.xy += a[k].x * a[k].y, s.yz += a[k].y * a[k].z, s.zx += a[k].z * a[k].x;
  }
  return s;
}

/// Bound of the largest eigenvalue of g_a.g_b/8, 1 on parallelepipeds. With g_a = sum_k P_k (delta_ka - Y_ka), Y_ka = (8/V) b_k.x_a, of
/// the patterns P_k, P_k.P_l = 8 delta_kl, the matrix is Y1^T Y1 + (1 - Y2)^T (1 - Y2), Y1 the rows r, s, t, and Y2 rs, st, rt of Y. The
/// sum of the squares of b_k.x_a over some k and a is that of b_k b_k^T over k, contracted with that of x_a x_a^T over a.
template <class R>
KARDAN_INLINE R hourglass_size(const Modes<R>& x, const MeanGradient<R>& g, const R& inverse_volume) {
  const SymmetricTensor<R> warp = sum_of_squares<4>(x.a + 3);
  const R linear = contraction(sum_of_squares<3>(g.b), warp), own = max(contraction(sum_of_squares<3>(g.b + 3), warp), R(0.0));
  const R f = R(8.0) * inverse_volume, most = R(1.0) + f * sqrt(own);
  return f * f * linear + most * most;
}

/// Factor of the viscous and the stiffness control. `area` V^(2/3).
template <class R>
KARDAN_INLINE R hourglass_scale(const SolidProperties& p, const HexahedronMotion<R>& m, const R& area, const R& dt) {
  const R size = R(p.hourglass_scale) / hourglass_size(m.middle, m.between, m.inverse_between);
  if (p.hourglass == SolidHourglass::viscous) return size * area;
  R bb{};  // an eighth of B:B
  for (int k = 0; k < 6; ++k) bb += dot(m.between.b[k], m.between.b[k]);
  return size * R(8.0) * bb * m.inverse_between * dt;
}

/// Forces of the hourglass modes at t_n on the geometry of the middle of the step; returns their work over the step. `l` is the mean
/// velocity gradient, `q` half of the step's rotation, `scale` the factor of the rates, hourglass_scale() (not for IHQ 6).
template <class R>
KARDAN_INLINE R hourglass_forces(const SolidProperties& p, const HexahedronMotion<R>& m, const Mat3T<R>& l, const Mat3T<R>& q,
                                 const R& scale, const R& dt, double* history, Vec3T<R> (&force)[4]) {
  Vec3T<R> rate[4], own[4];
  const Mat3T<R> l8 = l * R(8.0);
  for (int k = 0; k < 4; ++k) rate[k] = m.v8.a[k + 3] - l8 * m.middle.a[k + 3];
  const bool viscous = p.hourglass == SolidHourglass::viscous;
  if (p.hourglass == SolidHourglass::assumed_strain) {
    assumed_strain_increments(p, m.middle, rate, dt, own);
  } else {
    for (int k = 0; k < 4; ++k) own[k] = rate[k] * scale;
  }
  R twice_power{};
  for (int k = 0; k < 4; ++k) {
    double* h = history + static_cast<std::size_t>(k) * 3 * block_lanes;
    const Vec3T<R> old{R::load(h), R::load(h + block_lanes), R::load(h + 2 * block_lanes)};
    if (viscous) {
      twice_power += dot(old + own[k], rate[k]);
      force[k] = own[k];
    } else {
      const Vec3T<R> before = q * old, after = before + own[k];
      twice_power += dot(before + after, rate[k]);
      force[k] = q * after;
    }
    force[k].x.store(h);
    force[k].y.store(h + block_lanes);
    force[k].z.store(h + 2 * block_lanes);
  }
  return R(0.5) * twice_power * dt;
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

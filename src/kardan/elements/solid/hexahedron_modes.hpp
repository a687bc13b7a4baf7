// The trilinear hexahedron by coefficients of sign patterns instead of nodes.
//
// Sources: Flanagan and Belytschko 1981, Int. J. Numer. Meth. Eng. 17, 679-706 (mean gradient, hourglass vectors).
//
// With natural coordinates r, s, t = +-1 of node I a nodal field is a_I = a0 + a1 r + a2 s + a3 t + a4 rs + a5 st + a6 rt + a7 rst
// (24 additions there, 24 back). With x1 ... x7 of the coordinates the mean gradient operator B_I = dV/dx_I = integral
// of grad N_I has the coefficients
//   B1 = x2 x x3 + (x4 x x6)/3     B4 = (x2 x x5 - x1 x x6)/3
//   B2 = x3 x x1 + (x5 x x4)/3     B5 = (x3 x x6 - x2 x x4)/3
//   B3 = x1 x x2 + (x6 x x5)/3     B6 = (x1 x x4 - x3 x x5)/3,   B0 = B7 = 0   (x between vectors: cross product),
// found by integrating the products of the trilinear map; V = (8/3) sum_a x_a.B_a, mean velocity gradient L = (8/V) sum
// v_a B_a^T, forces of a stress F_a = sigma B_a. They are what Flanagan and Belytschko write out by nodes (their eq. 16
// and appendix).
#pragma once

#include "kardan/elements/solid/solid_point.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Coefficients 1 ... 7 of a nodal field by sign patterns r, s, t, rs, st, rt, rst, at [0] ... [6].
template <class R>
struct Modes {
  Vec3T<R> a[7];
};

/// Eight times the coefficients of nodal values.
template <class R>
KARDAN_INLINE Modes<R> mode_sums(const Vec3T<R> (&n)[8]) {
  const Vec3T<R> s12 = n[0] + n[1], d12 = n[1] - n[0], s43 = n[3] + n[2], d43 = n[2] - n[3];
  const Vec3T<R> s56 = n[4] + n[5], d56 = n[5] - n[4], s87 = n[7] + n[6], d87 = n[6] - n[7];
  const Vec3T<R> low_s = s43 - s12, low_r = d12 + d43, low_rs = d43 - d12;
  const Vec3T<R> high_s = s87 - s56, high_r = d56 + d87, high_rs = d87 - d56;
  return {{low_r + high_r, low_s + high_s, (s56 + s87) - (s12 + s43), low_rs + high_rs, high_s - low_s, high_r - low_r, high_rs - low_rs}};
}

/// Nodal values of coefficients whose constant one is zero.
template <class R>
KARDAN_INLINE void to_nodes(const Modes<R>& m, Vec3T<R> (&n)[8]) {
  const auto layer = [&](const Vec3T<R>& c, const Vec3T<R>& r, const Vec3T<R>& s, const Vec3T<R>& rs, int first) {
    const Vec3T<R> s12 = c - s, s43 = c + s, d12 = r - rs, d43 = r + rs;
    n[first] = s12 - d12;
    n[first + 1] = s12 + d12;
    n[first + 2] = s43 + d43;
    n[first + 3] = s43 - d43;
  };
  layer(-m.a[2], m.a[0] - m.a[5], m.a[1] - m.a[4], m.a[3] - m.a[6], 0);
  layer(m.a[2], m.a[0] + m.a[5], m.a[1] + m.a[4], m.a[3] + m.a[6], 4);
}

/// Mean gradient: coefficients B1 ... B6 and the volume.
template <class R>
struct MeanGradient {
  Vec3T<R> b[6];
  R volume;
};

/// V = 8 (x1.B1 + x2.(x5 x x4)/3 + x3.(x6 x x5)/3): Euler's sum (8/3) sum_a x_a.B_a counts every triple product once for each of its vectors.
template <class R>
KARDAN_INLINE MeanGradient<R> mean_gradient(const Modes<R>& x) {
  const R third(1.0 / 3.0);
  const auto& a = x.a;
  const Vec3T<R> own_s = cross(a[4], a[3]) * third, own_t = cross(a[5], a[4]) * third;
  MeanGradient<R> g{{cross(a[1], a[2]) + cross(a[3], a[5]) * third, cross(a[2], a[0]) + own_s, cross(a[0], a[1]) + own_t,
                     (cross(a[1], a[4]) - cross(a[0], a[5])) * third, (cross(a[2], a[5]) - cross(a[1], a[3])) * third,
                     (cross(a[0], a[3]) - cross(a[2], a[4])) * third},
                    R{}};
  g.volume = R(8.0) * (dot(a[0], g.b[0]) + dot(a[1], own_s) + dot(a[2], own_t));
  return g;
}

/// factor sum_k a_k b_k^T over the given coefficients.
template <int Count, class R>
KARDAN_INLINE Mat3T<R> sum_outer(const Vec3T<R>* a, const Vec3T<R>* b, const R& factor) {
  Mat3T<R> m;
  for (int i = 0; i < 3; ++i) {
    const auto c = static_cast<std::size_t>(i);
    Vec3T<R> row = b[0] * a[0][c];
    for (int k = 1; k < Count; ++k) row += b[k] * a[k][c];
    m[c] = row * factor;
  }
  return m;
}

/// V over the largest of the six faces, half the products of their diagonals (LS-DYNA), and of 4 sqrt(|B_i|^2 + |B_4|^2 + |B_5|^2 +
/// |B_6|^2), i = 1, 2, 3. The latter is the face of a parallelepiped; where an element is folded, its faces' diagonals say little, but
/// its frequency, from 8 c^2 sum B_k B_k^T/V^2 (Flanagan and Belytschko 1984, J. Eng. Mech. 110, 35-40), is high.
///
/// The diagonals of the face t = +-1 are 2 (p + q) and 2 (q - p), p = x1 +- x6 and q = x2 +- x5 the derivatives at its centre: half
/// their product is 4 p x q = 4 (x1 x x2 + x6 x x5 +- (x1 x x5 + x6 x x2)). The others likewise.
template <class R>
KARDAN_INLINE R characteristic_length(const Modes<R>& x, const MeanGradient<R>& g) {
  const auto& a = x.a;
  const auto larger = [](const Vec3T<R>& mean, const Vec3T<R>& difference) {
    const Vec3T<R> n = mean + difference, m = mean - difference;
    return max(dot(n, n), dot(m, m));
  };
  const Vec3T<R> n15 = cross(a[0], a[4]), n26 = cross(a[1], a[5]), n34 = cross(a[2], a[3]);
  const R face = max(max(larger(cross(a[1], a[2]) + cross(a[3], a[5]), n26 - n34), larger(cross(a[2], a[0]) + cross(a[4], a[3]), n34 - n15)),
                     larger(cross(a[0], a[1]) + cross(a[5], a[4]), n15 - n26));
  const auto size = [&](int k) { return dot(g.b[k], g.b[k]); };
  const R folded = max(max(size(0), size(1)), size(2)) + size(3) + size(4) + size(5);
  return g.volume / (R(4.0) * sqrt(max(face, folded)));
}

/// A pack of hexahedra at t_n and in the middle of the step. Components: of the nodes' forces. Divisions stand where their volume is known,
/// with other work behind them: what needs them does not wait then.
template <class R, std::size_t Components = 3>
struct HexahedronMotion {
  Modes<R> x, v8, middle;       ///< positions at t_n, eight times the velocities, positions at t_{n-1/2}
  MeanGradient<R> now, between; ///< of x and of middle
  R inverse_now, inverse_between;  ///< of their volumes
  R length;                     ///< at t_n, for the stable step

  KARDAN_INLINE explicit HexahedronMotion(const PackPlace& place) {
    const PackNodes<8, Components> nodes(place);
    x = mode_sums(nodes.x);
    for (Vec3T<R>& a : x.a) a = a * R(0.125);
    v8 = mode_sums(nodes.v);
    const R sixteenth_dt(0.0625 * place.work.step.dt);
    for (int k = 0; k < 7; ++k) middle.a[k] = x.a[k] - v8.a[k] * sixteenth_dt;
    between = mean_gradient(middle);
    inverse_between = R(1.0) / between.volume;
    now = mean_gradient(x);
    inverse_now = R(1.0) / now.volume;
    length = characteristic_length(x, now);
  }
};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

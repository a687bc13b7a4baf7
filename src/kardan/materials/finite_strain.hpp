// Finite strain for laws that need the whole deformation: the left Cauchy-Green tensor b = F F^T, kept in the history as a tensor that
// the elements turn with the material.
//
// Over a step in which every node moves on a straight line, F_n = (1 - L/2)^-1 (1 + L/2) F_(n-1) exactly, L the velocity gradient on
// the geometry of the middle of the step times dt (Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15, 1862-1867). In axes that
// turn with the material by half of the rotation before and after, L is its symmetric part D and
//   b_n = f b_(n-1) f,   f = (1 - D/2)^-1 (1 + D/2) = 2 (1 - D/2)^-1 - 1,
// exact without rotation, of second order in the step with it. The determinant is then brought to J^2, J = V/V0 of the element, so
// that no error of volume piles up against a large bulk modulus.
#pragma once

#include "kardan/materials/point.hpp"

namespace kardan {

template <class R>
[[gnu::always_inline]] inline R determinant(const SymmetricTensor<R>& s) {
  return s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) + s.zx * (s.xy * s.yz - s.yy * s.zx);
}
template <class R>
[[gnu::always_inline]] inline R trace(const SymmetricTensor<R>& s) {
  return s.xx + s.yy + s.zz;
}

/// s s.
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> squared(const SymmetricTensor<R>& s) {
  return {s.xx * s.xx + s.xy * s.xy + s.zx * s.zx, s.xy * s.xy + s.yy * s.yy + s.yz * s.yz, s.zx * s.zx + s.yz * s.yz + s.zz * s.zz,
          s.xx * s.xy + s.xy * s.yy + s.zx * s.yz, s.xy * s.zx + s.yy * s.yz + s.yz * s.zz, s.xx * s.zx + s.xy * s.yz + s.zx * s.zz};
}

/// a s + c 1.
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> scaled(const SymmetricTensor<R>& s, const R& a, const R& c) {
  return {a * s.xx + c, a * s.yy + c, a * s.zz + c, a * s.xy, a * s.yz, a * s.zx};
}

/// f b f.
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> stretched(const SymmetricTensor<R>& b, const SymmetricTensor<R>& f) {
  // Rows of f b, then times f.
  const R x0 = f.xx * b.xx + f.xy * b.xy + f.zx * b.zx, x1 = f.xx * b.xy + f.xy * b.yy + f.zx * b.yz,
          x2 = f.xx * b.zx + f.xy * b.yz + f.zx * b.zz;
  const R y0 = f.xy * b.xx + f.yy * b.xy + f.yz * b.zx, y1 = f.xy * b.xy + f.yy * b.yy + f.yz * b.yz,
          y2 = f.xy * b.zx + f.yy * b.yz + f.yz * b.zz;
  const R z0 = f.zx * b.xx + f.yz * b.xy + f.zz * b.zx, z1 = f.zx * b.xy + f.yz * b.yy + f.zz * b.yz,
          z2 = f.zx * b.zx + f.yz * b.yz + f.zz * b.zz;
  return {x0 * f.xx + x1 * f.xy + x2 * f.zx, y0 * f.xy + y1 * f.yy + y2 * f.yz, z0 * f.zx + z1 * f.yz + z2 * f.zz,
          x0 * f.xy + x1 * f.yy + x2 * f.yz, y0 * f.zx + y1 * f.yz + y2 * f.zz, x0 * f.zx + x1 * f.yz + x2 * f.zz};
}

/// f = 2 (1 - d/2)^-1 - 1 of a strain increment d.
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> stretch_of_step(const SymmetricTensor<R>& d) {
  const SymmetricTensor<R> a = scaled(d, R(-0.5), R(1.0));
  const R f = R(2.0) / determinant(a);
  return {f * (a.yy * a.zz - a.yz * a.yz) - R(1.0), f * (a.zz * a.xx - a.zx * a.zx) - R(1.0), f * (a.xx * a.yy - a.xy * a.xy) - R(1.0),
          f * (a.yz * a.zx - a.xy * a.zz),          f * (a.xy * a.zx - a.xx * a.yz),          f * (a.xy * a.yz - a.yy * a.zx)};
}

/// Deformation of a point at t_n.
template <class R>
struct Deformation {
  SymmetricTensor<R> b;
  R volume;  ///< J

  /// Brings the b that the history begins with to t_n.
  [[gnu::always_inline]] static Deformation advance(const MaterialPoint<R>& p, double* history) {
    Deformation d;
    d.b = stretched(load_tensor<R>(history), stretch_of_step(p.strain));
    const R det = determinant(d.b), zero(0.0);
    const auto given = p.volume > zero;
    d.volume = select(given, p.volume, sqrt(det));
    // The cube root of 1 + e to e^2; what is left of e is met again in the next step.
    const R e = select(given, d.volume * d.volume / det - R(1.0), zero), third(1.0 / 3.0);
    d.b = scaled(d.b, R(1.0) + e * third * (R(1.0) - e * third), zero);
    store_tensor(d.b, history);
    return d;
  }
};

/// b at the start.
inline void start_deformation(double* values) {
  for (int i = 0; i < 6; ++i) values[i] = i < 3 ? 1.0 : 0.0;
}

/// Largest eigenvalue of a symmetric tensor, from above: mean + sqrt(2/3) |deviator|; exact where the two smaller ones are equal.
template <class R>
[[gnu::always_inline]] inline R largest_principal_bound(const SymmetricTensor<R>& s) {
  const R mean = trace(s) * R(1.0 / 3.0);
  const SymmetricTensor<R> deviator = scaled(s, R(1.0), -mean);
  return mean + sqrt(R(2.0 / 3.0) * contraction(deviator, deviator));
}

}  // namespace kardan

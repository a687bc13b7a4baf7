// Derivatives of trilinear fields at a point of a hexahedron.
//
// A field of coefficients a_k (hexahedron_modes.hpp) has the derivatives
//   a_r = a1 + s a4 + t a6 + st a7,   a_s = a2 + r a4 + t a5 + rt a7,   a_t = a3 + s a5 + r a6 + rs a7.
// With c_r = x_s x x_t, c_s = x_t x x_r, c_t = x_r x x_s and J = x_r.c_r the gradient of a velocity is (v_r c_r^T + v_s c_s^T + v_t c_t^T)/J.
#pragma once

#include "kardan/elements/solid/hexahedron_modes.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// Derivatives of a field with respect to r, s, t at a point.
template <class R>
struct NaturalGradient {
  Vec3T<R> r, s, t;

  KARDAN_INLINE NaturalGradient(const Modes<R>& m, const R& pr, const R& ps, const R& pt)
      : r(m.a[0] + m.a[3] * ps + m.a[5] * pt + m.a[6] * (ps * pt)),
        s(m.a[1] + m.a[3] * pr + m.a[4] * pt + m.a[6] * (pr * pt)),
        t(m.a[2] + m.a[4] * ps + m.a[5] * pr + m.a[6] * (pr * ps)) {}
};

/// Adds to the forces on the modes what fr, fs, ft on the derivatives mean: the transpose of NaturalGradient.
template <class R>
KARDAN_INLINE void add_mode_forces(Modes<R>& f, const R& r, const R& s, const R& t, const Vec3T<R>& fr, const Vec3T<R>& fs, const Vec3T<R>& ft) {
  f.a[0] += fr;
  f.a[1] += fs;
  f.a[2] += ft;
  f.a[3] += fr * s + fs * r;
  f.a[4] += fs * t + ft * s;
  f.a[5] += fr * t + ft * r;
  f.a[6] += fr * (s * t) + fs * (r * t) + ft * (r * s);
}

/// c_r, c_s, c_t and J of the positions' derivatives.
template <class R>
struct Cofactors {
  Vec3T<R> r, s, t;
  R jacobian;

  KARDAN_INLINE explicit Cofactors(const NaturalGradient<R>& x)
      : r(cross(x.s, x.t)), s(cross(x.t, x.r)), t(cross(x.r, x.s)), jacobian(dot(x.r, r)) {}
};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

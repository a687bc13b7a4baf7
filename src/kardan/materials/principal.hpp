// Principal values and directions of symmetric tensors, on packs and without branches that could change a lane.
//
// Cyclic rotations of Jacobi 1846, J. reine angew. Math. 30, 51-94, in the form of Rutishauser 1966, Numer. Math. 9, 1-10. A lane whose
// off-diagonal entries are below rounding is left alone, so its bits do not depend on its neighbours; five sweeps are enough for 3 x 3.
#pragma once

#include "kardan/base/vec3.hpp"
#include "kardan/materials/point.hpp"

namespace kardan {

/// s = sum_i value[i] direction[i] direction[i]^T, in no particular order.
template <class R>
struct Principal {
  R value[3];
  Vec3T<R> direction[3];

  /// sum_i v[i] direction[i] direction[i]^T.
  [[gnu::always_inline]] SymmetricTensor<R> assemble(const R (&v)[3]) const {
    SymmetricTensor<R> s;
    for (int i = 0; i < 3; ++i) {
      const Vec3T<R>& n = direction[i];
      const Vec3T<R> w = n * v[i];
      s.xx += w.x * n.x;
      s.yy += w.y * n.y;
      s.zz += w.z * n.z;
      s.xy += w.x * n.y;
      s.yz += w.y * n.z;
      s.zx += w.z * n.x;
    }
    return s;
  }
};

/// One rotation in the plane of two axes with diagonal entries a, b and the off-diagonal ab; c and d couple them to the third axis.
template <class R, class Mask>
[[gnu::always_inline]] inline void jacobi_rotation(const Mask& active, R& a, R& b, R& ab, R& c, R& d, Vec3T<R>& p, Vec3T<R>& q) {
  const R zero(0.0), difference = b - a, twice = ab + ab;
  const R tangent = twice / max(abs(difference) + sqrt(difference * difference + twice * twice), R(1e-300));
  const R t = select(active, select(difference < zero, -tangent, tangent), zero);
  const R cosine = R(1.0) / sqrt(R(1.0) + t * t), sine = t * cosine;
  a -= t * ab;
  b += t * ab;
  ab = select(active, zero, ab);
  const R c_old = c;
  c = cosine * c_old - sine * d;
  d = sine * c_old + cosine * d;
  const Vec3T<R> p_old = p;
  p = p_old * cosine - q * sine;
  q = p_old * sine + q * cosine;
}

template <class R>
[[gnu::always_inline]] inline Principal<R> principal(SymmetricTensor<R> s) {
  const R one(1.0), zero(0.0);
  Vec3T<R> x{one, zero, zero}, y{zero, one, zero}, z{zero, zero, one};
  const R size = contraction(s, s) * R(1e-33);
  for (int sweep = 0; sweep < 5; ++sweep) {
    const auto active = s.xy * s.xy + s.yz * s.yz + s.zx * s.zx > size;
    if (!R::any(active)) break;
    jacobi_rotation(active, s.xx, s.yy, s.xy, s.zx, s.yz, x, y);
    jacobi_rotation(active, s.yy, s.zz, s.yz, s.xy, s.zx, y, z);
    jacobi_rotation(active, s.xx, s.zz, s.zx, s.xy, s.yz, x, z);
  }
  return {{s.xx, s.yy, s.zz}, {x, y, z}};
}

template <class R>
struct PrincipalRange {
  R largest, smallest;
};

template <class R>
[[gnu::always_inline]] inline PrincipalRange<R> principal_range(const SymmetricTensor<R>& s) {
  const Principal<R> p = principal(s);
  return {max(max(p.value[0], p.value[1]), p.value[2]), min(min(p.value[0], p.value[1]), p.value[2])};
}

}  // namespace kardan

// Finite rotations: unit quaternions and the Hughes-Winget increment.
#pragma once

#include <cmath>

#include "kardan/base/vec3.hpp"

namespace kardan {

/// Unit quaternion, scalar first; rotates body components into global ones (body -> world).
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;

  Vec3 vec() const { return {x, y, z}; }
  friend bool operator==(const Quat&, const Quat&) = default;
};

/// Hamilton product: the rotation b followed by the rotation a.
inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

inline Quat conjugate(const Quat& q) { return {q.w, -q.x, -q.y, -q.z}; }

inline Quat normalized(const Quat& q) {
  const double s = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w * s, q.x * s, q.y * s, q.z * s};
}

/// Rotation matrix of a unit quaternion (its columns are the body axes in global components).
inline Mat3 to_matrix(const Quat& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
            {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
            {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}}};
}

/// Quaternion of a proper rotation matrix (Shepperd 1978: the largest component is found first).
Quat from_matrix(const Mat3& rotation);

/// Hughes-Winget increment of eq. (10), (I - S/2)^-1 (I + S/2) with S r = theta x r, as a unit quaternion: it turns by
/// 2 atan(|theta| / 2) about theta, exactly orthogonal whatever the size of theta.
/// Source: Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15, 1862-1867.
inline Quat hughes_winget(const Vec3& theta) {
  const double s = 1.0 / std::sqrt(1.0 + 0.25 * dot(theta, theta));
  return {s, 0.5 * s * theta.x, 0.5 * s * theta.y, 0.5 * s * theta.z};
}

/// exp of a rotation vector (radians).
Quat from_rotation_vector(const Vec3& theta);

/// Rotation vector of a unit quaternion, of length <= pi.
Vec3 to_rotation_vector(const Quat& q);

/// Eigenvalues (ascending) and right-handed orthonormal eigenvectors (columns) of a symmetric tensor, by Jacobi rotations.
struct PrincipalAxes {
  Vec3 values;
  Mat3 axes;
};
PrincipalAxes principal_axes(const Mat3& symmetric);

}  // namespace kardan

// Vectors and 3x3 tensors on a number type R (double, or a SIMD pack of doubles).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace kardan {

/// A vector of three components in one frame; the frame is part of the variable's name where it is not global.
template <class R>
struct Vec3T {
  R x{}, y{}, z{};

  constexpr R& operator[](std::size_t i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr const R& operator[](std::size_t i) const { return i == 0 ? x : (i == 1 ? y : z); }

  constexpr Vec3T& operator+=(const Vec3T& b) { x += b.x; y += b.y; z += b.z; return *this; }
  constexpr Vec3T& operator-=(const Vec3T& b) { x -= b.x; y -= b.y; z -= b.z; return *this; }
  constexpr Vec3T& operator*=(R s) { x *= s; y *= s; z *= s; return *this; }
  friend constexpr Vec3T operator+(Vec3T a, const Vec3T& b) { return a += b; }
  friend constexpr Vec3T operator-(Vec3T a, const Vec3T& b) { return a -= b; }
  friend constexpr Vec3T operator-(const Vec3T& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3T operator*(Vec3T a, R s) { return a *= s; }
  friend constexpr Vec3T operator*(R s, Vec3T a) { return a *= s; }
  friend constexpr Vec3T operator/(const Vec3T& a, R s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const Vec3T&, const Vec3T&) = default;
};

template <class R>
constexpr R dot(const Vec3T<R>& a, const Vec3T<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class R>
constexpr Vec3T<R> cross(const Vec3T<R>& a, const Vec3T<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class R>
R norm(const Vec3T<R>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// a / |a|; the caller has checked that |a| > 0.
template <class R>
Vec3T<R> normalized(const Vec3T<R>& a) {
  return a * (R(1) / norm(a));
}

/// A 3x3 tensor, rows first: m[i][j] is row i, column j.
template <class R>
struct Mat3T {
  std::array<Vec3T<R>, 3> row{};

  constexpr Vec3T<R>& operator[](std::size_t i) { return row[i]; }
  constexpr const Vec3T<R>& operator[](std::size_t i) const { return row[i]; }

  static constexpr Mat3T identity() { return diagonal({R(1), R(1), R(1)}); }
  static constexpr Mat3T diagonal(const Vec3T<R>& d) {
    return {{{{d.x, R(0), R(0)}, {R(0), d.y, R(0)}, {R(0), R(0), d.z}}}};
  }
  static constexpr Mat3T columns(const Vec3T<R>& a, const Vec3T<R>& b, const Vec3T<R>& c) {
    return {{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}}};
  }
  constexpr Vec3T<R> column(std::size_t j) const { return {row[0][j], row[1][j], row[2][j]}; }

  constexpr Mat3T& operator+=(const Mat3T& b) { for (int i = 0; i < 3; ++i) row[i] += b.row[i]; return *this; }
  constexpr Mat3T& operator-=(const Mat3T& b) { for (int i = 0; i < 3; ++i) row[i] -= b.row[i]; return *this; }
  friend constexpr Mat3T operator+(Mat3T a, const Mat3T& b) { return a += b; }
  friend constexpr Mat3T operator-(Mat3T a, const Mat3T& b) { return a -= b; }
  friend constexpr Mat3T operator*(const Mat3T& a, R s) { return {{{a[0] * s, a[1] * s, a[2] * s}}}; }
  friend constexpr Mat3T operator*(R s, const Mat3T& a) { return a * s; }
  friend constexpr Vec3T<R> operator*(const Mat3T& a, const Vec3T<R>& b) {
    return {dot(a[0], b), dot(a[1], b), dot(a[2], b)};
  }
  friend constexpr Mat3T operator*(const Mat3T& a, const Mat3T& b) {
    Mat3T c;
    for (int i = 0; i < 3; ++i) c[i] = b[0] * a[i].x + b[1] * a[i].y + b[2] * a[i].z;
    return c;
  }
  friend constexpr bool operator==(const Mat3T&, const Mat3T&) = default;
};

template <class R>
constexpr Mat3T<R> transpose(const Mat3T<R>& a) {
  return Mat3T<R>::columns(a[0], a[1], a[2]);
}

template <class R>
constexpr Mat3T<R> outer(const Vec3T<R>& a, const Vec3T<R>& b) {
  return {{{b * a.x, b * a.y, b * a.z}}};
}

/// The tensor S of eq. (11): S r = a x r.
template <class R>
constexpr Mat3T<R> skew(const Vec3T<R>& a) {
  return {{{{R(0), -a.z, a.y}, {a.z, R(0), -a.x}, {-a.y, a.x, R(0)}}}};
}

template <class R>
constexpr R determinant(const Mat3T<R>& a) {
  return dot(a[0], cross(a[1], a[2]));
}

template <class R>
constexpr R trace(const Mat3T<R>& a) {
  return a[0].x + a[1].y + a[2].z;
}

/// Inverse by cofactors; the caller has checked that the determinant is not zero.
template <class R>
constexpr Mat3T<R> inverse(const Mat3T<R>& a) {
  const Vec3T<R> c0 = cross(a[1], a[2]), c1 = cross(a[2], a[0]), c2 = cross(a[0], a[1]);
  const R inv_det = R(1) / dot(a[0], c0);
  return Mat3T<R>::columns(c0 * inv_det, c1 * inv_det, c2 * inv_det);
}

using Vec3 = Vec3T<double>;
using Mat3 = Mat3T<double>;

}  // namespace kardan

// Two packs computed side by side, as one number type; see pack_trio.hpp. Every pack gets, bit by bit, what it would get alone.
#pragma once

#include "kardan/base/simd_math.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

struct PackPair {
  Pack a, b;

  PackPair() = default;
  KARDAN_INLINE PackPair(double x) : a(x), b(x) {}
  KARDAN_INLINE PackPair(const Pack& x, const Pack& y) : a(x), b(y) {}

  KARDAN_INLINE PackPair& operator+=(const PackPair& y) { a += y.a, b += y.b; return *this; }
  KARDAN_INLINE PackPair& operator-=(const PackPair& y) { a -= y.a, b -= y.b; return *this; }
  KARDAN_INLINE PackPair& operator*=(const PackPair& y) { a *= y.a, b *= y.b; return *this; }
  KARDAN_FRIEND PackPair operator+(const PackPair& x, const PackPair& y) { return {x.a + y.a, x.b + y.b}; }
  KARDAN_FRIEND PackPair operator-(const PackPair& x, const PackPair& y) { return {x.a - y.a, x.b - y.b}; }
  KARDAN_FRIEND PackPair operator*(const PackPair& x, const PackPair& y) { return {x.a * y.a, x.b * y.b}; }
  KARDAN_FRIEND PackPair operator-(const PackPair& x) { return {-x.a, -x.b}; }
};

/// inverse_sqrt() of both.
KARDAN_INLINE PackPair inverse_sqrt(const PackPair& x) {
  return inverse_sqrt_by_newton(x, PackPair(inverse_sqrt_estimate(x.a), inverse_sqrt_estimate(x.b)));
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

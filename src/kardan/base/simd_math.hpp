// Elementary functions on packs, of the basic operations only: the same bits with every width and on every processor.
#pragma once

#include "kardan/base/simd.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// 1/sqrt(x); relative error below 5e-16. x positive and normal (0 gives something large and finite, so that 0 * inverse_sqrt(0) = 0).
/// Newton's method on 1/y^2 = x, y <- y (3/2 - x y^2/2), from the number whose bits are half of those of x, which is 3.5 % off at most
/// (Lomont 2003, "Fast inverse square root"; the constant is the one for double): 4.6e-6 after the second step, then 3.2e-11, then
/// rounding. Square root and division of the processor would take four times as long.
KARDAN_INLINE Pack inverse_sqrt_estimate(const Pack& x) {
  typedef std::uint64_t Bits __attribute__((vector_size(sizeof(Pack::Vector))));
  return Pack(Pack::Vector(Bits{} + 0x5fe6eb50c7b537a9 - ((Bits)x.v >> 1)));
}
template <class R>
KARDAN_INLINE R inverse_sqrt_by_newton(const R& x, R y) {
  const R half = x * R(0.5);
  for (int i = 0; i < 4; ++i) y = y * (R(1.5) - half * y * y);
  return y;
}
KARDAN_INLINE Pack inverse_sqrt(const Pack& x) { return inverse_sqrt_by_newton(x, inverse_sqrt_estimate(x)); }

/// Natural logarithm; relative error below 1e-15 away from x = 1, absolute below 1e-16 next to it. x positive and normal.
/// x = 2^k m with m in [1/sqrt 2, sqrt 2), log m = 2 artanh((m - 1)/(m + 1)) by its series.
KARDAN_INLINE Pack log(const Pack& x) {
  constexpr double to_integer = 6755399441055744.0;  // 1.5 2^52: the low bits of k + to_integer are those of the integer k
  const Pack::Mask bits = (Pack::Mask)x.v, half = bits - Pack::Mask{} - 0x3fe6a09e667f3bcd;  // from the bits of 1/sqrt 2
  const Pack::Mask exponent = half >> 52;
  const Pack m(Pack::Vector(bits - (exponent << 52)));
  const Pack k = Pack(Pack::Vector(exponent + 0x4338000000000000)) - Pack(to_integer);
  const Pack s = (m - Pack(1.0)) / (m + Pack(1.0)), s2 = s * s;
  Pack series(1.0 / 21.0);
  for (int i = 19; i >= 3; i -= 2) series = series * s2 + Pack(1.0 / i);
  constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
  return k * Pack(ln2_high) + (k * Pack(ln2_low) + (s * s2 * series + s) * Pack(2.0));
}

/// Exponential function; relative error below 1e-15. |x| below 700.
/// x = k log 2 + r with |r| <= log(2)/2, exp r by its series.
KARDAN_INLINE Pack exp(const Pack& x) {
  constexpr double to_integer = 6755399441055744.0;
  constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
  const Pack shifted = x * Pack(1.4426950408889634) + Pack(to_integer), k = shifted - Pack(to_integer);
  const Pack r = (x - k * Pack(ln2_high)) - k * Pack(ln2_low);
  Pack series(1.0);
  for (int i = 13; i >= 1; --i) series = series * r * Pack(1.0 / i) + Pack(1.0);
  const Pack power(Pack::Vector(((Pack::Mask)shifted.v + 1023) << 52));
  return series * power;
}

/// (1 - exp(-x))/x, the mean of exp(-x s) over 0 <= s <= 1; relative error below 2e-15. x >= 0.
KARDAN_INLINE Pack decay_mean(const Pack& x) {
  Pack series(1.0);
  for (int i = 17; i >= 2; --i) series = Pack(1.0) - series * x * Pack(1.0 / i);  // sum (-x)^k/(k + 1)!
  const Pack far = (Pack(1.0) - exp(-min(x, Pack(690.0)))) / max(x, Pack(0.5));
  return select(x < Pack(0.5), series, far);
}

/// x^exponent for x >= 0 and exponent > 0; relative error below 1e-15 (1 + |exponent log x|). 0 where it is smaller than 1e-299.
KARDAN_INLINE Pack pow(const Pack& x, double exponent) {
  const Pack power = log(max(x, Pack(1e-300))) * Pack(exponent);
  return select((x > Pack(1e-300)) & (power > Pack(-690.0)), exp(max(power, Pack(-690.0))), Pack(0.0));
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

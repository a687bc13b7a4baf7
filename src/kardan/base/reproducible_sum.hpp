// Sums that depend on what is added alone: not on the order, nor on how the addends were shared out among threads and ranks.
//
// The sum is kept exactly, as a fixed-point number of base 2^32 that spans all doubles: Neal (2015), "Fast exact summation using small and
// large superaccumulators", arXiv:1505.05571, section 2 (the small one). An addend m 2^e, m < 2^53, touches two digits, which have 63 bits
// and a sign; carries wait until a digit could overflow. It costs 3 to 4 ns an addend, and 35 ns to begin and to round. Binned sums of
// three bins (Demmel and Nguyen 2015, "Parallel reproducible summation", IEEE Trans. Comput. 64(7)) are a tenth as large and took 2.5 and 20 ns
// in the same loop, but their error is relative to the largest addend: they lose sums of addends that cancel.
//
// Error: value() is the double nearest to the exact sum, ties to even. Range: all doubles, denormal ones too; partial sums cannot overflow,
// and value() is infinite only where the exact sum rounds to it. Infinities and not-a-numbers give what IEEE 754 gives: +inf, -inf, or NaN
// (without sign and payload, which would depend on the order). A sum of nothing or of -0 alone is +0. At most 2^63 addends.
// All arithmetic is on integers: no rounding mode, flush-to-zero, fast-math or contraction can touch it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "kardan/base/vec3.hpp"

namespace kardan {

/// May be sent as bytes: trivially copyable and of one size. Equal sums may differ in their bytes; compare value().
class ReproducibleSum {
 public:
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t magnitude = bits & ~sign_bit;
    if (magnitude - 1 >= infinity - 1) return add_special(bits);  // 0 wraps round
    if (waiting_ == most_waiting) carry();
    ++waiting_;
    // In units of 2^-1074 the addend is mantissa << shift.
    const std::uint64_t exponent = magnitude >> 52;
    const std::uint64_t normal = exponent != 0;
    const std::uint64_t mantissa = (magnitude & (hidden_bit - 1)) | (normal << 52);
    const std::uint64_t shift = exponent - normal;
    const auto digit = static_cast<std::int32_t>(shift / digit_bits);
    const std::uint64_t within = shift % digit_bits;
    const std::uint64_t low = (mantissa << within) & digit_mask, high = mantissa >> (digit_bits - within);
    const auto negate = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> 63);  // 0, or all ones: (a ^ n) - n = -a
    digit_[digit] += static_cast<std::int64_t>((low ^ negate) - negate);
    digit_[digit + 1] += static_cast<std::int64_t>((high ^ negate) - negate);
    first_ = std::min(first_, digit);
    end_ = std::max(end_, digit + 2);
  }
  /// Adds all that went into the other one.
  void add(const ReproducibleSum& other);
  double value() const;
  /// Back to a sum of nothing; cheaper than a new one.
  void clear();

 private:
  static constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63, hidden_bit = std::uint64_t{1} << 52, infinity = std::uint64_t{0x7ff} << 52;
  static constexpr int digit_bits = 32;
  static constexpr std::uint64_t digit_mask = 0xffff'ffff;
  /// The largest double ends at bit 2098 of the 2112 below the last digit, whose 63 bits then hold 2^63 of them and more.
  static constexpr int digits = 67;
  /// An addend changes a digit by less than 2^52, and a carry leaves no more than that: so many stay below 2^62.
  static constexpr std::int32_t most_waiting = 1 << 10;
  enum Special : std::int32_t { positive_infinity = 1, negative_infinity = 2, not_a_number = 4 };

  void add_special(std::uint64_t bits);
  void carry();

  std::int64_t digit_[digits] = {};
  std::int32_t first_ = digits, end_ = 0;  ///< digits outside first_ ... end_ - 1 are zero
  std::int32_t waiting_ = 0;               ///< addends since the last carry; what it left counts as one
  std::int32_t special_ = 0;               ///< which of Special were added
};

/// Three of them.
class ReproducibleSum3 {
 public:
  void add(const Vec3& a) {
    x_.add(a.x);
    y_.add(a.y);
    z_.add(a.z);
  }
  void add(const ReproducibleSum3& other) {
    x_.add(other.x_);
    y_.add(other.y_);
    z_.add(other.z_);
  }
  Vec3 value() const { return {x_.value(), y_.value(), z_.value()}; }
  void clear() {
    x_.clear();
    y_.clear();
    z_.clear();
  }

 private:
  ReproducibleSum x_, y_, z_;
};

}  // namespace kardan

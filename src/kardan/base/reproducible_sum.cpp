#include "kardan/base/reproducible_sum.hpp"

#include <limits>
#include <type_traits>

namespace kardan {

static_assert(std::is_trivially_copyable_v<ReproducibleSum> && std::is_trivially_copyable_v<ReproducibleSum3>);

void ReproducibleSum::add_special(std::uint64_t bits) {
  const std::uint64_t magnitude = bits & ~sign_bit;
  if (magnitude == 0) return;
  special_ |= magnitude > infinity ? not_a_number : (bits == magnitude ? positive_infinity : negative_infinity);
}

/// Leaves 0 to 2^32 - 1 in every digit, and in the highest one in use at most 2^32 of either sign: the sign of the sum is there.
void ReproducibleSum::carry() {
  const auto pass_on = [this](std::int32_t i) {
    digit_[i + 1] += digit_[i] >> digit_bits;
    digit_[i] = static_cast<std::int64_t>(static_cast<std::uint64_t>(digit_[i]) & digit_mask);
  };
  for (std::int32_t i = first_; i + 1 < end_; ++i) pass_on(i);
  const std::int64_t highest = digit_[end_ - 1] >> digit_bits;
  if (highest != 0 && highest != -1 && end_ < digits) pass_on(end_++ - 1);
  waiting_ = 1;
}

void ReproducibleSum::add(const ReproducibleSum& other) {
  if (waiting_ + other.waiting_ > most_waiting) {
    carry();
    if (waiting_ + other.waiting_ > most_waiting) {
      ReproducibleSum carried = other;
      carried.carry();
      return add(carried);
    }
  }
  for (std::int32_t i = other.first_; i < other.end_; ++i) digit_[i] += other.digit_[i];
  first_ = std::min(first_, other.first_);
  end_ = std::max(end_, other.end_);
  waiting_ += other.waiting_;
  special_ |= other.special_;
}

double ReproducibleSum::value() const {
  if (special_ != 0) {
    const double inf = std::numeric_limits<double>::infinity();
    return special_ == positive_infinity ? inf : special_ == negative_infinity ? -inf : std::numeric_limits<double>::quiet_NaN();
  }
  // Digits of the sum, or of its negative, each from 0 to 2^32 - 1 behind two zeros; what is carried out of the last one has the sum's sign.
  std::uint64_t d[digits + 3];
  d[0] = d[1] = 0;
  int n = 2;
  const auto resolve = [&](std::int64_t sign) {
    std::int64_t carried = 0;
    n = 2;
    for (std::int32_t i = first_; i < end_; ++i, ++n) {
      const std::int64_t sum = sign * digit_[i] + carried;
      d[n] = static_cast<std::uint64_t>(sum) & digit_mask;
      carried = sum >> digit_bits;
    }
    return carried;
  };
  std::int64_t carried = resolve(1);
  const bool negative = carried < 0;
  if (negative) carried = resolve(-1);
  d[n] = static_cast<std::uint64_t>(carried);
  while (n >= 2 && d[n] == 0) --n;
  if (n < 2) return 0.0;

  // The leading 64 bits; the last of them also stands for everything below.
  const int zeros = std::countl_zero(static_cast<std::uint32_t>(d[n]));
  std::uint64_t leading = (((d[n] << digit_bits) | d[n - 1]) << zeros) | (d[n - 2] >> (digit_bits - zeros));
  std::uint64_t below = (d[n - 2] << zeros) & digit_mask;
  for (int i = 0; i < n - 2; ++i) below |= d[i];
  leading |= below != 0 ? 1 : 0;

  // Its first bit stands at `place` above 2^-1074. A double has all bits of a sum below 2^53 of these units, else the first 53.
  const int place = digit_bits * (n - 2 + first_) + digit_bits - 1 - zeros;
  std::uint64_t bits = 0;
  if (place < 53) {
    bits = leading >> (63 - place);
  } else {
    bits = leading >> 11;
    const std::uint64_t rest = leading & 0x7ff;
    bits += (rest > 0x400 || (rest == 0x400 && (bits & 1) != 0)) ? 1 : 0;
    bits += static_cast<std::uint64_t>(std::min(place - 52, 2046)) << 52;  // the hidden bit, or a carry into it, adds one more
    bits = std::min(bits, infinity);
  }
  return std::bit_cast<double>(bits | (negative ? sign_bit : 0));
}

void ReproducibleSum::clear() {
  for (std::int32_t i = first_; i < end_; ++i) digit_[i] = 0;
  first_ = digits;
  end_ = 0;
  waiting_ = special_ = 0;
}

}  // namespace kardan

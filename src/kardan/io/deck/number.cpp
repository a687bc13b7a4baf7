#include "kardan/io/deck/number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace kardan::deck {

namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr std::array<double, 23> powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// A real number taken apart: its digits as an integer (while they fit), how many stand behind the point, its exponent.
struct Decimal {
  std::uint64_t digits = 0;
  int digit_count = 0;  // significant ones
  int behind_point = 0;
  int exponent = 0;
  bool negative = false, valid = false;
  std::size_t mantissa_end = 0;  // index behind the mantissa
};

Decimal take_apart(std::string_view text) {
  Decimal d;
  std::size_t i = 0;
  if (text[0] == '+' || text[0] == '-') d.negative = text[i++] == '-';
  bool any = false, point = false;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (is_digit(c)) {
      any = true;
      if (d.digits > 0 || c != '0') ++d.digit_count;
      if (d.digit_count <= 19) d.digits = d.digits * 10 + static_cast<std::uint64_t>(c - '0');
      if (point) ++d.behind_point;
    } else if (c == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  d.mantissa_end = i;
  if (!any) return d;
  if (i == text.size()) {
    d.valid = true;
    return d;
  }
  // Exponent: a letter with an optional sign, or, as Fortran allows, a sign alone.
  const char letter = text[i];
  if (letter == 'e' || letter == 'E' || letter == 'd' || letter == 'D')
    ++i;
  else if (letter != '+' && letter != '-')
    return d;
  bool negative_exponent = false;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative_exponent = text[i++] == '-';
  if (i == text.size()) return d;
  int exponent = 0;
  for (; i < text.size(); ++i) {
    if (!is_digit(text[i])) return d;
    if (exponent < 100000) exponent = exponent * 10 + (text[i] - '0');
  }
  d.exponent = negative_exponent ? -exponent : exponent;
  d.valid = true;
  return d;
}

}  // namespace

RealResult parse_real(std::string_view text) {
  const Decimal d = take_apart(text);
  if (!d.valid) return {0, NumberState::malformed};
  // Exact where the digits and the power of ten are both exact doubles (Clinger 1990).
  const int power = d.exponent - d.behind_point;
  if (d.digit_count <= 15 && power >= -22 && power <= 22) {
    const double digits = static_cast<double>(d.digits);
    const double value = power < 0 ? digits / powers_of_ten[static_cast<std::size_t>(-power)]
                                   : digits * powers_of_ten[static_cast<std::size_t>(power)];
    return {d.negative ? -value : value, NumberState::ok};
  }
  const std::size_t sign = text[0] == '+' || text[0] == '-' ? 1 : 0;
  std::string standard(text.substr(sign, d.mantissa_end - sign));
  standard += 'e';
  standard += std::to_string(d.exponent);
  double value = 0;
  const auto result = std::from_chars(standard.data(), standard.data() + standard.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    // Both overflow and underflow come here; the decimal exponent of the leading digit tells them apart.
    const bool small = d.digit_count == 0 || d.digit_count - d.behind_point + d.exponent < 0;
    return small ? RealResult{0, NumberState::ok} : RealResult{0, NumberState::too_large};
  }
  if (result.ec != std::errc{}) return {0, NumberState::malformed};
  return {d.negative ? -value : value, NumberState::ok};
}

IntegerResult parse_integer(std::string_view text) {
  const std::size_t sign = text[0] == '+' || text[0] == '-' ? 1 : 0;
  bool plain = text.size() > sign;
  std::uint64_t value = 0;
  bool fits = true;
  for (std::size_t i = sign; i < text.size(); ++i) {
    if (!is_digit(text[i])) {
      plain = false;
      break;
    }
    if (value > 922337203685477579ull) fits = false;
    if (fits) value = value * 10 + static_cast<std::uint64_t>(text[i] - '0');
  }
  if (plain) {
    if (!fits) return {0, NumberState::too_large};
    const auto magnitude = static_cast<std::int64_t>(value);
    return {text[0] == '-' ? -magnitude : magnitude, NumberState::ok};
  }
  const RealResult real = parse_real(text);
  if (real.state != NumberState::ok) return {0, real.state};
  if (real.value != std::floor(real.value)) return {0, NumberState::malformed};
  if (std::abs(real.value) > 9e15) return {0, NumberState::too_large};
  return {static_cast<std::int64_t>(real.value), NumberState::ok};
}

}  // namespace kardan::deck

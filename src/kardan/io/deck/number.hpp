// Numbers as decks write them: fixed-width columns, Fortran exponents ("1.5-3", "1.d5"), integers written as "12.".
#pragma once

#include <cstdint>
#include <string_view>

namespace kardan::deck {

enum class NumberState : std::uint8_t { ok, malformed, too_large };

struct RealResult {
  double value = 0;
  NumberState state = NumberState::ok;
};
struct IntegerResult {
  std::int64_t value = 0;
  NumberState state = NumberState::ok;
};

/// `text` is trimmed and not empty. NaN and infinity are malformed; a number too small for a double becomes zero.
RealResult parse_real(std::string_view text);

/// `text` is trimmed and not empty. A real of integral value is taken as an integer, as LS-DYNA does.
IntegerResult parse_integer(std::string_view text);

/// Blanks, tabs and carriage returns off both ends.
inline std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace kardan::deck

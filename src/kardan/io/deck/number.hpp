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
  constexpr std::string_view blanks = " \t\r\f\v";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace kardan::deck

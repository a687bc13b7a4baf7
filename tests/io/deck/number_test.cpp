#include "kardan/io/deck/number.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

namespace kardan::deck {
namespace {

TEST(Number, ReadsRealsAsFortranWritesThem) {
  struct Case {
    const char* text;
    double value;
  };
  for (const Case& c : {Case{"1", 1},
                        {"1.", 1},
                        {".5", 0.5},
                        {"-.5", -0.5},
                        {"+2.5", 2.5},
                        {"1.5e3", 1500},
                        {"1.5E+3", 1500},
                        {"1.5-3", 1.5e-3},
                        {"1.-3", 1e-3},
                        {"2+10", 2e10},
                        {"1.d5", 1e5},
                        {"1.D-5", 1e-5},
                        {"00012.50", 12.5},
                        {"0.000000E+00", 0},
                        {"7.85E-09", 7.85e-9},
                        {"1e-400", 0},
                        {"0e999999999", 0},
                        {"-0.", 0},
                        {"123456789012345678901234567890", 123456789012345678901234567890.0},
                        {"0.1234567890123456789", 0.1234567890123456789}}) {
    const RealResult r = parse_real(c.text);
    EXPECT_EQ(r.state, NumberState::ok) << c.text;
    EXPECT_EQ(r.value, c.value) << c.text;
  }
}

TEST(Number, RefusesWhatIsNoReal) {
  for (const char* text : {"1.0E", "1.0E+", "1.0e-",     "e5",   ".",   "-",   "+",   "--1",   "1..2",  "1.2.3", "nan",
                           "NaN",  "inf",   "-infinity", "0x10", "1,5", "1 5", "abc", "1e5.0", "1e+-5", "12abc"})
    EXPECT_EQ(parse_real(text).state, NumberState::malformed) << text;
  for (const char* text : {"1e309", "-1e400", "1e999999999999", "9+999"})
    EXPECT_EQ(parse_real(text).state, NumberState::too_large) << text;
}

TEST(Number, RoundsRealsAsTheStandardLibraryDoes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-40, 40);
  for (int i = 0; i < 20000; ++i) {
    char text[64];
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const int precision = i % 17;
    const int length = std::snprintf(text, sizeof text, "%.*e", precision, value);
    double expected = 0;
    std::from_chars(text, text + length, expected);
    EXPECT_EQ(parse_real(text).value, expected) << text;
  }
}

TEST(Number, ReadsIntegers) {
  EXPECT_EQ(parse_integer("42").value, 42);
  EXPECT_EQ(parse_integer("+42").value, 42);
  EXPECT_EQ(parse_integer("-42").value, -42);
  EXPECT_EQ(parse_integer("12.0").value, 12);
  EXPECT_EQ(parse_integer("1.2e1").value, 12);
  EXPECT_EQ(parse_integer("9223372036854775799").value, 9223372036854775799);
  for (const char* text : {"1.5", "abc", "-", "1e-3", "0x1F", "3a"})
    EXPECT_EQ(parse_integer(text).state, NumberState::malformed) << text;
  for (const char* text : {"99999999999999999999", "-99999999999999999999", "1e30", "9223372036854775808"})
    EXPECT_EQ(parse_integer(text).state, NumberState::too_large) << text;
}

}  // namespace
}  // namespace kardan::deck

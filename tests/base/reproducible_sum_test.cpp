// A reproducible sum is the exact sum rounded once, whatever the order and the grouping.
#include "kardan/base/reproducible_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace kardan {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

ReproducibleSum sum_of(const std::vector<double>& addends) {
  ReproducibleSum sum;
  for (const double x : addends) sum.add(x);
  return sum;
}

double value_of(const std::vector<double>& addends) { return sum_of(addends).value(); }

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Any finite double: all exponents are as likely, denormal ones too.
std::vector<double> any_doubles(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> x;
  while (x.size() < count)
    if (const auto a = std::bit_cast<double>(random()); std::isfinite(a)) x.push_back(a);
  return x;
}

TEST(ReproducibleSum, OfOneAndOfTwoIsThatOfTheProcessor) {
  // IEEE 754: a + b is the exact sum, rounded once. Exponents lie close enough that most sums are rounded.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> x = any_doubles(20'000, 2);
  for (double scale : {1e-308, 1.0, 1e308})
    for (int i = 0; i < 20'000; ++i) x.push_back(scale * std::ldexp(uniform(random), static_cast<int>(random() % 60) - 59));
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    ASSERT_EQ(bits(value_of({x[i]})), bits(0.0 + x[i]));  // 0 + -0 is +0, as everywhere here
    ASSERT_EQ(bits(value_of({x[i], x[i + 1]})), bits(0.0 + (x[i] + x[i + 1]))) << x[i] << " + " << x[i + 1];
  }
}

TEST(ReproducibleSum, IsExactWhereAddendsCancel) {
  EXPECT_EQ(value_of({1e300, 1, -1e300}), 1.0);
  EXPECT_EQ(value_of({largest, largest, smallest, -largest, -largest}), smallest);
  EXPECT_EQ(value_of({smallest, smallest, smallest}), 3 * smallest);
  EXPECT_EQ(value_of({0x1p-1022, -smallest}), 0x1p-1022 - smallest);
  EXPECT_EQ(bits(value_of({1.5, -1.5})), bits(0.0));
  EXPECT_EQ(bits(value_of({-0.0, -0.0})), bits(0.0));
  EXPECT_EQ(bits(value_of({})), bits(0.0));
  std::vector<double> pairs = any_doubles(100'000, 3);
  for (std::size_t i = 0, n = pairs.size(); i < n; ++i) pairs.push_back(-pairs[i]);
  pairs.push_back(0.1);
  std::shuffle(pairs.begin(), pairs.end(), std::mt19937_64(4));
  EXPECT_EQ(value_of(pairs), 0.1);
}

TEST(ReproducibleSum, RoundsOnceAndTiesToEven) {
  // Half a unit in the last place of 1, and a tail far below that decides.
  EXPECT_EQ(value_of({1, 0x1p-53}), 1.0);
  EXPECT_EQ(value_of({1, 0x1p-53, smallest}), 1 + 0x1p-52);
  EXPECT_EQ(value_of({1, 0x1p-53, -smallest}), 1.0);
  EXPECT_EQ(value_of({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
  EXPECT_EQ(value_of({-1, -0x1p-53, -smallest}), -1 - 0x1p-52);
  EXPECT_EQ(value_of({2 - 0x1p-52, 0x1p-53}), 2.0);
  // The limit from which on a sum is infinite lies half a unit in the last place above the largest double.
  EXPECT_EQ(value_of({largest, 0x1p970}), inf);
  EXPECT_EQ(value_of({largest, 0x1p970, -smallest}), largest);
  EXPECT_EQ(value_of({-largest, -0x1p970}), -inf);
}

TEST(ReproducibleSum, MatchesLongIntegersOverManyCarries) {
  // Multiples of 2^-40 below 2^22: 64-bit integers hold their sum exactly, and the double of it is rounded once.
  std::mt19937_64 random(5);
  for (const int bias : {-1, 0, 1}) {
    ReproducibleSum sum;
    std::int64_t exact = 0;
    for (int i = 0; i < 1'000'000; ++i) {
      std::int64_t k = static_cast<std::int64_t>(random() >> 22) - (std::int64_t{1} << 41);
      if (bias != 0) k = bias * std::abs(k);
      exact += k;
      sum.add(std::ldexp(static_cast<double>(k), -40));
    }
    ASSERT_EQ(sum.value(), std::ldexp(static_cast<double>(exact), -40)) << bias;
  }
}

TEST(ReproducibleSum, IllConditionedMillion) {
  // Fours cancel, but for one known addend: the sum of magnitudes is about 1e25 times the sum.
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0.5, 1);
  std::vector<double> x;
  for (int i = 0; i < 250'000; ++i) {
    const double a = uniform(random), b = 0x1p-30 * uniform(random), s = a + b;
    const double error = b - (s - a);  // exact (Dekker 1971): s + error = a + b
    for (const double y : {s, error, -a, -b}) x.push_back(y);
  }
  x.push_back(0x1p-66);
  std::shuffle(x.begin(), x.end(), std::mt19937_64(7));
  EXPECT_EQ(value_of(x), 0x1p-66);
}

TEST(ReproducibleSum, DoesNotDependOnOrder) {
  for (const unsigned seed : {8u, 9u, 10u}) {
    std::vector<double> x = any_doubles(5'000, seed);
    const std::uint64_t reference = bits(value_of(x));
    for (unsigned k = 0; k < 20; ++k) {
      std::shuffle(x.begin(), x.end(), std::mt19937_64(k));
      ASSERT_EQ(bits(value_of(x)), reference);
    }
    std::sort(x.begin(), x.end());
    ASSERT_EQ(bits(value_of(x)), reference);
  }
}

TEST(ReproducibleSum, DoesNotDependOnGrouping) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> x;
  for (int i = 0; i < 30'000; ++i) x.push_back(normal(random) * std::exp(20 * normal(random)));
  const std::uint64_t reference = bits(value_of(x));
  for (int k = 0; k < 20; ++k) {
    // Random pieces, merged pair by pair in random order: the tree of a reduction.
    std::vector<ReproducibleSum> pieces;
    for (std::size_t begin = 0; begin < x.size();) {
      const std::size_t end = std::min(x.size(), begin + 1 + random() % 3'000);
      pieces.push_back(sum_of({x.begin() + static_cast<std::ptrdiff_t>(begin), x.begin() + static_cast<std::ptrdiff_t>(end)}));
      begin = end;
    }
    while (pieces.size() > 1) {
      std::swap(pieces[random() % pieces.size()], pieces.back());
      const ReproducibleSum last = pieces.back();
      pieces.pop_back();
      pieces[random() % pieces.size()].add(last);
    }
    ASSERT_EQ(bits(pieces[0].value()), reference);
  }
}

TEST(ReproducibleSum, MergesFullAccumulators) {
  // 2^10 addends wait in each, the most there may be, and their digits are as large as they get.
  const ReproducibleSum full = sum_of(std::vector<double>(1024, 2 - 0x1p-52));
  ReproducibleSum sum = full;
  for (int i = 1; i < 1024; ++i) sum.add(full);
  EXPECT_EQ(sum.value(), 0x1p20 * (2 - 0x1p-52));
  for (int i = 0; i < 1024; ++i) sum.add(sum_of(std::vector<double>(1024, -(2 - 0x1p-52))));
  EXPECT_EQ(bits(sum.value()), bits(0.0));
  sum.add(sum);
  sum.add(ReproducibleSum());
  EXPECT_EQ(bits(sum.value()), bits(0.0));
}

TEST(ReproducibleSum, TravelsAsBytes) {
  const ReproducibleSum sum = sum_of({1e300, 1, 1e-300, -1e300});
  unsigned char bytes[sizeof(ReproducibleSum)];
  std::memcpy(bytes, &sum, sizeof sum);
  ReproducibleSum arrived;
  std::memcpy(&arrived, bytes, sizeof arrived);
  arrived.add(-1);
  EXPECT_EQ(arrived.value(), 1e-300);
}

TEST(ReproducibleSum, InfinityAndNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(value_of({inf, 1, inf}), inf);
  EXPECT_EQ(value_of({-inf, largest, largest}), -inf);
  EXPECT_TRUE(std::isnan(value_of({inf, 1, -inf})));
  EXPECT_EQ(bits(value_of({1, -nan})), bits(value_of({nan, 2, inf})));
  EXPECT_TRUE(std::isnan(value_of({1, nan})));
  ReproducibleSum merged = sum_of({inf});
  merged.add(sum_of({-inf}));
  EXPECT_TRUE(std::isnan(merged.value()));
}

TEST(ReproducibleSum, StartsAfreshAfterClear) {
  for (const std::vector<double>& before : {std::vector<double>{1e300, -1e-300, inf}, std::vector<double>(5'000, -3.7)}) {
    ReproducibleSum sum = sum_of(before);
    sum.clear();
    EXPECT_EQ(bits(sum.value()), bits(0.0));
    sum.add(0.1);
    EXPECT_EQ(sum.value(), 0.1);
  }
}

TEST(ReproducibleSum3, SumsComponents) {
  ReproducibleSum3 a, b;
  a.add(Vec3{1e300, 1, 2});
  b.add(Vec3{3, 1e-300, -2});
  a.add(b);
  a.add(Vec3{-1e300, -1, 5});
  EXPECT_EQ(a.value(), (Vec3{3, 1e-300, 5}));
  a.clear();
  EXPECT_EQ(a.value(), Vec3{});
}

}  // namespace
}  // namespace kardan

#include "kardan/model/id_map.hpp"

#include <gtest/gtest.h>

#include "kardan/model/curve.hpp"

namespace kardan {
namespace {

TEST(IdMap, FindsCompactAndFarNumbersAlike) {
  IdMap map;
  for (Index i = 0; i < 1000; ++i) EXPECT_TRUE(map.emplace(i + 1, i).second);
  EXPECT_TRUE(map.emplace(90000000000, 1000).second);
  EXPECT_TRUE(map.emplace(100000, 1001).second);
  EXPECT_FALSE(map.emplace(17, 5).second);
  EXPECT_EQ(map.size(), 1002u);
  EXPECT_EQ(map.at(17), 16);
  EXPECT_EQ(map.find(90000000000)->second, 1000);
  EXPECT_EQ(map.find(90000000000)->first, 90000000000);
  EXPECT_EQ(map.index(100000), 1001);
  EXPECT_TRUE(map.find(5000) == map.end());
  EXPECT_EQ(map.index(-3), none);
  EXPECT_THROW(map.at(0), std::out_of_range);
}

TEST(IdMap, KeepsFarNumbersWhenTheDenseRangeReachesThem) {
  IdMap map;
  map.emplace(200000, 7);
  for (Index i = 0; i < 300000; ++i) {
    if (i != 200000) map.emplace(i, i);
  }
  EXPECT_EQ(map.at(200000), 7);
  EXPECT_EQ(map.at(199999), 199999);
  EXPECT_EQ(map.size(), 300000u);
}

TEST(IdMap, ReservedRangeStartsAnywhere) {
  IdMap map;
  map.reserve(50000000, 50000999, 1000);
  for (Index i = 0; i < 1000; ++i) map.emplace(50000000 + i, i);
  map.emplace(3, 1000);
  EXPECT_EQ(map.at(50000999), 999);
  EXPECT_EQ(map.at(3), 1000);
  EXPECT_FALSE(map.contains(50001000));
}

TEST(Curve, PreparedIntegralEqualsTheSum) {
  Curve curve;
  curve.x = {-1, 0.5, 2, 4};
  curve.y = {2, -1, 3, 3.5};
  Curve prepared = curve;
  prepared.prepare();
  for (double t = -3; t < 7; t += 0.37) EXPECT_NEAR(prepared.integral(t), curve.integral(t), 1e-14 * (1 + std::abs(t)));
}

}  // namespace
}  // namespace kardan

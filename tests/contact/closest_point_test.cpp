#include "kardan/contact/closest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kardan {
namespace {

Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  const double x = u(random), y = u(random);
  return {x, y, u(random)};
}

/// Smallest distance to the four triangles by trying a fine grid of points.
double brute_force(const Vec3& p, const std::array<Vec3, 4>& x, bool triangle) {
  const Vec3 m = (x[0] + x[1] + x[2] + x[3]) * 0.25;
  double best = 1e30;
  const int n = 120;
  for (std::size_t t = 0; t < (triangle ? 1u : 4u); ++t) {
    const Vec3 a = triangle ? x[0] : m, b = triangle ? x[1] : x[t], c = triangle ? x[2] : x[(t + 1) % 4];
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) best = std::min(best, norm(p - (a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n))));
  }
  return best;
}

TEST(ClosestPoint, IsNoFartherThanAnyOtherPointOfTheSegment) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 150; ++trial) {
    const bool triangle = trial % 3 == 0;
    std::array<Vec3, 4> x{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 2, 0}, Vec3{0, 2, 0}};
    for (Vec3& corner : x) corner += random_point(random, 0.4);
    if (triangle) x[3] = x[2];
    const Vec3 p = Vec3{1, 1, 0} + random_point(random, 2);
    const ClosestPoint c = closest_point(p, x, triangle);
    Vec3 on;
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GE(c.weights[i], 0);
      sum += c.weights[i];
      on += x[i] * c.weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LT(norm(p - on - c.u), 1e-14);
    EXPECT_NEAR(c.square, dot(c.u, c.u), 1e-14);
    const double grid = brute_force(p, x, triangle);
    EXPECT_LE(std::sqrt(c.square), grid + 1e-12);
    EXPECT_NEAR(std::sqrt(c.square), grid, 0.02);
    EXPECT_NEAR(norm(c.normal), 1, 1e-14);
  }
}

/// The distance is a continuous function along a path over a warped segment, its sides and corners.
TEST(ClosestPoint, DistanceIsContinuous) {
  const std::array<Vec3, 4> x{Vec3{0, 0, 0.3}, Vec3{1, 0, -0.3}, Vec3{1, 1, 0.3}, Vec3{0, 1, -0.3}};
  std::mt19937 random(2);
  for (int path = 0; path < 50; ++path) {
    const Vec3 from = random_point(random, 1.5), to = random_point(random, 1.5);
    const double step = norm(to - from) / 2000;
    double before = std::sqrt(closest_point(from, x, false).square);
    for (int i = 1; i <= 2000; ++i) {
      const double now = std::sqrt(closest_point(from + (to - from) * (i / 2000.0), x, false).square);
      ASSERT_LE(std::abs(now - before), step * (1 + 1e-9));
      before = now;
    }
  }
}

TEST(ClosestPoint, TellsCornersSidesAndInside) {
  const std::array<Vec3, 4> quad{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(closest_point({0.4, 0.6, 0.2}, quad, false).feature, 15);
  EXPECT_EQ(closest_point({-0.2, -0.1, 0.2}, quad, false).feature, 1);
  EXPECT_EQ(closest_point({0.3, 1.4, 0.2}, quad, false).feature, 4 + 8);
  EXPECT_EQ(closest_point({-0.3, 0.4, -0.2}, quad, false).feature, 8 + 1);
  EXPECT_EQ(closest_point({0.3, 0.4, -0.2}, quad, false).normal, (Vec3{0, 0, 1}));
  const std::array<Vec3, 4> triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(closest_point({0.2, 0.2, 1}, triangle, true).feature, 7);
  EXPECT_EQ(closest_point({1, 1, 1}, triangle, true).feature, 2 + 4);
}

}  // namespace
}  // namespace kardan

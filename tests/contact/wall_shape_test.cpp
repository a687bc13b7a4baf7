// Where nodes meet walls: each shape by itself, in a step of length 1.
#include "kardan/contact/wall_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kardan {
namespace {

using Shape = RigidWall::Shape;

RigidWall wall_of(Shape shape, double radius, double length_p = 0) {
  RigidWall w;
  w.shape = shape;
  w.normal = {0, 0, 1};
  w.radius = radius;
  w.length_p = length_p;
  return w;
}

RigidWall with_edges(Shape shape, double l, double m, double p) {
  RigidWall w = wall_of(shape, 0, p);
  w.edge_l = {1, 0, 0};
  w.edge_m = {0, 1, 0};
  w.length_l = l;
  w.length_m = m;
  return w;
}

Vec3 end_of(const WallShape& s, const Vec3& r, const Vec3& u) {
  const auto resistance = s.resist(r, u, 1);
  return r + u + resistance.normal * std::max(resistance.change, 0.0);
}

TEST(WallShape, NodesLandOnTheNearestPointOfSpheresAndCylinders) {
  const WallShape sphere(wall_of(Shape::sphere, 2)), cylinder(wall_of(Shape::cylinder, 2));
  EXPECT_LT(norm(end_of(sphere, {0, 0, 2.5}, {0.3, 0, -1.5}) - normalized(Vec3{0.3, 0, 1}) * 2.0), 1e-15);
  EXPECT_LT(norm(end_of(cylinder, {2.5, 0, 7}, {-1.5, 0.3, 1}) - (normalized(Vec3{1, 0.3, 0}) * 2.0 + Vec3{0, 0, 8})), 1e-15);
  EXPECT_LE(sphere.resist({0, 0, 2.5}, {0, 0, -0.4}, 1).change, 0);
  EXPECT_NEAR(sphere.clearance({0, 3, 4}), 3, 1e-15);
  EXPECT_NEAR(cylinder.clearance({3, 4, 100}), 3, 1e-15);
}

TEST(WallShape, WhatBeginsInsideStaysAtItsDepth) {
  const WallShape sphere(wall_of(Shape::sphere, 2)), plane(wall_of(Shape::plane, 0)), prism(with_edges(Shape::prism, 4, 4, 4));
  EXPECT_NEAR(norm(end_of(sphere, {1, 0, 0}, {-0.5, 0, 0})), 1, 1e-15);
  EXPECT_EQ(end_of(sphere, {1, 0, 0}, {0.5, 0, 0}), (Vec3{1.5, 0, 0}));
  EXPECT_EQ(end_of(plane, {0, 0, -0.25}, {1, 0, -1}), (Vec3{1, 0, -0.25}));
  EXPECT_EQ(end_of(prism, {3.75, 2, -2}, {-1, 0.5, 0}), (Vec3{3.75, 2.5, -2}));
  EXPECT_EQ(prism.depth({3.75, 2, -2}).depth, 0.25);
  EXPECT_EQ(prism.depth({3.75, 2, -2}).normal, (Vec3{1, 0, 0}));
}

TEST(WallShape, ANodeEntersAPrismThroughTheSideItCrossesLast) {
  const WallShape prism(with_edges(Shape::prism, 4, 4, 4));
  // Over the edge x = 4, z = 0: the side first, then the top, and the other way round.
  EXPECT_EQ(prism.resist({4.1, 2, 0.5}, {-1, 0, -1}, 1).normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(prism.resist({4.5, 2, 0.1}, {-1, 0, -1}, 1).normal, (Vec3{1, 0, 0}));
  // The nearest side is another one than that of entry.
  EXPECT_EQ(end_of(prism, {4.5, 2, -0.25}, {-1, 0, 0}), (Vec3{4, 2, -0.25}));
  EXPECT_LE(prism.resist({4.5, 2, 0.5}, {-0.4, 0, -0.6}, 1).change, 0);
  EXPECT_EQ(prism.resist({2, 2, -4.5}, {0, 0, 1}, 1).normal, (Vec3{0, 0, -1}));
  // Infinite along l and m: a slab. Infinite along n as well: half a space.
  EXPECT_EQ(WallShape(with_edges(Shape::prism, 0, 0, 4)).resist({900, 2, -4.5}, {0, 0, 1}, 1).normal, (Vec3{0, 0, -1}));
  EXPECT_EQ(WallShape(with_edges(Shape::prism, 0, 0, 0)).resist({900, 2, 0.5}, {0, 0, -1}, 1).change, 0.5);
}

TEST(WallShape, CylindersHaveEnds) {
  const WallShape s(wall_of(Shape::cylinder, 2, 3));
  EXPECT_EQ(end_of(s, {1, 0, 0.5}, {0, 0, -1}), (Vec3{1, 0, 0}));
  EXPECT_EQ(end_of(s, {1, 0, -3.5}, {0, 0, 1}), (Vec3{1, 0, -3}));
  EXPECT_LT(norm(end_of(s, {2.5, 0, -1}, {-1, 0, 0}) - Vec3{2, 0, -1}), 1e-15);
  EXPECT_LE(s.resist({2.5, 0, 1}, {-1, 0, -0.5}, 1).change, 0);
  // Over the rim: radius first, then the end.
  EXPECT_EQ(s.resist({2.1, 0, 0.5}, {-1, 0, -1}, 1).normal, (Vec3{0, 0, 1}));
  EXPECT_LT(norm(s.resist({2.5, 0, 0.1}, {-1, 0, -1}, 1).normal - Vec3{1, 0, 0}), 1e-15);
}

TEST(WallShape, NodesPassSurfacesBesideTheirEdges) {
  const WallShape s(with_edges(Shape::plane, 4, 2, 0));
  EXPECT_EQ(end_of(s, {1, 1, 0.5}, {0, 0, -1}), (Vec3{1, 1, 0}));
  EXPECT_TRUE(s.resist({5, 1, 0.5}, {0, 0, -1}, 1).passes);
  EXPECT_TRUE(s.resist({1, -0.1, 0.5}, {0, 0, -1}, 1).passes);
  // The crossing decides, not the end of the way.
  EXPECT_TRUE(s.resist({4.5, 1, 0.1}, {-2, 0, -1}, 1).passes);
  EXPECT_FALSE(s.resist({4.5, 1, 0.9}, {-2, 0, -1}, 1).passes);
  EXPECT_TRUE(s.has_edges());
  EXPECT_TRUE(s.beyond_edges({4.5, 1, -3}));
  EXPECT_EQ(s.clearance({1, 1, -3}), 3);
}

TEST(WallShape, BoresHoldNodesInside) {
  RigidWall wall = wall_of(Shape::cylinder, 2);
  wall.interior = true;
  EXPECT_LT(norm(end_of(WallShape(wall), {1.5, 0, 9}, {1, 0, 0}) - Vec3{2, 0, 9}), 1e-15);
  EXPECT_NEAR(WallShape(wall).clearance({1, 0, 9}), 1, 1e-15);
  EXPECT_NEAR(norm(end_of(WallShape(wall), {3, 0, 0}, {1, 1, 0})), 3, 1e-15);  // begins outside
  wall.length_p = 5;
  EXPECT_TRUE(WallShape(wall).resist({1.5, 0, 1}, {1, 0, 0}, 1).passes);
  EXPECT_FALSE(WallShape(wall).resist({1.5, 0, -1}, {1, 0, 0}, 1).passes);
}

/// Whatever the node does, it is not inside after the step, or no deeper than it was.
TEST(WallShape, NoNodeEndsInside) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-4, 4), way(-1.5, 1.5);
  const auto any = [&](auto& distribution) { return Vec3{distribution(random), distribution(random), distribution(random)}; };
  for (const RigidWall& wall : {wall_of(Shape::sphere, 2), wall_of(Shape::cylinder, 2), wall_of(Shape::cylinder, 2, 3), wall_of(Shape::plane, 0),
                                with_edges(Shape::prism, 2, 3, 1), with_edges(Shape::prism, 2, 0, 1)}) {
    const WallShape s(wall);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 r = any(place), end = end_of(s, r, any(way));
      met += norm(end - r) > 0 && s.depth(end).depth > -1e-14;
      ASSERT_LE(s.depth(end).depth, std::max(s.depth(r).depth, 0.0) + 1e-14);
      ASSERT_LE(s.clearance(end), s.clearance(r) + norm(end - r) + 1e-14);  // a bound of the distance
    }
    EXPECT_GT(met, 100);
  }
}

}  // namespace
}  // namespace kardan

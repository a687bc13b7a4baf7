// Friction, welds and braking of nodes at rigid walls.
#include <gtest/gtest.h>

#include "contact/wall_cases.hpp"

namespace kardan {
namespace {

using test::Cloud;
using test::WallRun;

/// A point on a plane inclined by 30 degrees, gravity 10: it slides with g (sin - mu cos), or sticks where mu > tan.
TEST(WallFriction, OnAnInclinedPlane) {
  const double sine = 0.5, cosine = std::sqrt(0.75);
  for (const double mu : {0.0, 0.3, 0.57, 0.58, 1.0}) {
    Cloud c;
    c.wall.normal = {sine, 0, cosine};
    c.wall.friction = mu;
    c.point({0, 0, 0}, {});
    c.gravity(2, 10);
    const WallRun run(c, 0.5, 1e-3);
    const double expected = mu < sine / cosine ? 10 * (sine - mu * cosine) * 0.5 : 0.0;
    EXPECT_NEAR(dot(run.v[0], Vec3{cosine, 0, -sine}), expected, 1e-12) << mu;
    EXPECT_NEAR(run.stonewall, 0.5 * expected * 0.5 * mu * 10 * cosine, 1e-12) << mu;
    EXPECT_LT(run.energy_error(), 1e-13) << mu;
  }
}

/// Along a the friction is FA, along b = n x a it is FB.
TEST(WallFriction, Orthotropic) {
  Cloud c;
  OrthotropicFriction o;
  o.dynamic = {0.1, 0.3};
  o.statical = {0.1, 0.7};
  o.decay = {0, 1e6};
  o.direction = {3, 0, 17};  // its part out of the plane does not count
  c.wall.orthotropic = o;
  c.point({0, 0, 0}, {4, 3, 0});
  c.gravity(2, 10);
  const WallRun run(c, 0.5, 1e-3);
  EXPECT_NEAR(run.v[0].x, 4 - 0.1 * 10 * 0.5, 1e-12);
  EXPECT_NEAR(run.v[0].y, 3 - 0.3 * 10 * 0.5, 1e-12);
  EXPECT_LT(run.energy_error(), 1e-13);
}

TEST(WallFriction, OrthotropicAxesFollowNodes) {
  Cloud c;
  OrthotropicFriction o;
  o.statical = o.dynamic = {1e3, 0};
  o.node1 = c.point({1, 1, 5}, {});
  o.node2 = c.point({1, 3, 7}, {});
  c.wall.nodes.clear();
  c.wall.orthotropic = o;
  c.point({0, 0, 0.001}, {4, 3, -1});
  const WallRun run(c, 0.5, 1e-3);
  EXPECT_NEAR(run.v[2].x, 4, 1e-12);
  EXPECT_NEAR(run.v[2].y, 0, 1e-12);
}

/// Nodes that arrive faster than WVEL stay for good; the slower one is pulled off again. FRIC 3 holds them along the wall, too.
TEST(WallFriction, FastNodesAreWelded) {
  for (const double friction : {0.0, 1.0}) {
    Cloud c;
    c.wall.welds = true;
    c.wall.friction = friction;
    c.wall.weld_velocity = 2;
    c.point({0, 0, 0.01}, {1, 0, -3});
    c.point({5, 0, 0.01}, {1, 0, -1});
    c.gravity(2, -5);  // off the wall
    const WallRun run(c, 1, 1e-3);
    EXPECT_NEAR(run.x[0].z, 0, 1e-15);
    EXPECT_NEAR(run.v[0].x, friction == 0 ? 1 : 0, 1e-14);
    EXPECT_GT(run.x[1].z, 1);
    EXPECT_LT(run.energy_error(), 1e-13);
  }
}

/// SOFT: the same impulse over several cycles, so a smaller force, at the price of some depth.
TEST(WallFriction, SoftWallsBrakeOverSomeCycles) {
  double hard = 0;
  for (const int cycles : {0, 10}) {
    Cloud c;
    c.wall.soft_cycles = cycles;
    c.point({0, 0, 0.0105}, {0, 0, -10});
    const WallRun run(c, 0.05, 1e-3);
    if (cycles == 0) hard = run.largest_force;
    EXPECT_NEAR(run.v[0].z, 0, 1e-15);
    EXPECT_NEAR(run.largest_force, cycles == 0 ? hard : hard / 10, 0.06 * run.largest_force);
    EXPECT_NEAR(run.stonewall, 50, 1e-12);
    EXPECT_NEAR(run.x[0].z, cycles == 0 ? 0.0 : -0.5 * 10 * 1e-3 * cycles, 0.011);
  }
}

}  // namespace
}  // namespace kardan

// Walls that move: freely, with a mass, or driven by a curve.
#include <gtest/gtest.h>

#include "contact/wall_cases.hpp"

namespace kardan {
namespace {

using test::Cloud;
using test::WallRun;

/// Momentum of a free wall and its nodes.
struct MomentumWatch : Observer {
  explicit MomentumWatch(double mass) : wall_mass(mass) {}
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& s, const StepView&) override {
    double p = wall_mass * s.walls[0].velocity.z;
    for (std::size_t n = 0; n < s.nodes.x.size(); ++n) p += s.nodes.mass[n] * s.nodes.v_now[n].z;
    if (s.clock.cycle == 0) first = p;
    worst = std::max(worst, std::abs(p - first));
    for (const Vec3& x : s.nodes.x) deepest = std::min(deepest, x.z - s.walls[0].displacement.z);
  }
  double wall_mass, first = 0, worst = 0, deepest = 0;
};

/// Nodes of several masses at several heights; the wall meets them one after the other, some in one step. Those it has met fly ahead of it
/// when others slow it down.
TEST(MovingWall, ItsMomentumAndThatOfItsNodesIsConserved) {
  Cloud c;
  c.wall.mass = 3;
  c.wall.velocity = 10;
  double momentum = 30;
  for (int i = 0; i < 40; ++i) {
    const double m = 0.1 * (1 + i % 7), v = -0.5 * (i % 5);
    c.point({0.1 * i, 0, 0.002 * (i / 4)}, {1, 0, v}, m);
    momentum += m * v;
  }
  c.model.rigid_walls.push_back(c.wall);
  c.model.control.termination.end_time = 0.1;
  Diagnostics diagnostics;
  Solver solver(c.model, {.dt = 1e-4}, diagnostics);
  MomentumWatch watch(3);
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_NEAR(watch.first, momentum, 1e-12 * momentum);
  EXPECT_LT(watch.worst, 1e-13 * momentum);
  EXPECT_GT(watch.deepest, -1e-15);
  const EnergyLedger& e = solver.state().energy;
  EXPECT_NEAR(e.total(), e.initial, 1e-13 * e.initial);
  EXPECT_GT(e.stonewall, 0.3 * e.initial);
}

/// All meet in one step: the common velocity is that of the perfectly plastic impact of those that are slower than it.
TEST(MovingWall, OneImpactOfManyNodesIsPerfectlyPlastic) {
  Cloud c;
  c.wall.mass = 3;
  c.wall.velocity = 10;
  for (int i = 0; i < 5; ++i) c.point({1.0 * i, 0, 0}, {0, 0, 2.0 * i}, 1);
  const WallRun run(c, 0.01, 1e-3);
  const double common = (3 * 10 + 0 + 2 + 4) / 6.0;  // 6: the nodes at 6 and 8 are as fast or faster
  EXPECT_NEAR(run.wall.velocity.z, common, 1e-14);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(run.v[i].z, std::max(common, 2.0 * static_cast<double>(i)), 1e-14);
  EXPECT_LT(run.energy_error(), 1e-14);
}

/// A wall pushed by its nodes: gravity presses a point of mass m on a free wall of mass M, both fall with m g/(M + m).
TEST(MovingWall, ItIsAcceleratedByItsNodes) {
  Cloud c;
  c.wall.mass = 3;
  c.point({0, 0, 0}, {}, 1);
  c.gravity(2, 8);
  const WallRun run(c, 1, 1e-3);
  EXPECT_NEAR(run.wall.velocity.z, -2, 1e-12);
  EXPECT_NEAR(run.wall.displacement.z, -1, 1e-12);
  EXPECT_NEAR(run.largest_force, 6, 1e-9);
  EXPECT_LT(run.energy_error(), 1e-13);
}

/// A driven wall carries a point along; its work is external work.
TEST(MovingWall, ADrivenWallFollowsItsCurveAndItsWorkIsExternal) {
  for (const bool displacement : {false, true}) {
    Cloud c;
    c.point({0, 0, 0.05}, {}, 2);
    c.wall.motion = displacement ? c.curve({0, 0.5, 1}, {0, 0.25, 1.5}) : c.curve({0, 1}, {1, 3});
    c.wall.motion_is_displacement = displacement;
    c.wall.motion_direction = {0, 0, 1};
    const WallRun run(c, 1, 1e-3);
    EXPECT_NEAR(run.wall.displacement.z, displacement ? 1.5 : 2.0, 1e-12);
    EXPECT_NEAR(run.x[0].z, run.wall.displacement.z, 1e-12);
    const double end = displacement ? 2.5 : 3.0;
    EXPECT_NEAR(run.v[0].z, end, 1e-2);
    EXPECT_NEAR(run.external_work - run.stonewall, end * end, 1e-2 * end * end);  // m v^2/2 with m = 2
    EXPECT_GT(run.stonewall, 0.2);
    EXPECT_LT(run.energy_error(), 1e-13);
  }
}

TEST(MovingWall, CurvesBeginAtBirth) {
  Cloud c;
  c.point({0, 0, 0.5}, {});
  c.wall.motion = c.curve({0, 1}, {2, 2});
  c.wall.motion_direction = {0, 0, 1};
  c.wall.birth = 0.25;
  c.wall.death = 0.375;
  const WallRun run(c, 0.5, 1.0 / 1024);
  EXPECT_NEAR(run.wall.displacement.z, 0.25, 2e-3);
  EXPECT_EQ(run.v[0].z, 0);
}

}  // namespace
}  // namespace kardan

// Spheres, cylinders, prisms and planes with edges in the whole step.
#include <gtest/gtest.h>

#include <random>

#include "contact/wall_cases.hpp"
#include "kardan/contact/wall_shape.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

using test::Cloud;
using test::WallRun;
using Shape = RigidWall::Shape;

/// An elastic plate of 8 x 8 cubes of edge 0.1 about the origin, moving down.
Bricks falling_plate(double height, double speed) {
  Bricks b;
  const PartIndex p = b.part(ElasticMaterial{7800, 210e9, 0.3, 0, 0});
  const int n = 8;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) b.node({0.1 * (i - n / 2), 0.1 * (j - n / 2), height + 0.1 * k});
  const auto at = [&](int i, int j, int k) { return static_cast<NodeIndex>((k * (n + 1) + j) * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      b.brick(p, {at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0), at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1)});
  b.model.control.hourglass_type = 4;
  b.model.control.time_step.scale = 0.5;
  InitialVelocity initial;
  initial.velocity = {0, 0, -speed};
  for (std::size_t i = 0; i < b.model.nodes.size(); ++i) initial.nodes.push_back(static_cast<NodeIndex>(i));
  b.model.initial_velocities.push_back(initial);
  return b;
}

struct PlateWatch : Observer {
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& s, const StepView&) override {
    for (const Vec3& x : s.nodes.x) deepest = std::min(deepest, std::hypot(x.x, sphere ? x.y : 0.0, x.z) - 1);
    Vec3 p;
    for (std::size_t n = 0; n < s.nodes.v.size(); ++n) p += s.nodes.v[n] * s.nodes.mass[n];
    if (s.clock.cycle > 0) worst_impulse = std::max(worst_impulse, norm(p - momentum + s.walls[0].force * s.clock.kick()));
    momentum = p;
    worst_energy = std::max(worst_energy, std::abs(s.energy.total() - s.energy.initial));
    touched |= s.walls[0].normal_force > 0;
  }
  bool sphere = true, touched = false;
  double deepest = 1, worst_impulse = 0, worst_energy = 0;
  Vec3 momentum;
};

/// The same to the last bit with any number of threads, whether the nodes near the wall are listed or all of them are looked at.
TEST(GeometricWall, APlateFallsOnASphereAndACylinder) {
  for (const Shape shape : {Shape::sphere, Shape::cylinder}) {
    for (const double friction : {0.0, 0.4}) {
      Bricks b = falling_plate(1.002, 20);
      RigidWall wall;
      wall.shape = shape;
      wall.normal = {0, 1, 0};
      wall.radius = 1;
      wall.friction = friction;
      for (std::size_t i = 0; i < b.model.nodes.size(); ++i) wall.nodes.push_back(static_cast<NodeIndex>(i));
      b.model.rigid_walls.push_back(wall);
      b.model.control.termination.end_time = 1e-3;
      PlateWatch watch;
      watch.sphere = shape == Shape::sphere;
      std::uint64_t hash = 0;
      for (const int threads : {1, 3}) {
        Diagnostics diagnostics;
        Solver solver(b.model, {.threads = threads}, diagnostics);
        if (threads == 1) solver.attach(watch);
        ASSERT_EQ(solver.run(), StopReason::end_time);
        EXPECT_TRUE(diagnostics.all().empty() || diagnostics.warning_count() == 0);
        if (threads == 1) {
          hash = solver.state().registry.hash();
          EXPECT_LT(watch.worst_energy, 5e-3 * solver.state().energy.initial);
          EXPECT_GT(solver.state().energy.stonewall, 0);
        }
        // Nobody looks at the second run, whose forces are cleared on the way: positions and velocities are compared.
        if (threads == 3) {
          PlateWatch again;
          Solver looked_at(b.model, {.threads = threads}, diagnostics);
          looked_at.attach(again);
          ASSERT_EQ(looked_at.run(), StopReason::end_time);
          EXPECT_EQ(looked_at.state().registry.hash(), hash);
          EXPECT_EQ(looked_at.state().nodes.x, solver.state().nodes.x);
        }
      }
      EXPECT_TRUE(watch.touched);
      EXPECT_GT(watch.deepest, -1e-14);
      EXPECT_LT(watch.worst_impulse, 1e-9);  // of 1000 kg at 20 m/s
    }
  }
}

/// A cloud that flies in all directions about each kind of wall: nobody gets inside, the energy closes, and what a wall takes is never negative.
TEST(GeometricWall, NothingGetsInsideAndTheEnergyCloses) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 2), way(-20, 20);
  for (const Shape shape : {Shape::sphere, Shape::cylinder, Shape::prism}) {
    Cloud c;
    c.wall.shape = shape;
    c.wall.point = {0.1, 0.2, 0.3};
    c.wall.normal = normalized(Vec3{1, 2, 3});
    c.wall.edge_l = normalized(Vec3{2, -1, 0});
    c.wall.edge_m = cross(c.wall.normal, c.wall.edge_l);
    c.wall.length_l = c.wall.length_m = 1.1;
    c.wall.length_p = 1.3;
    c.wall.radius = 0.9;
    c.wall.friction = 0.2;
    c.wall.motion = c.curve({0, 1}, {5, 5});
    c.wall.motion_direction = {1, 0, 0};
    const WallShape where(c.wall);
    for (int i = 0; i < 300; ++i) {
      const Vec3 x{place(random), place(random), place(random)}, v{way(random), way(random), way(random)};
      if (where.depth(x).depth < 0) c.point(x, v);
    }
    c.gravity(2, 30);
    const WallRun run(c, 0.3, 1e-3);
    EXPECT_GT(run.stonewall, 0);
    EXPECT_GT(std::abs(run.external_work), 0);
    EXPECT_LT(run.energy_error(), 1e-12);
    double deepest = -1;
    for (const Vec3& x : run.x) deepest = std::max(deepest, where.depth(x - run.wall.displacement).depth);
    EXPECT_LT(deepest, 1e-13);
    EXPECT_EQ(WallRun(c, 0.3, 1e-3, 4).hash, run.hash);
  }
}

TEST(GeometricWall, NodesPassOutsideOfAFinitePlaneAndAreHeldOnIt) {
  Cloud c;
  c.wall.edge_l = {1, 0, 0};
  c.wall.edge_m = {0, 1, 0};
  c.wall.length_l = 2;
  c.wall.length_m = 1;
  c.point({1, 0.5, 0.1}, {0, 0, -1});     // lands
  c.point({2.1, 0.5, 0.1}, {0, 0, -1});   // passes
  c.point({2.1, 0.5, -0.1}, {-1, 0, 0});  // behind, under the wall: free …
  c.point({1.5, 0.5, -0.2}, {0, 0, -1});  // … begins behind, within the edges: held
  c.point({1.9, 0.5, 0.01}, {1, 0, -1});  // lands, slides over the edge and falls
  c.gravity(2, 10);
  const WallRun run(c, 1, 1e-3);
  EXPECT_NEAR(run.x[0].z, 0, 1e-15);
  EXPECT_NEAR(run.x[1].z, 0.1 - 1 - 5, 0.02);
  EXPECT_NEAR(run.x[2].z, -0.1 - 5, 0.02);
  EXPECT_EQ(run.x[3].z, -0.2);
  EXPECT_NEAR(run.x[4].x, 2.9, 1e-12);
  EXPECT_NEAR(run.x[4].z, -5 * 0.9 * 0.9, 0.02);
  EXPECT_NE(run.diagnostics.all().at(0).message.find("1 nodes begin behind"), std::string::npos);
}

/// What comes back from behind meets the plane from behind and goes through; from the front it is held again.
TEST(GeometricWall, NodesThatWentRoundCanComeBack) {
  Cloud c;
  c.wall.edge_l = {1, 0, 0};
  c.wall.edge_m = {0, 1, 0};
  c.wall.length_l = c.wall.length_m = 1;
  c.point({1.05, 0.5, 0.05}, {-1, 0, -3});  // passes the edge, turns under the wall, rises through it, falls on it
  c.gravity(2, -40);
  c.model.body_loads[0].curve = c.curve({0, 0.15, 0.1501, 1}, {-40, -40, 40, 40});
  const WallRun run(c, 0.8, 1e-3);
  EXPECT_NEAR(run.x[0].z, 0, 1e-14);
}

/// Nodes far away that come fast and late; the list of near nodes must not miss them.
TEST(GeometricWall, FarNodesAreNotMissed) {
  Cloud c;
  for (int i = 0; i < 50; ++i) c.point({0.1 * i, 0, 1 + 7.0 * i}, {0, 0, -1.0 * (1 + i * i)});
  for (int i = 0; i < 2100; ++i) c.point({0, 1, 1e4 + i}, {});  // many enough for a list
  c.gravity(2, 1000);
  const WallRun run(c, 1.0, 1e-3);
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(run.x[static_cast<std::size_t>(i)].z, 0, 1e-12) << i;
  EXPECT_LT(run.energy_error(), 1e-13);
}

TEST(GeometricWall, ForcesAreSplitOverSegments) {
  Cloud c;
  for (const Vec3& x : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}, Vec3{2, 1, 0}}) c.node(x);
  c.wall.segments = {{0, 1, 4, 3}, {1, 2, 5, 5}};
  c.wall.friction = 0.5;
  c.point({0.5, 0.5, 0}, {1, 0, 0}, 2);
  c.point({1.9, 0.2, 0}, {}, 3);
  c.point({1.1, 0.9, 0}, {}, 5);  // beside the triangle
  c.gravity(2, 10);
  const WallRun run(c, 0.1, 1e-3);
  EXPECT_NEAR(run.wall.segment_force[0].z, -20, 1e-9);
  EXPECT_NEAR(run.wall.segment_force[0].x, 10, 1e-9);
  EXPECT_NEAR(run.wall.segment_force[1].z, -30, 1e-9);
  EXPECT_NEAR(run.wall.force.z, -100, 1e-9);
}

}  // namespace
}  // namespace kardan

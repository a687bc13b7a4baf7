// Nodes that meet rigid walls by penalty springs (RWPNAL).
#include <gtest/gtest.h>

#include "contact/wall_cases.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

using test::Cloud;
using test::WallRun;

/// A rigid block of cubes of edge 0.1 (78 kg each in a row along z) as a cloud whose nodes a wall tracks.
struct RigidBlock : Cloud {
  RigidBlock(int cubes, const Vec3& place, const Vec3& velocity, double penalty = 1) {
    Section section;
    section.kind = ElementKind::solid;
    const PartIndex p = part(section, material_of(RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3}));
    for (int k = 0; k <= cubes; ++k)
      for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{0.1, 0, 0}, Vec3{0.1, 0.1, 0}, Vec3{0, 0.1, 0}}) wall.nodes.push_back(node(place + corner + Vec3{0, 0, 0.1 * k}));
    for (NodeIndex a = 0; a < 4 * cubes; a += 4) {
      model.solids.id.push_back(a + 1);
      model.solids.part.push_back(p);
      model.solids.nodes.push_back({a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7});
    }
    InitialVelocity initial;
    initial.velocity = velocity;
    initial.nodes = wall.nodes;
    model.initial_velocities.push_back(initial);
    model.control.contact.wall_penalty = penalty;
  }
};

/// A block falls flat on a plane and flies off as fast as it came.
TEST(WallPenalty, ABlockRebounds) {
  for (const double penalty : {0.1, 1.0, -1.0}) {
    RigidBlock c(3, {0, 0, 0.005}, {0, 0, -10}, penalty);
    const WallRun run(c, 0.01, 2e-5);
    for (const Vec3& v : run.v) EXPECT_NEAR(v.z, 10, 0.06) << penalty;
    EXPECT_NEAR(run.stonewall, 0, 0.01 * run.largest_energy);
    EXPECT_LT(run.energy_error(), 1e-12);
    EXPECT_GT(run.largest_force, 0);
    EXPECT_EQ(run.diagnostics.warning_count(), 0u);
  }
}

/// On a round wall, on one corner after the other, tumbling: the energy comes back, however the body turns.
TEST(WallPenalty, ABlockTumblesOverASphere) {
  RigidBlock c(4, {0.03, -0.02, 1.003}, {0.5, 1, -10});
  c.wall.shape = RigidWall::Shape::sphere;
  c.wall.radius = 1;
  const WallRun run(c, 0.05, 2e-5);
  EXPECT_GT(run.largest_force, 0);
  EXPECT_NEAR(run.stonewall, 0, 0.01 * run.largest_energy);
  EXPECT_LT(run.energy_error(), 1e-3);
}

/// Pressed down and pushed along x by accelerations a and b: slides with b - mu a, or creeps back and forth about its place.
TEST(WallPenalty, FrictionIsCoulombs) {
  for (const double mu : {0.0, 0.3, 0.6, 1.0}) {
    RigidBlock c(1, {0, 0, 0}, {});
    c.wall.friction = mu;
    c.gravity(2, 10);
    c.gravity(0, -5);
    const WallRun run(c, 0.1, 2e-5);
    EXPECT_NEAR(run.x[0].x, mu < 0.5 ? 0.5 * (5 - 10 * mu) * 0.01 : 0.0, 2e-4) << mu;
    EXPECT_NEAR(run.x[0].z, 0, 1e-5) << mu;
    EXPECT_LT(run.energy_error(), 1e-2) << mu;
  }
}

TEST(WallPenalty, AFreeWallGetsTheOppositeMomentum) {
  RigidBlock c(2, {0, 0, 0.001}, {0, 0, -4});
  c.wall.mass = 100;
  c.wall.velocity = 1;
  const WallRun run(c, 0.01, 2e-5);
  const double body = 2 * 7.8, before = 100 - 4 * body;
  EXPECT_NEAR(100 * run.wall.velocity.z + body * run.v[0].z, before, 1e-10 * 100);
  // An elastic impact: the velocity of approach comes back.
  EXPECT_NEAR(run.v[0].z - run.wall.velocity.z, 5, 0.05);
  EXPECT_LT(run.energy_error(), 1e-12);
}

TEST(WallPenalty, WhatBeginsInsideFeelsNoForceThere) {
  RigidBlock c(1, {0, 0, -0.02}, {});
  const WallRun run(c, 0.001, 2e-5);
  EXPECT_EQ(run.largest_force, 0);
  EXPECT_EQ(run.x[0].z, -0.02);
  EXPECT_NE(run.diagnostics.all().at(0).message.find("4 nodes begin behind"), std::string::npos);
}

TEST(WallPenalty, PlanesWithEdgesLetBodiesPass) {
  RigidBlock c(1, {1, 0, 0.01}, {0, 0, -1});
  c.wall.edge_l = {1, 0, 0};
  c.wall.edge_m = {0, 1, 0};
  c.wall.length_l = 0.9;
  c.wall.length_m = 1;
  const WallRun run(c, 0.5, 1e-4);
  EXPECT_NEAR(run.x[0].z, 0.01 - 0.5, 1e-12);
}

TEST(WallPenalty, FreeNodesWithNegativeRwpnal) {
  Cloud c;
  c.model.control.contact.wall_penalty = -1;
  c.wall.shape = RigidWall::Shape::sphere;
  c.wall.radius = 1;
  c.point({0.3, 0, 1}, {0, 0, -1});
  c.point({0, 0, 1.3}, {0, 0, -1}, 7);
  const WallRun run(c, 1, 1e-3);
  EXPECT_NEAR(run.v[1].z, 1, 0.01);  // omega dt = 0.3
  EXPECT_NEAR(norm(run.v[0]), 1, 0.01);
  EXPECT_LT(run.energy_error(), 1e-12);
}

TEST(WallPenalty, WhatIsNotAvailableIsAnError) {
  RigidBlock welded(1, {}, {}), stiff(1, {}, {}, 6);
  welded.wall.welds = true;
  for (RigidBlock* c : {&welded, &stiff}) {
    c->model.rigid_walls.assign(1, c->wall);
    c->model.control.termination.end_time = 1;
    Diagnostics diagnostics;
    EXPECT_THROW(Solver(c->model, {}, diagnostics), InputError);
  }
}

}  // namespace
}  // namespace kardan

// Ties by springs and tiebreaks, in the whole step.
#include "kardan/contact/tie_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/ties.hpp"

namespace kardan {
namespace {

using test::Balance;
using test::balance_of;
using test::Each;
using test::Ties;
using Holding = Tie::Holding;

TEST(TieSprings, KeepMomentaAndEnergy) {
  for (const bool rigid : {false, true}) {
    Ties b;
    const PartIndex low = rigid ? b.solid_part(RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3}) : b.solid_part(test::steel);
    const PartIndex high = b.solid_part(test::steel);
    b.block(low, {2, 2, 2}, {0, 0, -1}, {1, 1, 1});
    b.block(high, {3, 3, 4}, {0, 0, 0.01}, {1, 1, 1});
    b.tie(b.side({high}), {low}, Holding::offset);
    b.model.control.hourglass_type = 4;
    b.spin({0.3, 0.2, 0}, {300, -200, 400}, {50, 20, -10});
    b.model.control.termination.end_time = 0.01;
    const Balance worst = balance_of(b.model);
    EXPECT_LT(worst.linear, 1e-12) << rigid;
    EXPECT_LT(worst.angular, 1e-12) << rigid;
    EXPECT_LT(worst.energy, 1e-3) << rigid;
  }
  for (const bool torsion : {false, true}) {  // a web on a plate, rotations tied
    Ties b;
    const PartIndex floor = b.shell_part(test::steel, 0.02), web = b.shell_part(test::steel, 0.02);
    b.plate(floor, 3, 3, {}, {1, 0, 0}, {0, 1, 0});
    const NodeIndex edge = b.plate(web, 4, 3, {0.1, 0.55, 0.01}, {0.8, 0, 0}, {0, 0, 0.6});
    Tie& tie = b.tie(Ties::side_of_nodes(Ties::range(edge, edge + 5)), {floor}, Holding::beam_offset).tie;
    tie.rotations = true;
    tie.torsion = torsion;
    b.spin({0.3, 0.2, 0}, {30, -20, 40}, {50, 20, -10});
    b.model.control.time_step.scale = 0.45;
    b.model.control.termination.end_time = 0.01;
    const Balance worst = balance_of(b.model);
    EXPECT_LT(worst.linear, 1e-12) << torsion;
    EXPECT_LT(worst.angular, 1e-12) << torsion;
    EXPECT_LT(worst.energy, 1e-3) << torsion;
  }
}

/// Two bricks with a gap, all nodes driven once around an axis: the springs turn with them and stay without force.
TEST(TieSprings, RigidRotationLeavesNoForce) {
  Ties b;
  const PartIndex low = b.solid_part(test::steel), high = b.solid_part(test::steel);
  b.block(low, {1, 1, 1}, {1, 0, -1}, {1, 1, 1});
  b.block(high, {2, 2, 1}, {1, 0, 0.02}, {1, 1, 1});
  b.tie(b.side({high}), {low}, Holding::offset);
  const double time = 0.02, rate = 2 * std::numbers::pi / time;
  b.drive(Ties::range(0, b.node_count()), -10, rate);
  b.drive(Ties::range(0, b.node_count()), 2, 0);
  b.model.control.termination.end_time = time;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  double force = 0;
  solver.run();
  const State& s = solver.state();
  force = norm(s.contacts[0].force);
  EXPECT_EQ(s.contacts[0].touching, 9);
  double away = 0;
  for (std::size_t n = 0; n < s.nodes.x.size(); ++n) away = std::max(away, norm(s.nodes.x[n] - b.model.nodes.x[n]));
  EXPECT_LT(away, 1e-9);
  // A stretch of 1e-11 of the bricks' size at the stiffness of a whole brick, E.
  EXPECT_LT(force, 1e-11 * test::steel.youngs_modulus);
}

constexpr double square = 0.1;

/// A brick of edge `square` that a tiebreak ties to a larger one, which is held.
struct TiedBrick : Ties {
  NodeIndex first;
  explicit TiedBrick(const Tie& tie) {
    const PartIndex low = solid_part(test::steel), high = solid_part(test::steel);
    block(low, {1, 1, 1}, {-square, -square, -square}, {3 * square, 3 * square, square});
    first = block(high, {1, 1, 1}, {}, {square, square, square});
    Contact& c = this->tie(side({high}), {low}, Holding::offset);
    c.law = ContactLaw::tiebreak;
    c.two_way = true;
    c.tie = tie;
    for (NodeIndex n = 0; n < first; ++n) model.nodes.constrained[static_cast<std::size_t>(n)] = dof_all;
  }
  std::vector<NodeIndex> nodes() const { return range(first, first + 8); }
};

/// What is seen of one drawn off at a constant velocity.
struct Pull {
  double largest_force = 0, next = 0, energy = 0, released_at = 0;
};

Pull pull(const Tie& tie, const Vec3& velocity, double time) {
  TiedBrick b(tie);
  for (int dof = 1; dof <= 3; ++dof) b.drive(b.nodes(), dof, velocity[static_cast<std::size_t>(dof - 1)]);
  b.model.control.termination.end_time = time;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  Pull result;
  double before = 0;
  Each each([&](const State& s) {
    const double force = norm(s.contacts[0].force);
    if (force > result.largest_force) result.largest_force = force, result.next = force - before;  // growth a step
    before = force;
    if (force > 1e-6 * result.largest_force) result.released_at = s.clock.time;
    result.energy = s.energy.sliding;
  });
  solver.attach(each);
  solver.run();
  EXPECT_LT(before, 1e-6 * result.largest_force);  // sliding on, it may touch
  return result;
}

/// The largest force seen is below the limit by less than its growth in one step. Limits of nodes: four of them hold the brick.
TEST(TieBreak, LetsGoAtTheLimit) {
  Tie tie;
  tie.normal_limit = 3e3;
  tie.shear_limit = 2e3;
  const double speed = 1e-3, time = 1e-2;
  const auto at_limit = [&](const Vec3& direction, double limit) {
    const Pull p = pull(tie, direction * speed, time);
    EXPECT_LE(p.largest_force, limit * (1 + 1e-9));
    EXPECT_GT(p.largest_force + 1.01 * p.next, limit);
    EXPECT_LT(p.next, 0.1 * limit);
  };
  at_limit({0, 0, 1}, 4 * 3e3);
  at_limit({1, 0, 0}, 4 * 2e3);
  at_limit({0.6, 0, 0.8}, 4 / std::hypot(0.6 / 2e3, 0.8 / 3e3));
  tie.normal_exponent = tie.shear_exponent = 1;
  at_limit({0, 0.6, 0.8}, 4 / (0.6 / 2e3 + 0.8 / 3e3));
  tie.option = 2;  // stresses, quadratic
  tie.normal_exponent = tie.shear_exponent = 2;
  tie.normal_limit = 3e5;
  tie.shear_limit = 0;
  at_limit({0, 0, 1}, 3e5 * square * square);
}

TEST(TieBreak, PressureDoesNotBreakIt) {
  Tie tie;
  tie.normal_limit = 3e3;
  TiedBrick b(tie);
  b.drive(b.nodes(), 3, -1e-3);
  b.model.control.termination.end_time = 1e-2;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.run();
  EXPECT_EQ(solver.state().contacts[0].touching, 4);
  EXPECT_GT(solver.state().contacts[0].force.z, 4 * 3e3);
}

/// Drawn off until it is free, then pushed back: it touches where it was tied, and is pushed out.
TEST(TieBreak, IsAContactAfterwards) {
  Tie tie;
  tie.normal_limit = 3e3;
  TiedBrick b(tie);
  b.drive(b.nodes(), 3, 1);
  const double speed = 1e-3, turn = 5e-3;
  b.model.curves[0].x = {0, turn, turn * (1 + 1e-9), 1};
  b.model.curves[0].y = {speed, speed, -speed, -speed};
  b.model.control.termination.end_time = 2.4 * turn;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  double between = 0, first_touch = 0;
  Each each([&](const State& s) {
    const ContactReport& c = s.contacts[0];
    if (s.clock.time > 0.6 * turn && s.clock.time < 1.9 * turn) between = std::max(between, norm(c.force));
    if (s.clock.time > 0.6 * turn && first_touch == 0 && c.touching > 0) first_touch = s.clock.time;
  });
  solver.attach(each);
  solver.run();
  EXPECT_EQ(between, 0);
  EXPECT_NEAR(first_touch, 2 * turn, 0.05 * turn);
  EXPECT_GT(solver.state().contacts[0].force.z, 100);
}

/// Option 6: the whole work is half the stress at onset times CCRIT, by opening, shear or both.
TEST(TieBreak, DamageTakesTheEnergyOfATriangle) {
  Tie tie;
  tie.option = 6;
  tie.normal_limit = 3e5;
  tie.shear_limit = 2e5;
  tie.critical_distance = 2e-5;
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6, 0, 0.8}}) {
    const Pull p = pull(tie, direction * 1e-3, 2.2e-2);
    const double stress = 1 / std::hypot(std::hypot(direction.x, direction.y) / 2e5, direction.z / 3e5);
    EXPECT_NEAR(p.energy, 0.5 * stress * tie.critical_distance * square * square, 2e-3 * p.energy);
    EXPECT_NEAR(p.released_at, 2e-2, 1e-4);
  }
}

/// More springs than one thread does alone; a web tied to a plate, and blocks tied without springs.
TEST(Ties, GiveTheSameBitsForAnyNumberOfThreads) {
  Ties b;
  const PartIndex low = b.shell_part(test::steel, 0.02), high = b.shell_part(test::steel, 0.02);
  b.plate(low, 40, 40, {}, {1, 0, 0}, {0, 1, 0});
  const NodeIndex first = b.plate(high, 50, 50, {0.01, 0.02, 0.02}, {0.9, 0, 0}, {0, 0.9, 0});
  b.tie(b.side({high}), {low}, Holding::beam_offset).tie.rotations = true;
  const PartIndex block = b.solid_part(test::steel);
  b.block(block, {3, 3, 2}, {0.1, 0.1, 0.03}, {0.5, 0.5, 0.1});
  Contact& kinematic = b.tie(b.side({block}), {high}, Holding::constrained_offset);
  kinematic.tie.distance = 0.02;
  b.throw_from(first, first + 300, {0, 5, 20});
  b.model.control.termination.end_time = 1;
  b.model.control.termination.end_cycle = 8;
  const auto hash = [&](int threads) {
    Diagnostics diagnostics;
    Solver solver(b.model, {.threads = threads}, diagnostics);
    solver.run();
    EXPECT_GT(solver.state().contacts[0].touching, 2500);
    EXPECT_EQ(solver.state().contacts[1].touching, 16);
    return solver.state().registry.hash();
  };
  const std::uint64_t one = hash(1);
  EXPECT_EQ(hash(2), one);
  EXPECT_EQ(hash(3), one);
}

}  // namespace
}  // namespace kardan

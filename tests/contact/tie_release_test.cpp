// Ties that outlive elements: of deleted segments, and of nodes without elements.
#include <gtest/gtest.h>

#include <numeric>

#include "contact/ties.hpp"

namespace kardan {
namespace {

using test::Momenta;
using test::Ties;
using Holding = Tie::Holding;

constexpr double event = 2e-4;  ///< when elements are deleted

void erode(Model& model, PartIndex part) {
  ErosionCriteria criteria;
  criteria.time = event;
  model.materials[part].erosion = criteria;
}

/// Two coarse blocks side by side under a fine one, 4 by 4 nodes of which half lie over each.
struct Blocks : Ties {
  PartIndex left, right, high;
  NodeIndex first_high;
  explicit Blocks(Holding holding, bool tied = true) {
    left = solid_part(test::steel);
    right = solid_part(test::steel);
    high = solid_part(test::steel);
    block(left, {1, 2, 1}, {0, 0, -0.5}, {0.5, 1, 0.5});
    block(right, {1, 2, 1}, {0.5, 0, -0.5}, {0.5, 1, 0.5});
    first_high = block(high, {3, 3, 2}, {0, 0, holding == Holding::constraint ? 0.0 : 0.01}, {1, 1, 0.5});
    if (tied) tie(side({high}), {left, right}, holding);
    model.control.hourglass_type = 4;
    model.control.time_step.scale = 0.5;
    model.control.termination.end_time = 4e-4;
    spin({0.5, 0.5, 0}, {0, 0, 300}, {5, 3, -10});
  }
};

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

std::vector<double> masses_of(const Model& model) {
  Diagnostics diagnostics;
  return Solver(model, {}, diagnostics).state().nodes.mass;
}

/// What a run with a deletion shows.
struct Outcome {
  std::int64_t before = -1, after = -1;  ///< nodes tied by the first contact
  double linear = 0, energy = 0, force_after = 0, eroded_kinetic = 0;
  std::vector<double> mass;
};

Outcome watch(const Model& model) {
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << test::messages(diagnostics);
  Outcome o;
  std::vector<Momenta> first;
  test::Each each([&](const State& s) {
    const Momenta now(s);
    if (first.empty()) first.push_back(now);
    o.linear = std::max(o.linear, norm(now.linear - first[0].linear) / norm(first[0].linear));
    o.energy = std::max(o.energy, std::abs(s.energy.total() - s.energy.initial) / s.energy.initial);
    (s.clock.time < event ? o.before : o.after) = s.contacts[0].touching;
    if (s.clock.time > event + 2 * s.clock.dt) o.force_after = std::max(o.force_after, norm(s.contacts[0].force));
  });
  solver.attach(each);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  o.mass = solver.state().nodes.mass;
  o.eroded_kinetic = solver.state().energy.eroded_kinetic / solver.state().energy.initial;
  return o;
}

/// The segments' elements go, one half or all: the ties over them end, no force is left of them, momentum stays, the ledger closes, and every
/// node has the mass that it would have without them.
TEST(TieRelease, SegmentsOfDeletedElementsLetGo) {
  for (const Holding holding : {Holding::constraint, Holding::constrained_offset, Holding::offset})
    for (const bool all : {false, true}) {
      SCOPED_TRACE(testing::Message() << "holding " << static_cast<int>(holding) << ", all " << all);
      Blocks b(holding);
      erode(b.model, b.left);
      if (all) erode(b.model, b.right);
      const Outcome o = watch(b.model);
      EXPECT_EQ(o.before, 16);
      EXPECT_EQ(o.after, all ? 0 : 8);
      EXPECT_LT(o.linear, 1e-12);
      EXPECT_LT(o.energy, 2e-3);
      EXPECT_LT(std::abs(o.eroded_kinetic), 0.05);
      if (!all) continue;
      EXPECT_EQ(o.force_after, 0);
      const std::vector<double> alone = masses_of(Blocks(holding, false).model);
      for (std::size_t n = 0; n < alone.size(); ++n) EXPECT_NEAR(o.mass[n], alone[n], 1e-12 * sum(alone)) << n;
    }
}

/// A web that is tied to a plate with its rotations: masses and rotary inertias come back, too, and the result is the same for any number of threads.
TEST(TieRelease, RotationsLetGo) {
  const auto web_on_plate = [](bool tied) {
    Ties b;
    const PartIndex floor = b.shell_part(test::steel, 0.02), web = b.shell_part(test::steel, 0.02);
    b.plate(floor, 3, 3, {}, {1, 0, 0}, {0, 1, 0});
    const NodeIndex edge = b.plate(web, 4, 3, {0.1, 0.55, 0.01}, {0.8, 0, 0}, {0, 0, 0.6});
    if (tied) b.tie(Ties::side_of_nodes(Ties::range(edge, edge + 5)), {floor}, Holding::constrained_offset).tie.rotations = true;
    b.spin({0.3, 0.2, 0}, {30, -20, 40}, {50, 20, -10});
    b.model.control.time_step.scale = 0.45;
    b.model.control.termination.end_time = 4e-4;
    erode(b.model, floor);
    return b.model;
  };
  const Outcome o = watch(web_on_plate(true));
  EXPECT_EQ(o.before, 5);
  EXPECT_EQ(o.after, 0);
  EXPECT_LT(o.linear, 1e-12);
  EXPECT_LT(o.energy, 2e-3);
  Diagnostics diagnostics;
  const Model model = web_on_plate(true), alone = web_on_plate(false);
  const Solver without(alone, {}, diagnostics);
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Solver solver(model, {.threads = threads}, diagnostics);
    solver.run();
    hashes.push_back(solver.state().registry.hash());
    const NodeState &now = solver.state().nodes, &own = without.state().nodes;
    for (std::size_t n = 0; n < own.mass.size(); ++n) {
      EXPECT_NEAR(now.mass[n], own.mass[n], 1e-12 * sum(own.mass)) << n;
      EXPECT_NEAR(now.inertia[n], own.inertia[n], 1e-12 * sum(own.inertia)) << n;
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

/// All elements of the tied nodes go: the ties end likewise.
TEST(TieRelease, NodesWithoutElementsLetGo) {
  for (const Holding holding : {Holding::constraint, Holding::offset}) {
    Blocks b(holding);
    erode(b.model, b.high);
    const Outcome o = watch(b.model);
    EXPECT_EQ(o.before, 16);
    EXPECT_EQ(o.after, 0);
    EXPECT_EQ(o.force_after, 0);
    EXPECT_LT(o.linear, 1e-12);
    EXPECT_LT(o.energy, 2e-3);
  }
}

/// A block tied to a plate of shells that is tied to a block below; one of the ties ends: masses are those of a model that only has the other one.
TEST(TieRelease, ChainsKeepWhatIsLeft) {
  struct Chain : Ties {
    PartIndex low = solid_part(test::steel), plate_part = shell_part(test::steel, 0.02), top = solid_part(test::steel);
    Chain(bool below, bool above) {
      block(low, {2, 2, 1}, {0, 0, -0.5}, {1, 1, 0.5});
      plate(plate_part, 3, 3, {}, {1, 0, 0}, {0, 1, 0});
      block(top, {4, 4, 1}, {}, {1, 1, 0.3});
      if (below) tie(side({plate_part}), {low}, Holding::constraint);
      if (above) tie(side({top}), {plate_part}, Holding::constraint);
      model.control.hourglass_type = 4;
      model.control.time_step.scale = 0.5;
      model.control.termination.end_time = 4e-4;
      start(0, node_count(), [](const Vec3&) { return Vec3{5, 3, -10}; });
    }
  };
  for (const bool lower_ends : {false, true}) {
    SCOPED_TRACE(lower_ends);
    Chain c(true, true);
    erode(c.model, lower_ends ? c.low : c.top);
    const Outcome o = watch(c.model);
    EXPECT_EQ(o.before, 16);
    EXPECT_EQ(o.after, lower_ends ? 0 : 16);
    EXPECT_LT(o.linear, 1e-12);
    const std::vector<double> left = masses_of(Chain(!lower_ends, lower_ends).model);
    for (std::size_t n = 0; n < left.size(); ++n) EXPECT_NEAR(o.mass[n], left[n], 1e-12 * sum(left)) << n;
  }
}

}  // namespace
}  // namespace kardan

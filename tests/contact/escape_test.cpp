// Nothing gets through edges, corners and junctions.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

constexpr double size = 1.0, thick = 0.02;

/// `count` directions spread evenly over the sphere.
Vec3 direction(int i, int count) {
  const double z = 1 - (2 * i + 1.0) / count, phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
  return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

/// The six sides of a cube [0, size]^3, n x n shells each, sharing nodes.
void add_box(test::Meshes& m, PartIndex p, int n, const std::function<Vec3(const Vec3&)>& map = {}) {
  std::map<std::array<int, 3>, NodeIndex> node;
  const auto at = [&](int i, int j, int k) {
    const auto [entry, is_new] = node.try_emplace({i, j, k}, none);
    const Vec3 x = Vec3{double(i), double(j), double(k)} * (size / n);
    if (is_new) entry->second = m.node(map ? map(x) : x);
    return entry->second;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (const int k : {0, n}) {
        m.shell(p, {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)});
        m.shell(p, {at(i, k, j), at(i + 1, k, j), at(i + 1, k, j + 1), at(i, k, j + 1)});
        m.shell(p, {at(k, i, j), at(k, i + 1, j), at(k, i + 1, j + 1), at(k, i, j + 1)});
      }
}

double largest_coordinate(const Vec3& x) { return std::max({std::abs(x.x - 0.5), std::abs(x.y - 0.5), std::abs(x.z - 0.5)}); }

/// Nodes fly from the middle of a box of shells in 200 directions, many of them into its edges and corners, and go on bouncing.
TEST(Escape, FromABoxInNoDirection) {
  test::Meshes m;
  const PartIndex p = m.fixed_shell_part(thick);
  add_box(m, p, 5);
  std::vector<NodeIndex> nodes;
  for (int i = 0; i < 200; ++i) {
    Vec3 d = direction(i, 200);
    if (i % 4 == 1) d = normalized(Vec3{d.x > 0 ? 1.0 : -1.0, d.y > 0 ? 1.0 : -1.0, d.z > 0 ? 1.0 : -1.0} + d * 0.01);  // a corner
    if (i % 4 == 2) d = normalized(Vec3{d.x > 0 ? 1.0 : -1.0, d.y > 0 ? 1.0 : -1.0, d.z * 0.7});                    // an edge
    nodes.push_back(m.point({0.5, 0.5, 0.5}, 0.2, d * 50));
  }
  m.nodes_to_surface(nodes, {p}).reference.stiffness_scale = 0.1;
  m.model.control.termination.end_time = 0.05;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 5e-6}, diagnostics);
  test::Watch watch;
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  for (const NodeIndex n : nodes) {
    EXPECT_LT(largest_coordinate(solver.state().nodes.x[n]), 0.5) << n;
    EXPECT_LT(norm(solver.state().nodes.v[n]), 52) << n;  // some are in touch now
  }
  EXPECT_LT(watch.energy_error, 0.02 * watch.energy);
}

/// Heavy fast nodes push through the mid-surface of the shells and are brought back.
TEST(Escape, HardPushesAreBroughtBack) {
  test::Meshes m;
  const PartIndex p = m.fixed_shell_part(thick);
  add_box(m, p, 5);
  std::vector<NodeIndex> nodes;
  for (int i = 0; i < 200; ++i) nodes.push_back(m.point({0.5, 0.5, 0.5}, 400, direction(i, 200) * 100));
  m.nodes_to_surface(nodes, {p});
  m.model.control.termination.end_time = 0.03;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 5e-6}, diagnostics);
  double farthest = 0;
  test::Watch watch;
  watch.each = [&](const Model&, const State& s) {
    for (const NodeIndex n : nodes) farthest = std::max(farthest, largest_coordinate(s.nodes.x[n]));
  };
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_GT(farthest, 0.5);  // it was hard enough
  EXPECT_LT(farthest, 0.6);
  for (const NodeIndex n : nodes) EXPECT_LT(largest_coordinate(solver.state().nodes.x[n]), 0.56) << n;
}

/// Nodes fly onto the edges and corners of a box of shells, or of solids, from outside.
TEST(Escape, IntoABoxInNoDirection) {
  for (const bool solid : {false, true}) {
    test::Meshes m;
    const PartIndex p = solid ? m.solid_part(m.model.materials.empty() ? decltype(Material::law)(ElasticMaterial{7800, 210e9, 0.3, 0, 0})
                                                                       : m.model.materials[0].law)
                              : m.fixed_shell_part(thick);
    if (solid) {
      m.model.materials[0].law = RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3, .cmo = 1, .con1 = 7, .con2 = 7};
      m.block(p, {4, 4, 4}, {}, {size, size, size});
    } else {
      add_box(m, p, 4);
    }
    std::vector<NodeIndex> nodes;
    for (int i = 0; i < 200; ++i) {
      const Vec3 target = i % 3 == 0 ? Vec3{1, 1, 1} : (i % 3 == 1 ? Vec3{1, 1, 0.37} : Vec3{1, 0.5, 0.25});
      Vec3 d = direction(i, 200);
      d = {std::abs(d.x), i % 3 == 2 ? d.y : std::abs(d.y), i % 3 == 0 ? std::abs(d.z) : d.z};  // of the outside there
      nodes.push_back(m.point(target + d * 0.5, 0.2, d * -50));
    }
    m.nodes_to_surface(nodes, {p}).reference.stiffness_scale = 0.1;
    m.model.control.termination.end_time = 0.025;
    Diagnostics diagnostics;
    Solver solver(m.model, {.dt = 5e-6}, diagnostics);
    test::Watch watch;
    double deepest = 1;
    watch.each = [&](const Model&, const State& s) {
      for (const NodeIndex n : nodes) deepest = std::min(deepest, largest_coordinate(s.nodes.x[n]));
    };
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    EXPECT_GT(deepest, 0.495) << solid;
    for (const NodeIndex n : nodes) EXPECT_GT(largest_coordinate(solver.state().nodes.x[n]), 0.5) << n << solid;
    EXPECT_LT(watch.energy_error, 0.02 * watch.energy);
  }
}

/// A vertical sheet stands on a horizontal one, with common nodes: nodes driven into the two corners and at the bottom stay in their rooms.
TEST(Escape, ThroughATJunctionInNoDirection) {
  test::Meshes m;
  const PartIndex p = m.fixed_shell_part(thick);
  const int n = 6;
  const NodeIndex floor = m.plate(p, n, n, {-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0});
  std::vector<NodeIndex> row;
  for (int j = 0; j <= n; ++j) row.push_back(floor + j * (n + 1) + n / 2);
  for (int k = 1; k <= 3; ++k) {
    std::vector<NodeIndex> next;
    for (int j = 0; j <= n; ++j) next.push_back(m.node({0, -0.5 + double(j) / n, k / 6.0}));
    for (int j = 0; j < n; ++j) m.shell(p, {row[j], row[j + 1], next[j + 1], next[j]});
    row = next;
  }
  std::vector<NodeIndex> nodes;
  std::vector<Vec3> start;
  for (int i = 0; i < 200; ++i) {
    Vec3 d = direction(i, 200);
    d.y *= 0.5;
    const Vec3 target{0, 0.03, 0};
    Vec3 from = target + normalized(d) * 0.2;
    if (std::abs(from.x) < 0.015) from.x = from.x < 0 ? -0.015 : 0.015;
    if (std::abs(from.z) < 0.015) from.z = from.z < 0 ? -0.015 : 0.015;
    start.push_back(from);
    nodes.push_back(m.point(from, i % 2 ? 0.2 : 100, normalized(target - from) * (i % 2 ? 50 : 60)));
  }
  m.nodes_to_surface(nodes, {p});
  m.model.control.termination.end_time = 0.006;  // too short to get around an end
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 5e-6}, diagnostics);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 &x = solver.state().nodes.x[nodes[i]], &from = start[i];
    EXPECT_GT(x.z * from.z, 0) << i << " from " << from.x << " " << from.y << " " << from.z << " to " << x.x << " " << x.y << " " << x.z;
    if (from.z > 0 && x.z < 0.5) {
      EXPECT_GT(x.x * from.x, 0) << i << " from " << from.x << " " << from.y << " " << from.z << " to " << x.x << " " << x.y << " " << x.z;
    }
  }
}

/// A rigid block with edges and corners tumbles in a rigid box for 1,000 impacts.
TEST(Escape, ABlockInARigidBoxKeepsItsEnergyFor1000Impacts) {
  test::Meshes m;
  const PartIndex p = m.fixed_shell_part(thick);
  add_box(m, p, 2);
  const PartIndex q = m.solid_part(RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3});
  const NodeIndex first = m.block(q, {2, 2, 2}, {0.24, 0.25, 0.26}, {0.5, 0.46, 0.42});
  InitialVelocity v;
  v.velocity = {61, 37, 23};
  for (NodeIndex n = first; n < m.node_count(); ++n) v.nodes.push_back(n);
  m.model.initial_velocities.push_back(v);
  m.surface_to_surface({q}, {p});
  m.model.sections[0].shell.thickness.fill(0.1);
  m.model.control.termination.end_time = 4;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 1.5e-5}, diagnostics);
  struct Count : Observer {
    bool due(const State& s, const StepView&) override { return s.clock.cycle % 4 == 0; }
    bool reads_nodes() const override { return false; }
    void at(const Model&, const State& s, const StepView&) override {
      const ContactReport& c = s.contacts[0];
      impacts += c.touching > 0 && !touched;
      touched = c.touching > 0;
      if (s.clock.cycle == 0) energy = s.energy.kinetic;
      if (!touched) worst = std::max(worst, std::abs(s.energy.kinetic - energy));
      farthest = std::max(farthest, largest_coordinate(s.bodies.motion[1].center));
    }
    int impacts = 0;
    bool touched = false;
    double energy = 0, worst = 0, farthest = 0;
  } count;
  solver.attach(count);
  while (count.impacts < 1000 && solver.step()) {
  }
  EXPECT_GE(count.impacts, 1000);
  EXPECT_LT(count.worst, 0.01 * count.energy);
  EXPECT_LT(count.farthest, 0.4);
}

}  // namespace
}  // namespace kardan

// What a kernel leaves behind, whatever the formulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kardan/base/aligned.hpp"
#include "kardan/base/isa.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "kardan/materials/laws/elastic.hpp"
#include "kardan/materials/laws/elastic_plane_stress.hpp"

namespace kardan {
namespace {

constexpr std::size_t elements = 5;  ///< of one block; the other lanes are empty

/// A row of elements whose nodes move, each row of nodes at the places `corner` of an element.
struct Row {
  std::vector<std::uint16_t> connectivity;
  AlignedVector<double> node, history, sum, force;
  TileWork work;

  Row(std::size_t components, std::size_t nodes_per_element, std::size_t history_size) {
    const std::size_t rows = nodes_per_element / 2, along = elements + 1, stride = node_stride(components);
    // Corners of an element in the order of the nodes: row, and 0 or 1 along the rows.
    constexpr std::size_t row[8] = {0, 0, 1, 1, 2, 2, 3, 3}, next[8] = {0, 1, 1, 0, 0, 1, 1, 0};
    connectivity.resize(nodes_per_element * block_lanes);
    for (std::size_t a = 0; a < nodes_per_element; ++a) {
      for (std::size_t l = 0; l < block_lanes; ++l) {
        connectivity[a * block_lanes + l] = static_cast<std::uint16_t>(row[a] * along + std::min(l, elements - 1) + next[a]);
      }
    }
    work.nodes = rows * along;
    node.resize(work.nodes * stride);
    for (std::size_t n = 0; n < work.nodes; ++n) {
      const auto x = static_cast<double>(n % along), y = static_cast<double>(n / along % 2), z = static_cast<double>(n / along / 2);
      const double values[12] = {x, y, z, 0, std::sin(3 * x + y), std::cos(2 * y + z + x), std::sin(x - z), 0, 0.3 * x, 0.2 * y, 0.1, 0};
      std::copy(values, values + stride, node.begin() + static_cast<std::ptrdiff_t>(n * stride));
    }
    history.assign(history_size * block_lanes, 0.0);
    sum.assign(work.nodes * sum_stride(components), 0.0);
    force.assign(work.nodes * components, std::nan(""));
    work.connectivity = connectivity.data();
    work.elements = elements;
    work.node = node.data();
    work.step = {1e-3, 0.0};
    work.history = history.data();
    work.sum = sum.data();
    work.force = force.data();
  }
  void set(std::size_t value, double to) { std::fill_n(history.begin() + static_cast<std::ptrdiff_t>(value * block_lanes), block_lanes, to); }
};

AlignedVector<double> forces_of_shells(bool past_caches) {
  const ElasticPlaneStress law = ElasticPlaneStress::from(200.0, 0.3, 5.0 / 6.0);
  ShellProperties p;
  p.law.constants = &law;
  p.zeta[0] = -0.5, p.zeta[1] = 0.5;
  p.weight[0] = p.weight[1] = 1;
  p.wave_speed = 1;
  p.hourglass_membrane = 1;
  Row row(6, 4, shell_history_size(p, 0));
  row.set(shell_kept(p, 0) + kept_thickness, 0.1);
  row.work.properties = &p;
  row.work.past_caches = past_caches;
  belytschko_tsay().elastic(row.work);
  EXPECT_EQ(row.sum, AlignedVector<double>(row.sum.size(), 0.0));  // for the next tile
  return row.force;
}

AlignedVector<double> forces_of_solids(bool past_caches) {
  const Elastic law = Elastic::from(200.0, 0.3);
  SolidProperties p;
  p.law.constants = &law;
  p.density = p.wave_speed = 1;
  p.longitudinal = law.longitudinal();
  p.hourglass_scale = 1;
  Row row(3, 8, one_point_hexahedron.history_size(0));
  row.set(solid_history::volume, 1);
  row.set(solid_history::inverse_size, 1);
  row.work.properties = &p;
  row.work.past_caches = past_caches;
  one_point_hexahedron.kernels().elastic(row.work);
  EXPECT_EQ(row.sum, AlignedVector<double>(row.sum.size(), 0.0));
  return row.force;
}

TEST(TileKernel, WritesTheSameSlotsPastTheCachesAndClearsItsSums) {
  for (int level = lowest_kernel_level; level <= native_level(); ++level) {
    set_kernel_level(level);
    for (const auto forces : {forces_of_shells, forces_of_solids}) {
      const AlignedVector<double> usual = forces(false);
      EXPECT_GT(std::abs(usual.front()), 0.0);
      EXPECT_EQ(usual, forces(true));  // also: every slot has been written, none is the NaN of before
    }
  }
  set_kernel_level(0);
}

}  // namespace
}  // namespace kardan

#include "kardan/parallel/tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace kardan {
namespace {

TEST(Hilbert, NeighboursOnTheCurveAreNeighboursInSpace) {
  std::map<std::uint64_t, std::array<int, 3>> cells;
  const std::uint32_t size = 8, shift = 13;
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t j = 0; j < size; ++j) {
      for (std::uint32_t k = 0; k < size; ++k) {
        cells[hilbert_key(i << shift, j << shift, k << shift) >> (3 * shift)] = {int(i), int(j), int(k)};
      }
    }
  }
  ASSERT_EQ(cells.size(), size * size * size);
  const std::array<int, 3>* last = nullptr;
  for (const auto& [key, c] : cells) {
    if (last) {
      EXPECT_EQ(std::abs(c[0] - (*last)[0]) + std::abs(c[1] - (*last)[1]) + std::abs(c[2] - (*last)[2]), 1) << key;
    }
    last = &c;
  }
}

struct Grid {
  std::vector<Vec3> x;
  std::vector<NodeIndex> nodes;
  std::vector<PartIndex> part;
  std::vector<Index> elements;

  Grid(int nx, int ny) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) x.push_back({double(i), double(j), 0});
    }
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const int n = j * (nx + 1) + i;
        for (const int k : {n, n + 1, n + nx + 2, n + nx + 1}) nodes.push_back(k);
        elements.push_back(static_cast<Index>(part.size()));
        part.push_back(i < nx / 3 ? 1 : 0);
      }
    }
  }
  TileInput input() const { return {elements, part, nodes, 4, x}; }
};

TEST(Tiles, HoldEveryElementOnceAndOnePartEach) {
  const Grid grid(50, 37);
  const TileMesh mesh = cut_tiles(grid.input(), 100);
  std::set<Index> seen;
  for (const Tile& tile : mesh.tiles) {
    EXPECT_LE(tile.elements, 100u);
    EXPECT_EQ(tile.blocks, (tile.elements + block_lanes - 1) / block_lanes);
    for (std::size_t i = 0; i < tile.elements; ++i) {
      const Index e = mesh.element[tile.first_block * block_lanes + i];
      EXPECT_TRUE(seen.insert(e).second);
      EXPECT_EQ(grid.part[e], tile.part);
      for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t block = tile.first_block + i / block_lanes, lane = i % block_lanes;
        const std::uint16_t local = mesh.connectivity[(block * 4 + a) * block_lanes + lane];
        ASSERT_LT(local, tile.nodes);
        EXPECT_EQ(mesh.node[tile.first_node + local], grid.nodes[e * 4 + a]);
      }
    }
  }
  EXPECT_EQ(seen.size(), grid.elements.size());
  // Compact: a tile of 100 squares has far fewer than 400 nodes.
  EXPECT_LT(mesh.node.size(), grid.elements.size() * 15 / 10);
}

TEST(Tiles, DoNotDependOnTheOrderInWhichElementsAreNamed) {
  Grid grid(20, 20);
  const TileMesh a = cut_tiles(grid.input(), 64);
  std::reverse(grid.elements.begin(), grid.elements.end());
  const TileMesh b = cut_tiles(grid.input(), 64);
  EXPECT_EQ(a.element, b.element);
  EXPECT_EQ(a.node, b.node);
}

TEST(Slots, SumToTheNodes) {
  const Grid grid(20, 20);
  const TileMesh mesh = cut_tiles(grid.input(), 64);
  SlotSum slots(mesh, grid.x.size(), 6);
  for (const Tile& tile : mesh.tiles) {
    double* s = slots.slots(tile);
    std::fill(s, s + 6 * tile.nodes, 0.0);
    for (std::size_t i = 0; i < tile.elements; ++i) {
      for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t block = tile.first_block + i / block_lanes, lane = i % block_lanes;
        s[6 * mesh.connectivity[(block * 4 + a) * block_lanes + lane]] += 1;
        s[6 * mesh.connectivity[(block * 4 + a) * block_lanes + lane] + 5] += 2;
      }
    }
  }
  std::vector<Vec3> force(grid.x.size(), Vec3{10, 0, 0}), moment(grid.x.size());
  const auto half = static_cast<NodeIndex>(force.size() / 2);
  slots.add_to(force, moment, 0, half);
  slots.add_to(force, moment, half, static_cast<NodeIndex>(force.size()));
  std::vector<int> valence(grid.x.size(), 0);
  for (const NodeIndex n : grid.nodes) ++valence[n];
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_EQ(force[n].x, 10 + valence[n]);
    EXPECT_EQ(moment[n].z, 2 * valence[n]);
  }
}

}  // namespace
}  // namespace kardan

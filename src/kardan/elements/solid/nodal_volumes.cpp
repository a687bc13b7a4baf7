#include "kardan/elements/solid/nodal_volumes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace kardan {

namespace {

std::array<std::uint16_t, 4> local_nodes(const TileMesh& mesh, std::size_t place) {
  const std::uint16_t* c = mesh.connectivity.data() + place / block_lanes * 4 * block_lanes + place % block_lanes;
  return {c[0], c[block_lanes], c[2 * block_lanes], c[3 * block_lanes]};
}

double volume_of(const TileMesh& mesh, const Tile& tile, const std::array<std::uint16_t, 4>& local, const std::vector<Vec3>& x) {
  const auto at = [&](std::size_t a) -> const Vec3& { return x[static_cast<std::size_t>(mesh.node[tile.first_node + local[a]])]; };
  const Vec3 origin = at(0);
  return dot(at(1) - origin, cross(at(2) - origin, at(3) - origin)) / 6.0;
}

}  // namespace

void NodalVolumes::set_up(const TileElements& tetrahedra, const std::vector<std::uint8_t>& nodal, const std::vector<Vec3>& x0) {
  const TileMesh& mesh = tetrahedra.mesh();
  std::vector<std::tuple<PartIndex, NodeIndex, std::uint32_t>> pairs;
  start_.assign(mesh.element.size(), 0.0);
  slots_.resize(mesh.node.size());
  for (const Tile& tile : mesh.tiles) {
    if (nodal[static_cast<std::size_t>(tile.part)] == 0) continue;
    tiles_.push_back(&tile);
    for (std::size_t k = tile.first_node; k < tile.first_node + tile.nodes; ++k)
      pairs.emplace_back(tile.part, mesh.node[k], static_cast<std::uint32_t>(k));
    for (std::size_t i = 0; i < tile.elements; ++i) {
      const std::size_t place = tile.first_block * block_lanes + i;
      start_[place] = volume_of(mesh, tile, local_nodes(mesh, place), x0);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [part, node, slot] = pairs[i];
    if (i == 0 || part != std::get<0>(pairs[i - 1]) || node != std::get<1>(pairs[i - 1])) first_.push_back(static_cast<std::uint32_t>(i));
    slot_of_.push_back(slot);
  }
  first_.push_back(static_cast<std::uint32_t>(pairs.size()));
}

void NodalVolumes::add_tile(const TileElements& tetrahedra, const State& state, const Tile& tile) {
  const TileMesh& mesh = tetrahedra.mesh();
  Sum* const slots = slots_.data() + tile.first_node;
  std::fill(slots, slots + tile.nodes, Sum{});
  for (std::size_t i = 0; i < tile.elements; ++i) {
    const std::size_t place = tile.first_block * block_lanes + i;
    if (!(tetrahedra.alive(mesh.element[place]) > 0)) continue;
    const std::array<std::uint16_t, 4> local = local_nodes(mesh, place);
    const double now = volume_of(mesh, tile, local, state.nodes.x);
    for (const std::uint16_t n : local) {
      slots[n].now += 0.25 * now;
      slots[n].start += 0.25 * start_[place];
    }
  }
}

void NodalVolumes::compute(const TileElements& tetrahedra, const State& state, std::vector<double>& values) {
  const auto tiles = static_cast<std::ptrdiff_t>(tiles_.size()), pairs = static_cast<std::ptrdiff_t>(first_.size()) - 1;
#pragma omp parallel for schedule(static) if (tiles > 1)
  for (std::ptrdiff_t t = 0; t < tiles; ++t) add_tile(tetrahedra, state, *tiles_[static_cast<std::size_t>(t)]);
#pragma omp parallel for schedule(static) if (tiles > 1)
  for (std::ptrdiff_t i = 0; i < pairs; ++i) {
    const auto p = static_cast<std::size_t>(i);
    Sum sum;
    for (std::uint32_t k = first_[p]; k < first_[p + 1]; ++k) {
      sum.now += slots_[slot_of_[k]].now;
      sum.start += slots_[slot_of_[k]].start;
    }
    const double ratio = sum.start > 0 ? sum.now / sum.start : 1.0;
    for (std::uint32_t k = first_[p]; k < first_[p + 1]; ++k) values[slot_of_[k]] = ratio;
  }
}

}  // namespace kardan

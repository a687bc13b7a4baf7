// Tiles: a few hundred elements of one part, neighbours in space, with a compact list of nodes of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/lanes.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Place of a point in the unit cube on a Hilbert curve of 16 levels: near keys are near points.
/// @param u coordinates scaled to 0..65535.
/// Source: Skilling 2004, AIP Conf. Proc. 707, 381-387 (transposed axes to index).
std::uint64_t hilbert_key(std::uint32_t ux, std::uint32_t uy, std::uint32_t uz);

struct Tile {
  PartIndex part = none;
  std::size_t first_block = 0, blocks = 0;  ///< of the mesh's connectivity, block_lanes elements each
  std::size_t elements = 0;                 ///< the last block may have empty lanes: they repeat the last element
  std::size_t first_node = 0, nodes = 0;    ///< into TileMesh::node; also the tile's slots
};

/// Elements of one formulation, cut into tiles from the model alone (never from the number of threads or ranks).
struct TileMesh {
  std::size_t nodes_per_element = 0;
  std::vector<Tile> tiles;
  std::vector<std::uint16_t> connectivity;  ///< [block][node of the element][lane] -> local node of the tile
  std::vector<Index> element;               ///< [block][lane] -> element of the model
  std::vector<NodeIndex> node;              ///< local nodes of all tiles, tile by tile, ascending in each -> node of the model

  bool empty() const { return tiles.empty(); }
};

/// What is cut: `elements` are indices into the arrays.
struct TileInput {
  std::span<const Index> elements;
  std::span<const PartIndex> part;       ///< by element of the model
  std::span<const NodeIndex> nodes;      ///< [element of the model][nodes_per_element]
  std::size_t nodes_per_element = 0;
  std::span<const Vec3> x;               ///< by node, initial coordinates
};

/// Cuts tiles of at most `tile_size` elements: part by part, along the Hilbert curve of the centroids.
TileMesh cut_tiles(const TileInput& input, std::size_t tile_size = 512);

/// Sums of the tiles' contributions to nodes: every tile writes one slot per local node, and a node's value is the sum of its
/// slots in the order of the tiles, whoever computed them.
class SlotSum {
 public:
  /// @param components doubles a slot: 3 for forces, 6 for forces and moments.
  SlotSum(const TileMesh& mesh, std::size_t node_count, std::size_t components);

  /// Slots of a tile: [local node][component], overwritten by the tile each cycle.
  double* slots(const Tile& tile) { return values_.data() + tile.first_node * components_; }
  /// Adds the sums to the forces (and moments) of the nodes begin <= n < end.
  void add_to(std::vector<Vec3>& force, std::vector<Vec3>& moment, NodeIndex begin, NodeIndex end) const;
  /// Nodes that have slots, ascending.
  const std::vector<NodeIndex>& nodes() const { return nodes_; }

 private:
  std::size_t components_;
  std::vector<double> values_;
  std::vector<NodeIndex> nodes_;
  std::vector<std::uint32_t> first_; ///< of each node in slot_, and the end
  std::vector<std::uint32_t> slot_;  ///< slots by node, in the order of the tiles
};

}  // namespace kardan

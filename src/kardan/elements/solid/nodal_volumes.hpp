// Volume ratios of nodes for tetrahedra with nodal pressure (ELFORM 13); see tetrahedron.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/elements/tiles/tile_elements.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// A node's volume is a quarter of those of its elements, part by part: parts that share a node do not share their pressure. Deleted
/// elements do not count, neither now nor in the volume of t = 0.
class NodalVolumes {
 public:
  /// @param nodal by part of the model, 1 where the part's tetrahedra have nodal pressure
  void set_up(const TileElements& tetrahedra, const std::vector<std::uint8_t>& nodal, const std::vector<Vec3>& x0);
  /// Ratios at t_n into values[k] of the local node k of all tiles. Sums in the order of the tiles.
  void compute(const TileElements& tetrahedra, const State& state, std::vector<double>& values);

 private:
  struct Sum {
    double now = 0, start = 0;
  };
  void add_tile(const TileElements& tetrahedra, const State& state, const Tile& tile);

  std::vector<const Tile*> tiles_;        ///< of parts with nodal pressure
  std::vector<double> start_;             ///< volume at t = 0 by place [block][lane]
  std::vector<Sum> slots_;                ///< by local node of all tiles
  std::vector<std::uint32_t> first_;      ///< of each pair of part and node in slot_of_, and the end
  std::vector<std::uint32_t> slot_of_;    ///< slots by pair, ascending
};

}  // namespace kardan

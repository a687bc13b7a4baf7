#include "kardan/elements/solid/solid_shape.hpp"

#include <algorithm>

#include "kardan/elements/geometry.hpp"

namespace kardan {

std::optional<std::array<NodeIndex, 4>> tetrahedron_nodes(const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 4) return std::nullopt;
  std::array<NodeIndex, 4> corner{};
  std::size_t count = 0;
  for (const NodeIndex n : nodes) {
    const auto end = corner.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(corner.begin(), end, n) == end) corner[count++] = n;
  }
  return corner;
}

std::optional<std::array<NodeIndex, 6>> pentahedron_nodes(const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 6) return std::nullopt;
  // Node of the natural coordinates: bit 0 r, bit 1 s, bit 2 t.
  static constexpr std::array<std::size_t, 8> at{0, 1, 3, 2, 4, 5, 7, 6};
  const auto node = [&](int bits) { return nodes[at[static_cast<std::size_t>(bits)]]; };
  for (int collapsed = 0; collapsed < 3; ++collapsed) {    // direction of the edges without length
    const int a = 1 << collapsed;
    for (int turn = 1; turn <= 2; ++turn) {                // direction of the prism's axis
      const int axis = 1 << (collapsed + turn) % 3, side = 7 - a - axis;
      for (const int level : {0, side}) {                  // the side on which the edges lie
        if (node(level) != node(level | a) || node(level | axis) != node(level | a | axis)) continue;
        const int other = side - level;
        // A triangle looks along the axis as (collapsed direction, side) do; mirrored where they are not in cyclic order or the side
        // is reversed.
        const bool mirrored = (turn == 1) == (level == side);
        const std::array<int, 3> triangle = mirrored ? std::array{other, level, other | a} : std::array{other, other | a, level};
        return std::array<NodeIndex, 6>{node(triangle[0]),        node(triangle[1]),        node(triangle[2]),
                                        node(triangle[0] | axis), node(triangle[1] | axis), node(triangle[2] | axis)};
      }
    }
  }
  return std::nullopt;
}

}  // namespace kardan

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

SolidShape shape_of(const Model& model, std::size_t solid) {
  const auto& nodes = model.solids.nodes[solid];
  if (distinct_nodes(nodes) == 4) return SolidShape::tetrahedron;
  const Index section = model.parts[static_cast<std::size_t>(model.solids.part[solid])].section;
  const int elform = section == none ? solid_elform::one_point : model.sections[static_cast<std::size_t>(section)].solid.elform;
  const bool sorted = model.control.solid_esort == 1 || elform == solid_elform::pentahedra;
  if (sorted && pentahedron_nodes(nodes)) return SolidShape::pentahedron;
  return elform == solid_elform::quadratic ? SolidShape::quadratic : SolidShape::hexahedron;
}

double longest_edge_square(const ElementCoordinates<8>& x) {
  double longest = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (const Vec3& edge : {x[(a + 1) % 4] - x[a], x[4 + (a + 1) % 4] - x[4 + a], x[4 + a] - x[a]}) longest = std::max(longest, dot(edge, edge));
  }
  return longest;
}

double solid_inertia(const Model& model, std::size_t solid, double mass) {
  if (shape_of(model, solid) != SolidShape::quadratic) return 0;
  return mass * longest_edge_square(gather_coordinates(model.nodes.x, model.solids.nodes[solid])) / 8;
}

}  // namespace kardan

// Areas, volumes and faces of elements from their nodes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

template <std::size_t N>
using ElementCoordinates = std::array<Vec3, N>;

/// Coordinates of an element's nodes; `nodes` holds no `none`.
template <std::size_t N>
ElementCoordinates<N> gather_coordinates(const std::vector<Vec3>& x, const std::array<NodeIndex, N>& nodes) {
  ElementCoordinates<N> c;
  for (std::size_t a = 0; a < N; ++a) c[a] = x[static_cast<std::size_t>(nodes[a])];
  return c;
}

/// A triangle repeats its third node.
inline bool is_triangle(const std::array<NodeIndex, 4>& n) { return n[2] == n[3]; }

/// Area of a shell [length^2], half the product of the diagonals as in Belytschko, Lin and Tsay 1984, eq. (2); exact for
/// triangles and flat quadrilaterals.
inline double shell_area(const ElementCoordinates<4>& x) { return 0.5 * norm(cross(x[2] - x[0], x[3] - x[1])); }

/// Faces of a hexahedron by the places of their nodes, normals (right-hand rule) outwards, in the order t-, t+, s-, r+, s+, r- of the
/// natural coordinates.
inline constexpr std::array<std::array<std::size_t, 4>, 6> hexahedron_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Jacobian determinant of an eight-node hexahedron's trilinear map at natural coordinates r, s, t [length^3].
double hexahedron_jacobian(const ElementCoordinates<8>& x, const std::array<double, 3>& at);

/// Volume of an eight-node hexahedron with trilinear sides [length^3], negative if it is turned inside out: 2x2x2 Gauss
/// points are exact, the Jacobian determinant being of degree two in each natural coordinate.
double hexahedron_volume(const ElementCoordinates<8>& x);

/// Number of distinct nodes of a solid (8 hexahedron, 6 wedge, 5 pyramid, 4 tetrahedron).
int distinct_nodes(const std::array<NodeIndex, 8>& nodes);

/// Volume of a solid [length^3]. Wedges and pyramids are hexahedra with repeated nodes; of a tetrahedron (four distinct nodes,
/// usually N1 N2 N3 N4 N4 N4 N4 N4) the trilinear map would fill only half, so it is computed from its corners.
double solid_volume(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes);

/// Corners of a tetrahedron, its four distinct nodes in their order.
ElementCoordinates<4> tetrahedron_corners(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes);

}  // namespace kardan

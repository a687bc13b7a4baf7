// Sizes of elements from their nodes' coordinates: what lumped masses and time steps are made of.
#pragma once

#include <algorithm>
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

/// Axes of a shell as Belytschko, Lin and Tsay 1984 and LS-DYNA lay them: z normal to both diagonals, x along side 1-2 made normal to it. Columns:
/// x, y, z in global components.
Mat3 shell_frame(const ElementCoordinates<4>& x);

/// Characteristic length of a shell for ISDO of *CONTROL_TIMESTEP [length]:
/// 0: (1 + b) A / max(L1, L2, L3, (1 - b) L4) with b = 0 for quadrilaterals and 1 for triangles;
/// 1: (1 + b) A / max(D1, D2) with the diagonals D (the two sides at node 3 of a triangle).
/// Source: Hallquist, LS-DYNA Theory Manual 2006, "Time step calculations for shell elements".
inline double shell_length(const ElementCoordinates<4>& x, bool triangle, int isdo) {
  const double b = triangle ? 1.0 : 0.0;
  // The repeated third node makes L3 of a triangle vanish and L4 its third side: all four sides serve both shapes.
  const double longest = isdo == 1 ? std::max(norm(x[2] - x[0]), norm(x[3] - x[1]))
                                   : std::max({norm(x[1] - x[0]), norm(x[2] - x[1]), norm(x[3] - x[2]), norm(x[0] - x[3])});
  return (1.0 + b) * shell_area(x) / longest;
}

/// Volume of an eight-node hexahedron with trilinear sides [length^3], negative if it is turned inside out: 2x2x2 Gauss
/// points are exact, the Jacobian determinant being of degree two in each natural coordinate.
double hexahedron_volume(const ElementCoordinates<8>& x);

/// Number of distinct nodes of a solid (8 hexahedron, 6 wedge, 5 pyramid, 4 tetrahedron).
int distinct_nodes(const std::array<NodeIndex, 8>& nodes);

/// Volume of a solid [length^3]. Wedges and pyramids are hexahedra with repeated nodes; of a tetrahedron (four distinct nodes,
/// usually N1 N2 N3 N4 N4 N4 N4 N4) the trilinear map would fill only half, so it is computed from its corners.
double solid_volume(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes);

/// Characteristic length of a solid [length]: volume / largest face; for a tetrahedron (four distinct nodes) its smallest
/// altitude, 3 V / largest face. Source: Hallquist, LS-DYNA Theory Manual 2006, "Time step calculations for solid elements".
double solid_length(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes);

}  // namespace kardan

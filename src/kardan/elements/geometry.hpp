// Sizes of elements from their nodes' coordinates: what lumped masses and time steps are made of, beside areas and volumes
// (model/element_shape.hpp).
#pragma once

#include <algorithm>
#include <array>

#include "kardan/base/vec3.hpp"
#include "kardan/model/element_shape.hpp"

namespace kardan {

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

/// Characteristic length of a solid [length]: volume / largest face; for a tetrahedron (four distinct nodes) its smallest
/// altitude, 3 V / largest face. Source: Hallquist, LS-DYNA Theory Manual 2006, "Time step calculations for solid elements".
double solid_length(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes);

}  // namespace kardan

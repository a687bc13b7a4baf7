#include "kardan/elements/geometry.hpp"

#include <cmath>

namespace kardan {

Mat3 shell_frame(const ElementCoordinates<4>& x) {
  const Vec3 e3 = normalized(cross(x[2] - x[0], x[3] - x[1])), side = x[1] - x[0];
  const Vec3 e1 = normalized(side - e3 * dot(side, e3));
  return Mat3::columns(e1, cross(e3, e1), e3);
}

double solid_length(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
  const double volume = std::abs(solid_volume(x, nodes));
  double largest = 0;
  if (distinct_nodes(nodes) == 4) {
    const ElementCoordinates<4> t = tetrahedron_corners(x, nodes);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& a = t[(i + 1) % 4];
      largest = std::max(largest, 0.5 * norm(cross(t[(i + 2) % 4] - a, t[(i + 3) % 4] - a)));
    }
    return 3.0 * volume / largest;
  }
  for (const auto& f : hexahedron_faces) {
    largest = std::max(largest, 0.5 * norm(cross(x[f[2]] - x[f[0]], x[f[3]] - x[f[1]])));
  }
  return volume / largest;
}

}  // namespace kardan

#include "kardan/model/element_shape.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr std::array<std::array<double, 3>, 8> natural{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                        {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

}  // namespace

double hexahedron_jacobian(const ElementCoordinates<8>& x, const std::array<double, 3>& at) {
  const auto [r, s, t] = at;
  Mat3 jacobian;  // row i: derivatives of x with respect to natural coordinate i
  for (std::size_t a = 0; a < 8; ++a) {
    const auto& n = natural[a];
    jacobian[0] += x[a] * (0.125 * n[0] * (1 + s * n[1]) * (1 + t * n[2]));
    jacobian[1] += x[a] * (0.125 * n[1] * (1 + r * n[0]) * (1 + t * n[2]));
    jacobian[2] += x[a] * (0.125 * n[2] * (1 + r * n[0]) * (1 + s * n[1]));
  }
  return determinant(jacobian);
}

double hexahedron_volume(const ElementCoordinates<8>& x) {
  const double g = 1.0 / std::sqrt(3.0);
  double volume = 0;
  for (const auto& point : natural) volume += hexahedron_jacobian(x, {g * point[0], g * point[1], g * point[2]});
  return volume;
}

int distinct_nodes(const std::array<NodeIndex, 8>& nodes) {
  int count = 0;
  for (std::size_t a = 0; a < 8; ++a) {
    bool seen = false;
    for (std::size_t b = 0; b < a; ++b) seen = seen || nodes[b] == nodes[a];
    if (!seen) ++count;
  }
  return count;
}

ElementCoordinates<4> tetrahedron_corners(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
  ElementCoordinates<4> corner;
  std::size_t count = 0;
  for (std::size_t a = 0; a < 8 && count < 4; ++a) {
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(a), nodes[a]) ==
        nodes.begin() + static_cast<std::ptrdiff_t>(a)) {
      corner[count++] = x[a];
    }
  }
  return corner;
}

double solid_volume(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 4) return hexahedron_volume(x);
  const ElementCoordinates<4> t = tetrahedron_corners(x, nodes);
  return dot(cross(t[1] - t[0], t[2] - t[0]), t[3] - t[0]) / 6.0;
}

}  // namespace kardan

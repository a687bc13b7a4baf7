#include "kardan/elements/geometry.hpp"

#include <cmath>

namespace kardan {

namespace {

constexpr std::array<std::array<double, 3>, 8> natural{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                        {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

constexpr std::array<std::array<std::size_t, 4>, 6> faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

}  // namespace

Mat3 shell_frame(const ElementCoordinates<4>& x) {
  const Vec3 e3 = normalized(cross(x[2] - x[0], x[3] - x[1])), side = x[1] - x[0];
  const Vec3 e1 = normalized(side - e3 * dot(side, e3));
  return Mat3::columns(e1, cross(e3, e1), e3);
}

double hexahedron_volume(const ElementCoordinates<8>& x) {
  const double g = 1.0 / std::sqrt(3.0);
  double volume = 0;
  for (const auto& point : natural) {
    const double r = g * point[0], s = g * point[1], t = g * point[2];
    Mat3 jacobian;  // row i: derivatives of x with respect to natural coordinate i
    for (std::size_t a = 0; a < 8; ++a) {
      const auto& n = natural[a];
      jacobian[0] += x[a] * (0.125 * n[0] * (1 + s * n[1]) * (1 + t * n[2]));
      jacobian[1] += x[a] * (0.125 * n[1] * (1 + r * n[0]) * (1 + t * n[2]));
      jacobian[2] += x[a] * (0.125 * n[2] * (1 + r * n[0]) * (1 + s * n[1]));
    }
    volume += determinant(jacobian);
  }
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

namespace {

/// Corners of a tetrahedron among the eight nodes.
ElementCoordinates<4> tetrahedron(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
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

}  // namespace

double solid_volume(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 4) return hexahedron_volume(x);
  const ElementCoordinates<4> t = tetrahedron(x, nodes);
  return dot(cross(t[1] - t[0], t[2] - t[0]), t[3] - t[0]) / 6.0;
}

double solid_length(const ElementCoordinates<8>& x, const std::array<NodeIndex, 8>& nodes) {
  const double volume = std::abs(solid_volume(x, nodes));
  double largest = 0;
  if (distinct_nodes(nodes) == 4) {
    const ElementCoordinates<4> t = tetrahedron(x, nodes);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& a = t[(i + 1) % 4];
      largest = std::max(largest, 0.5 * norm(cross(t[(i + 2) % 4] - a, t[(i + 3) % 4] - a)));
    }
    return 3.0 * volume / largest;
  }
  for (const auto& f : faces) {
    largest = std::max(largest, 0.5 * norm(cross(x[f[2]] - x[f[0]], x[f[3]] - x[f[1]])));
  }
  return volume / largest;
}

}  // namespace kardan

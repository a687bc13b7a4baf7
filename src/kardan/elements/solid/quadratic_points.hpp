// The fourteen integration points of the quadratic hexahedron.
//
// Irons 1971, Int. J. Numer. Meth. Eng. 3, 293-294, exact to the fifth degree on [-1, 1]^3: six points at distance b from the centre on
// the axes, b^2 = 19/30, weight 320/361; eight on the diagonals, (+-c, +-c, +-c), c^2 = 19/33, weight 121/361.
#pragma once

#include <array>
#include <cstddef>

namespace kardan {

inline constexpr std::size_t quadratic_point_count = 14;

/// Natural coordinates and weight of a point.
struct QuadraticPoint {
  double r, s, t, weight;
};

inline constexpr std::array<QuadraticPoint, quadratic_point_count> quadratic_points = [] {
  constexpr double b = 0.79582242575422146327, c = 0.75878691063932814627, axis = 320.0 / 361.0, diagonal = 121.0 / 361.0;
  std::array<QuadraticPoint, quadratic_point_count> points{{{-b, 0, 0, axis}, {b, 0, 0, axis}, {0, -b, 0, axis}, {0, b, 0, axis},
                                                            {0, 0, -b, axis}, {0, 0, b, axis}}};
  for (std::size_t i = 0; i < 8; ++i) points[6 + i] = {i & 1 ? c : -c, i & 2 ? c : -c, i & 4 ? c : -c, diagonal};
  return points;
}();

}  // namespace kardan

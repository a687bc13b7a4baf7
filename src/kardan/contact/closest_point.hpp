// The point of a segment that is closest to a given point.
//
// A quadrilateral is four triangles around the mean m of its corners: continuous over warped segments and their borders, without
// iteration. Closest point of a triangle: Ericson, Real-Time Collision Detection 2005, section 5.1.5 (Voronoi regions of its corners, sides and
// its inside by barycentric coordinates).
#pragma once

#include <array>
#include <cstdint>

#include "kardan/base/vec3.hpp"

namespace kardan {

/// Where on a segment a point lies. Bits of the corners that span the feature: one bit a corner, two a side, all of them the inside.
using Feature = std::uint8_t;

struct ClosestPoint {
  Vec3 u;                          ///< from the closest point to the given point
  double square = 0;               ///< |u|^2
  std::array<double, 4> weights{}; ///< of the corners, sum 1: closest point = sum w_i x_i
  Vec3 normal;                     ///< unit normal of the plane triangle it lies in (of one of them on a side)
  Feature feature = 0;             ///< of the segment: corner, side, or inside (15; 7 for triangles)
};

namespace closest {

/// Of a triangle a, b, c seen from p: barycentric coordinates and bits of those that are not zero.
struct OnTriangle {
  Vec3 u;
  double square = 0, wa = 0, wb = 0, wc = 0;
};

inline OnTriangle on_side(const Vec3& u, double wa, double wb, double wc) { return {u, dot(u, u), wa, wb, wc}; }

inline OnTriangle triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return on_side(ap, 1, 0, 0);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return on_side(bp, 0, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 - d3 > 0 ? d1 / (d1 - d3) : 0.0;
    return on_side(ap - ab * v, 1 - v, v, 0);
  }
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return on_side(cp, 0, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 - d6 > 0 ? d2 / (d2 - d6) : 0.0;
    return on_side(ap - ac * w, 1 - w, 0, w);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double way = (d4 - d3) + (d5 - d6), w = way > 0 ? (d4 - d3) / way : 0.0;
    return on_side(bp - (c - b) * w, 0, 1 - w, w);
  }
  const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
  return on_side(ap - ab * v - ac * w, 1 - v - w, v, w);
}

}  // namespace closest

/// `x` holds the corners; a triangle repeats its third. A segment without area has closest points, too, with the normal zero.
inline ClosestPoint closest_point(const Vec3& p, const std::array<Vec3, 4>& x, bool is_triangle) {
  ClosestPoint best;
  if (is_triangle) {
    const closest::OnTriangle t = closest::triangle(p, x[0], x[1], x[2]);
    best.u = t.u;
    best.square = t.square;
    best.weights = {t.wa, t.wb, t.wc, 0};
    best.normal = cross(x[1] - x[0], x[2] - x[0]);
    best.feature = static_cast<Feature>((t.wa != 0 ? 1 : 0) | (t.wb != 0 ? 2 : 0) | (t.wc != 0 ? 4 : 0));
  } else {
    const Vec3 m = (x[0] + x[1] + x[2] + x[3]) * 0.25;
    std::size_t at = 0;
    closest::OnTriangle nearest = closest::triangle(p, m, x[0], x[1]);
    for (std::size_t i = 1; i < 4; ++i) {
      const closest::OnTriangle t = closest::triangle(p, m, x[i], x[(i + 1) & 3]);
      if (t.square < nearest.square) nearest = t, at = i;
    }
    const std::size_t next = (at + 1) & 3;
    best.u = nearest.u;
    best.square = nearest.square;
    best.weights.fill(0.25 * nearest.wa);
    best.weights[at] += nearest.wb;
    best.weights[next] += nearest.wc;
    best.normal = cross(x[at] - m, x[next] - m);
    best.feature = nearest.wa != 0 ? Feature{15}
                                   : static_cast<Feature>((nearest.wb != 0 ? 1u << at : 0u) | (nearest.wc != 0 ? 1u << next : 0u));
  }
  const double length = norm(best.normal);
  best.normal = length > 0 ? best.normal * (1 / length) : Vec3{};
  return best;
}

}  // namespace kardan

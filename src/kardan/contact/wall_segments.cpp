#include "kardan/contact/wall_segments.hpp"

namespace kardan {

namespace {

/// r is in the triangle a, b, c or on its border: on one side of all three edges.
bool in_triangle(const Vec3& r, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double s = dot(cross(b - a, r - a), normal), t = dot(cross(c - b, r - b), normal), u = dot(cross(a - c, r - c), normal);
  const bool flat = dot(cross(b - a, c - a), normal) == 0;
  return !flat && ((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0));
}

}  // namespace

WallSegments::WallSegments(const Model& model, const RigidWall& wall) : normal_(wall.normal) {
  for (const auto& segment : wall.segments) {
    std::array<Vec3, 4>& corners = corners_.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) corners[k] = model.nodes.x[segment[k]];
  }
}

Index WallSegments::find(const Vec3& r) const {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto& [a, b, c, d] = corners_[i];
    if (in_triangle(r, a, b, c, normal_) || in_triangle(r, a, c, d, normal_)) return static_cast<Index>(i);
  }
  return none;
}

}  // namespace kardan

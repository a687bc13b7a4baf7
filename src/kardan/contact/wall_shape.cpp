#include "kardan/contact/wall_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kardan {

namespace {

/// When the way from q to q + d comes down to the distance `radius` from the origin, as a fraction of it; |q| >= radius, |q + d| < radius.
double time_of_entry(const Vec3& q, const Vec3& d, double radius) {
  const double a = dot(d, d), b = dot(q, d), c = dot(q, q) - radius * radius;
  return (-b - std::sqrt(std::max(b * b - a * c, 0.0))) / a;
}

}  // namespace

WallShape::WallShape(const RigidWall& wall) : point_(wall.point), normal_(wall.normal), radius_(wall.radius), interior_(wall.interior) {
  const auto add_edges = [&] {
    for (const auto& [edge, length] : {std::pair{wall.edge_l, wall.length_l}, std::pair{wall.edge_m, wall.length_m}}) {
      if (!(length > 0)) continue;
      add_side(-edge, 0);
      add_side(edge, length);
    }
  };
  using Shape = RigidWall::Shape;
  sphere_ = wall.shape == Shape::sphere;
  round_ = sphere_ || wall.shape == Shape::cylinder;
  if (!sphere_ && (!round_ || wall.length_p > 0)) add_side(normal_, 0);
  if ((wall.shape == Shape::prism || wall.shape == Shape::cylinder) && wall.length_p > 0) add_side(-normal_, wall.length_p);
  first_edge_ = interior_ ? 0 : side_count_;
  if (!round_) add_edges();
  has_edges_ = (wall.shape == Shape::plane || interior_) && side_count_ > first_edge_;
}

double WallShape::outside_of_edges(const Vec3& r) const {
  const Vec3 q = r - point_;
  double outside = -std::numeric_limits<double>::infinity();
  for (std::size_t k = first_edge_; k < side_count_; ++k) outside = std::max(outside, sides_[k].distance(q));
  return outside;
}

double WallShape::clearance(const Vec3& r) const {
  const double depth = this->depth(r).depth;
  return has_edges_ ? std::max(std::abs(depth), outside_of_edges(r)) : std::max(-depth, 0.0);
}

WallShape::Depth WallShape::depth(const Vec3& r) const {
  const Vec3 q = r - point_;
  Depth result{std::numeric_limits<double>::infinity(), normal_};
  if (round_) {
    const Vec3 across = across_axis(q);
    const double distance = norm(across), sign = interior_ ? -1.0 : 1.0;
    result.depth = sign * (radius_ - distance);
    if (distance > 0) result.normal = across * (sign / distance);
  }
  // The edges of a surface are no sides of a solid.
  const std::size_t count = has_edges_ ? first_edge_ : side_count_;
  for (std::size_t k = 0; k < count; ++k)
    if (const double depth = -sides_[k].distance(q); depth < result.depth) result = {depth, sides_[k].normal};
  return result;
}

WallShape::Resistance WallShape::resist(const Vec3& r, const Vec3& u, double dt) const {
  const Vec3 q = r - point_;
  if (interior_) return resist_bore(q, u, dt);
  if (has_edges_ || side_count_ == 1) return resist_surface(q, u, dt);
  return side_count_ == 0 ? resist_round(across_axis(q), across_axis(u), dt) : resist_solid(q, u, dt);
}

WallShape::Resistance WallShape::resist_surface(const Vec3& q, const Vec3& u, double dt) const {
  const double gap = sides_[0].distance(q), rate = dot(u, normal_), change = -std::max(gap, 0.0) / dt - rate;
  if (!(change > 0) || !has_edges_) return {normal_, change, false};
  const Vec3 crossing = gap > 0 ? q + u * (gap / -rate) : q;
  for (std::size_t k = first_edge_; k < side_count_; ++k)
    if (sides_[k].distance(crossing) > 0) return {normal_, 0, true};
  return {normal_, change, false};
}

WallShape::Resistance WallShape::resist_round(const Vec3& q, const Vec3& u, double dt) const {
  const Vec3 end = q + u * dt;
  const double distance = norm(end);
  if (distance >= radius_) return {};
  const double before = norm(q), lacking = std::min(radius_, before) - distance;
  if (distance > 1e-6 * radius_) return {end / distance, lacking / dt, false};
  return before > 0 ? Resistance{q / before, lacking / dt, false} : Resistance{};
}

WallShape::Resistance WallShape::resist_solid(const Vec3& q, const Vec3& u, double dt) const {
  const Vec3 across = across_axis(q), move = across_axis(u) * dt;
  if (round_ && norm(across + move) >= radius_) return {};
  double latest = -1, nearest = -std::numeric_limits<double>::infinity();
  std::size_t entered = side_count_, next = side_count_;  // side_count_ stands for the round side
  if (round_) {
    nearest = norm(across) - radius_;
    if (nearest >= 0) latest = time_of_entry(across, move, radius_);
  }
  for (std::size_t k = 0; k < side_count_; ++k) {
    const double gap = sides_[k].distance(q), end = gap + dt * dot(u, sides_[k].normal);
    if (end >= 0) return {};
    if (gap >= 0 && gap / (gap - end) > latest) {
      latest = gap / (gap - end);
      entered = k;
    }
    if (gap > nearest) {
      nearest = gap;
      next = k;
    }
  }
  const std::size_t side = latest >= 0 ? entered : next;
  if (side == side_count_) return resist_round(across, across_axis(u), dt);
  const Side& s = sides_[side];
  return {s.normal, -std::max(s.distance(q), 0.0) / dt - dot(u, s.normal), false};
}

WallShape::Resistance WallShape::resist_bore(const Vec3& q, const Vec3& u, double dt) const {
  const Vec3 across = across_axis(q), end = across + across_axis(u) * dt;
  const double before = norm(across), after = norm(end);
  if (after <= radius_) return {};
  const Resistance held{end / -after, (after - std::max(before, radius_)) / dt, false};
  if (!has_edges_) return held;
  // Between two points of the way the distance from the axis is convex: the chord crosses the radius a little early, at most.
  const Vec3 crossing = before < radius_ ? q + u * (dt * (radius_ - before) / (after - before)) : q;
  return beyond_edges(crossing + point_) ? Resistance{held.normal, 0, true} : held;
}

}  // namespace kardan

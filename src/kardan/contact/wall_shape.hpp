// Geometry of rigid walls: where a node that moves for one step meets a wall.
//
// r is a position and u a velocity, both relative to the wall; the node goes from r to r* = r + dt u. A wall is a solid, or one side of a
// surface. A node whose r* is inside is brought back onto the surface by a change of its velocity along one normal N,
//   u <- u + c N,   c = (a - g(r*))/dt > 0,
// with g the distance along N outwards and a the distance that it may have at t_{n+1}: 0, or, for a node that was inside already, its own
// g(r) < 0: such a node is held at its depth, not thrown out. Which N and g:
//   plane, face of a prism, end of a cylinder: the outward normal; g is linear, so c = -max(g(r), 0)/dt - u.N without rounding of positions.
//   sphere, cylinder: N is the direction from the centre (the axis) to r*, g = |r*| - R. That is the nearest point of the surface, hence the
//     smallest impulse that brings the node there (Gauss' principle), and where the surface is convex friction, which then acts across N,
//     cannot bring the node inside again.
//   bore (the inside of a cylinder): likewise with the opposite N; what friction moves along the concave surface is projected again.
// Prisms and cylinders with ends: the node entered through the side that its way r -> r* crosses last, because a point is inside from the
// moment on at which it is inside of all sides. If it began inside, that is the side next to r.
// Planes with edges and bores with ends are surfaces that a node can go round: it is stopped only where its way crosses the surface within
// the edges.
#pragma once

#include <array>
#include <cstddef>

#include "kardan/model/rigid_wall.hpp"

namespace kardan {

class WallShape {
 public:
  explicit WallShape(const RigidWall& wall);

  /// How a wall resists a node in this step.
  struct Resistance {
    Vec3 normal;        ///< unit, out of the wall
    double change = 0;  ///< velocity along the normal that keeps the node out; <= 0: it stays out by itself
    bool passes = false;  ///< of surfaces with edges: the node goes round, and is free while it is behind
  };
  /// For a node in front of the surface, or held by it; dt > 0.
  Resistance resist(const Vec3& r, const Vec3& u, double dt) const;

  struct Depth {
    double depth;  ///< how far inside (behind) r is; negative outside
    Vec3 normal;   ///< of the nearest side
  };
  Depth depth(const Vec3& r) const;

  /// A lower bound of the distance from r to the wall. Of surfaces with edges from both sides, of others 0 inside.
  double clearance(const Vec3& r) const;
  /// Nodes can go round the edges of the surface.
  bool has_edges() const { return has_edges_; }
  /// Whether r, seen along the normal, lies outside of the edges.
  bool beyond_edges(const Vec3& r) const { return outside_of_edges(r) > 0; }
  /// Whether friction along the surface can lead inside.
  bool concave() const { return interior_; }

 private:
  /// A half space normal.(r - point) < offset.
  struct Side {
    Vec3 normal;
    double offset;
    double distance(const Vec3& q) const { return dot(normal, q) - offset; }
  };
  void add_side(const Vec3& normal, double offset) { sides_[side_count_++] = {normal, offset}; }
  double outside_of_edges(const Vec3& r) const;
  Vec3 across_axis(const Vec3& q) const { return round_ && !sphere_ ? q - normal_ * dot(q, normal_) : q; }
  Resistance resist_surface(const Vec3& q, const Vec3& u, double dt) const;
  Resistance resist_solid(const Vec3& q, const Vec3& u, double dt) const;
  Resistance resist_bore(const Vec3& q, const Vec3& u, double dt) const;
  Resistance resist_round(const Vec3& q, const Vec3& u, double dt) const;

  Vec3 point_, normal_;
  double radius_ = 0;
  bool round_ = false, sphere_ = false, interior_ = false, has_edges_ = false;
  /// Of a plane: itself first, then its edges (which bound the surface, not a solid); of solids all flat sides; of a bore its ends.
  std::array<Side, 6> sides_;
  std::size_t side_count_ = 0, first_edge_ = 0;
};

}  // namespace kardan

// Where a node touches a surface.
//
// A node touches a surface at every local minimum of its distance: once on a flat place, twice in a concave edge or between two sheets. The closest point of
// a segment that lies on one of its sides or corners is such a minimum only if no other segment at that side or corner is closer; segments that meet
// in the closest point are one touch. Minima whose directions differ little (a slightly concave border of two segments) share one force:
// from 60 to 40 degrees the shallower one fades out, so that the force is continuous.
//
// With u = x_s - x_c, d = |u| and t = half thicknesses of node and segment together, the penetration is
//   t - d, along u     two-sided, from the side the node came from; one-sided, outside
//   t + d, along -u    two-sided, beyond the mid-surface; one-sided, inside
// Which side a node came from, it remembers as the direction of the last cycle: of the same segment, of those that share the closest point, or of a
// neighbour that it has just left; across a steep border that two segments share, the side of one is continued by that of the other. So no node passes a shared border, a corner or a junction; a free edge lets it go.
//
// A node is taken to be inside a one-sided surface only if its last motion can have taken it there, or if it was in touch there or next to it; of a
// connected surface the nearest place counts. What a new touch penetrates beyond what the motion explains becomes its offset, which gives no force and
// can only shrink, unless the geometry jumps: no touch makes energy out of nothing.
//
// Solids face one another where they touch. A face that a node is behind, and that none of the node's own faces looks at while one looks the same way, is no
// way in: the node came past its border. Where two bodies are flush (meshes one element thick, all of their nodes in two planes), the nearest place of every
// node would else be such a face, at no depth, and nothing would stop the bodies in their common plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kardan/contact/closest_point.hpp"
#include "kardan/contact/surface.hpp"
#include "kardan/contact/touch.hpp"

namespace kardan {

/// The motion of a cycle that the finder looks at.
struct TouchFrame {
  const std::vector<Vec3>* x = nullptr;   ///< at t_n, by node of the model
  const std::vector<Vec3>* v = nullptr;   ///< at t_{n-1/2}
  double dt = 0;                          ///< t_n - t_{n-1}
  double travel = 0;                      ///< sum over the cycles since the candidates were listed of the largest way a node has moved (motion_meter.hpp)
  double last_travel = 0;                 ///< of the last step
  double margin = 0;                      ///< every segment nearer than the thicknesses and this is looked at
  bool birth = false;                     ///< the contact's first cycle: what is inside is an initial penetration
};

class TouchFinder {
 public:
  TouchFinder(const Surface& nodes, const Surface& segments);

  /// Touches of the node at `place` with the segments `near`, ascending by segment. Segments are looked at that are awake (wake <= travel); others get the
  /// travel before which they cannot be touched.
  /// @param memory  the node's touches of the last cycle
  /// @param out     gets the touches, without forces yet
  void find(const TouchFrame& frame, Index place, std::span<const Index> near, std::span<float> wake, std::span<const Touch> memory,
            std::vector<Touch>& out);

 private:
  enum class Standing : std::uint8_t { minimum, twin, rejected };
  struct Place {
    Index segment = none;
    ClosestPoint closest;
    double distance = 0, side = 0;  ///< d; u . normal
    double thickness = 0;           ///< t
    Standing standing = Standing::minimum;
    std::size_t twin = 0;           ///< the one it shares the closest point with
    const Touch* memory = nullptr;
    int expected = 0;               ///< side (sign of u . normal) on which the node was of a neighbour; 0 = not known
    bool inside = false;            ///< of a one-sided surface
    bool touches = false;
    Vec3 direction;
    double penetration = 0, offset = 0, share = 1;
  };

  bool look(const TouchFrame& frame, const Vec3& x, double half_thickness, Index segment, float& wake, std::span<const Touch> memory,
            Place& place) const;
  bool came_through(const Vec3& u, const Segment& segment, std::span<const Touch> memory) const;
  bool averted(const TouchFrame& frame, Index node, const Place& place);
  void find_own_normals(const TouchFrame& frame, Index node);
  void find_minima();
  void recall(const TouchFrame& frame, std::span<const Touch> memory);
  int side_across(const TouchFrame& frame, const Touch& from, const Segment& to) const;
  void decide(const TouchFrame& frame, NodeIndex node, Place& p) const;
  void decide_two_sided(const TouchFrame& frame, NodeIndex node, Place& p) const;
  void decide_one_sided(const TouchFrame& frame, NodeIndex node, Place& p) const;
  void keep_nearest_inside();
  void share_forces();
  Vec3 velocity(const TouchFrame& frame, NodeIndex node, const Place& p) const;
  const Segment& segment(const Place& p) const { return segments_->segments()[p.segment]; }
  void collect(Index place, std::vector<Touch>& out) const;

  const Surface* nodes_;
  const Surface* segments_;
  bool one_sided_ = false;  ///< some segments are
  std::vector<Place> places_;
  std::vector<std::size_t> order_;
  Index own_of_ = none;     ///< place of the node whose faces' normals are in own_
  std::vector<Vec3> own_;   ///< outward unit normals; empty if the node is not of solids alone
};

}  // namespace kardan

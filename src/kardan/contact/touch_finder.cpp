#include "kardan/contact/touch_finder.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr double same = 1e-9;            ///< distances closer than this part of the segment's size are one closest point
constexpr double apart = 0.5, together = 0.766;  ///< cosines: two touches of full force, one touch
constexpr double rounded_down = 1 - 1e-6;  ///< of travels, which are kept in single precision
constexpr double explained_steps = 1.5;  ///< steps of the last relative motion that explain a new penetration
constexpr double flush = 1e-3;           ///< part of a face's size by which a node of its plane may be in front of it: rounding, and sides that bulge
constexpr double facing = -0.2, alike = 0.7;  ///< cosines of normals: faces that look at one another, faces that look the same way

bool has(const Segment& s, NodeIndex n) { return s.nodes[0] == n || s.nodes[1] == n || s.nodes[2] == n || s.nodes[3] == n; }

bool is_inside(Feature f, const Segment& s) { return f == (corners(s) == 3 ? 7 : 15); }

/// `other` has all nodes of the feature.
bool shares(const Segment& s, Feature feature, const Segment& other) {
  for (std::size_t k = 0; k < 4; ++k)
    if ((feature >> k & 1) && !has(other, s.nodes[k])) return false;
  return true;
}

/// 1 up to `apart`, 0 from `together` on, smooth between.
double fade(double cosine) {
  const double s = std::clamp((cosine - apart) / (together - apart), 0.0, 1.0);
  return 1 - s * s * (3 - 2 * s);
}

}  // namespace

Vec3 TouchFinder::velocity(const TouchFrame& frame, NodeIndex node, const Place& p) const {
  const std::vector<Vec3>& v = *frame.v;
  Vec3 relative = v[node];
  for (std::size_t k = 0; k < 4; ++k) relative -= v[segment(p).nodes[k]] * p.closest.weights[k];
  return relative;
}

TouchFinder::TouchFinder(const Surface& nodes, const Surface& segments)
    : nodes_(&nodes),
      segments_(&segments),
      one_sided_(std::any_of(segments.segments().begin(), segments.segments().end(), [](const Segment& s) { return s.one_sided; })) {}

/// The node came from the other side of a segment that it touched, or of a neighbour of one.
bool TouchFinder::came_through(const Vec3& u, const Segment& s, std::span<const Touch> memory) const {
  return std::any_of(memory.begin(), memory.end(), [&](const Touch& m) {
    return dot(u, m.direction) < 0 && adjacent(segments_->segments()[m.segment], s);
  });
}

/// @return whether the place may be a touch; if not, `wake` says until when.
bool TouchFinder::look(const TouchFrame& frame, const Vec3& x, double half_thickness, Index segment, float& wake,
                       std::span<const Touch> memory, Place& p) const {
  const Segment& s = segments_->segments()[segment];
  std::array<Vec3, 4> corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = (*frame.x)[s.nodes[k]];
  p.closest = closest_point(x, corner, corners(s) == 3);
  p.distance = std::sqrt(p.closest.square);
  p.side = dot(p.closest.u, p.closest.normal);
  p.thickness = s.half_thickness + half_thickness;
  const double reach = 2 * frame.last_travel, gap = p.distance - p.thickness;
  // Where a node may be deep inside a one-sided surface, places outside are needed, too, to tell minima from others.
  const bool all = s.one_sided && (frame.birth || !memory.empty());
  const bool outside = !s.one_sided || p.side >= 0;
  if (!all && (outside ? gap > reach : p.distance > reach + same * std::sqrt(s.area)) &&
      (memory.empty() || !came_through(p.closest.u, s, memory))) {
    wake = static_cast<float>((frame.travel + (outside ? 0.5 * gap : 0.25 * p.distance)) * rounded_down);
    return false;
  }
  p.segment = segment;
  p.standing = Standing::minimum;
  p.memory = nullptr;
  p.expected = 0;
  p.inside = p.touches = false;
  p.share = 1;
  p.offset = 0;
  return true;
}

void TouchFinder::find_own_normals(const TouchFrame& frame, Index node) {
  own_of_ = node;
  own_.clear();
  const std::vector<Vec3>& x = *frame.x;
  for (const Index i : nodes_->segments_at(node)) {
    const Segment& s = nodes_->segments()[i];
    if (s.kind != ElementKind::solid || !s.one_sided) return own_.clear();
    const auto& n = s.nodes;  // half the product of the diagonals, for triangles, too
    const Vec3 area = cross(x[n[2]] - x[n[0]], x[n[3]] - x[n[1]]);
    const double length = norm(area);
    own_.push_back(length > 0 ? area * (1 / length) : Vec3{});
  }
}

/// The node (its place in the surface) is behind a face that it cannot have come through: see the head of touch_finder.hpp.
bool TouchFinder::averted(const TouchFrame& frame, Index node, const Place& p) {
  const Segment& s = segment(p);
  if (s.kind != ElementKind::solid || !s.one_sided || p.side > flush * std::sqrt(s.area)) return false;
  if (own_of_ != node) find_own_normals(frame, node);
  double least = 1, most = -1;
  for (const Vec3& n : own_) {
    const double cosine = dot(n, p.closest.normal);
    least = std::min(least, cosine);
    most = std::max(most, cosine);
  }
  return !own_.empty() && least > facing && most > alike;
}

void TouchFinder::find_minima() {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Place& p = places_[i];
    const Segment& s = segment(p);
    if (is_inside(p.closest.feature, s)) continue;
    std::size_t best = i;
    for (std::size_t j = 0; j < places_.size() && p.standing != Standing::rejected; ++j) {
      const Place& q = places_[j];
      if (j == i || !shares(s, p.closest.feature, segment(q))) continue;
      const double tolerance = same * (p.distance + std::sqrt(s.area));
      if (q.distance < p.distance - tolerance) p.standing = Standing::rejected;
      else if (q.distance <= p.distance + tolerance) {
        // One closest point. It belongs to the segment that has it inside; else, of one-sided segments, to the one that sees the node most
        // squarely, which says on which side it is; else to the first.
        const Place& b = places_[best];
        const bool q_inside = is_inside(q.closest.feature, segment(q)), b_inside = is_inside(b.closest.feature, segment(b));
        const double gain = s.one_sided ? std::abs(q.side) - std::abs(b.side) : 0.0;
        if (q_inside != b_inside ? q_inside : gain > tolerance || (gain >= -tolerance && j < best)) best = j;
      }
    }
    if (p.standing == Standing::rejected || best == i) continue;
    p.standing = Standing::twin;
    p.twin = best;
  }
  for (Place& p : places_) {  // chains of twins end at one that stands for itself
    if (p.standing != Standing::twin) continue;
    for (std::size_t steps = places_.size(); places_[p.twin].standing == Standing::twin && steps > 0; --steps) {
      if (places_[p.twin].twin == p.twin || &places_[places_[p.twin].twin] == &p) break;
      p.twin = places_[p.twin].twin;
    }
  }
}

/// On which side of segment `to` a node is that was on a side of its neighbour: the neighbours' normals agree if they go along the shared side in
/// opposite senses. 0 if they share no side, if the memory lies in the neighbour's plane, or if the node was over its border: a node that meets the
/// edge of two walls from outside is on no particular side of either.
int TouchFinder::side_across(const TouchFrame& frame, const Touch& memory, const Segment& to) const {
  const Segment& from = segments_->segments()[memory.segment];
  for (std::size_t k = 0; k < corners(from); ++k)
    if (memory.weights[k] == 0) return 0;
  const std::vector<Vec3>& x = *frame.x;
  const auto& n = from.nodes;
  const Vec3 normal = cross(x[n[2]] - x[n[0]], x[n[3]] - x[n[1]]);
  const double along = dot(memory.direction, normal);
  if (std::abs(along) < 0.1 * norm(normal)) return 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const NodeIndex a = n[i], b = n[(i + 1) & 3], c = to.nodes[j], d = to.nodes[(j + 1) & 3];
      if (a == b || c == d) continue;
      if (a == d && b == c) return along > 0 ? 1 : -1;
      if (a == c && b == d) return along > 0 ? -1 : 1;
    }
  return 0;
}

/// Memory of the segment itself, of its twins, or of a neighbour that the node has left.
void TouchFinder::recall(const TouchFrame& frame, std::span<const Touch> memory) {
  if (memory.empty()) return;
  const auto of = [&](Index segment) -> const Touch* {
    for (const Touch& m : memory)
      if (m.segment == segment) return &m;
    return nullptr;
  };
  for (Place& p : places_)
    if (p.standing == Standing::minimum) p.memory = of(p.segment);
  for (const Place& p : places_)
    if (p.standing == Standing::twin && !places_[p.twin].memory) places_[p.twin].memory = of(p.segment);
  for (Place& p : places_) {
    if (p.standing != Standing::minimum || p.memory) continue;
    const bool inside = segment(p).one_sided && p.side < 0;
    double nearest = -2;
    for (const Touch& m : memory) {
      if (m.share == 0 || !adjacent(segments_->segments()[m.segment], segment(p))) continue;
      const bool held = std::any_of(places_.begin(), places_.end(), [&](const Place& q) {
        return q.segment == m.segment && q.standing != Standing::rejected;
      });
      if (held && !inside) continue;
      const double cosine = p.distance > 0 ? std::abs(dot(m.direction, p.closest.u)) / p.distance : 1.0;
      if (cosine > nearest) nearest = cosine, p.memory = &m;
    }
    if (p.memory) p.expected = side_across(frame, *p.memory, segment(p));
  }
}

void TouchFinder::decide_two_sided(const TouchFrame& frame, NodeIndex node, Place& p) const {
  const Vec3& u = p.closest.u;
  const Segment& s = segment(p);
  const bool flat = is_inside(p.closest.feature, s);
  bool beyond = false;
  if (p.memory) {
    const double along = dot(u, p.memory->direction);
    const bool across = std::abs(along) < 0.5 * p.distance;  // so steep a border that the direction tells nothing
    beyond = flat && across && p.expected != 0 ? p.side * p.expected < 0 : along < (flat ? 0.0 : -0.2 * p.distance);
  } else if (flat && frame.dt > 0) {
    const Vec3 before = u - velocity(frame, node, p) * frame.dt;
    beyond = p.side * dot(before, p.closest.normal) < 0;
  }
  if (p.distance > same * std::sqrt(s.area)) {
    p.direction = u * ((beyond ? -1 : 1) / p.distance);
  } else {
    p.direction = p.memory ? p.memory->direction : p.closest.normal * (p.side < 0 ? -1.0 : 1.0);
  }
  p.penetration = beyond ? p.thickness + p.distance : p.thickness - p.distance;
  p.touches = p.penetration > 0;
}

void TouchFinder::decide_one_sided(const TouchFrame& frame, NodeIndex node, Place& p) const {
  const Segment& s = segment(p);
  const double size = std::sqrt(s.area);
  const bool tiny = p.distance <= same * size;
  if (p.side > 0 && !tiny) {
    p.penetration = p.thickness - p.distance;
    p.direction = p.closest.u / p.distance;
    p.touches = p.penetration > 0;
    return;
  }
  p.inside = true;
  p.direction = tiny ? p.closest.normal : p.closest.u / -p.distance;
  p.penetration = p.thickness + p.distance;
  if (p.memory) {
    p.touches = p.penetration > 0;
    return;
  }
  if (!tiny && std::abs(p.side) < 0.3 * p.distance) return;  // beside a free border
  const double allowed = frame.birth ? std::min(s.depth, frame.margin) : explained_steps * norm(velocity(frame, node, p)) * frame.dt + 1e-3 * size;
  p.touches = p.penetration > 0 && p.distance <= allowed;
}

void TouchFinder::decide(const TouchFrame& frame, NodeIndex node, Place& p) const {
  if (segment(p).one_sided) decide_one_sided(frame, node, p);
  else decide_two_sided(frame, node, p);
  if (!p.touches) return;
  // Without a jump the depth below the offset grows no faster than the relative motion says.
  const double before = p.memory ? std::max(0.0, p.memory->penetration - p.memory->offset) : 0.0;
  const double explained = frame.birth ? 0.0 : before + explained_steps * norm(velocity(frame, node, p)) * frame.dt;
  p.offset = std::max(p.memory ? std::min(p.memory->offset, p.penetration) : 0.0, p.penetration - explained);
}

/// Of a connected one-sided surface only the nearest place pushes.
void TouchFinder::keep_nearest_inside() {
  for (Place& p : places_) {
    if (!p.touches || !p.inside) continue;
    for (const Place& q : places_) {
      if (!q.touches || !q.inside || &q == &p || segment(q).body != segment(p).body) continue;
      if (q.distance < p.distance || (q.distance == p.distance && q.segment < p.segment)) p.share = 0;
    }
  }
}

void TouchFinder::share_forces() {
  order_.clear();
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i].touches && places_[i].share > 0) order_.push_back(i);
  if (order_.size() < 2) return;
  const auto deeper = [&](std::size_t a, std::size_t b) {
    const double da = places_[a].penetration - places_[a].offset, db = places_[b].penetration - places_[b].offset;
    return da != db ? da > db : a < b;
  };
  std::sort(order_.begin(), order_.end(), deeper);
  for (std::size_t i = 1; i < order_.size(); ++i) {
    Place& p = places_[order_[i]];
    for (std::size_t j = 0; j < i; ++j)
      if (const Place& q = places_[order_[j]]; q.share > 0) p.share = std::min(p.share, fade(dot(p.direction, q.direction)));
  }
}

void TouchFinder::collect(Index place, std::vector<Touch>& out) const {
  for (const Place& p : places_) {
    const Place& stands = p.standing == Standing::twin ? places_[p.twin] : p;
    if (p.standing == Standing::rejected || !stands.touches) continue;
    Touch touch;
    touch.place = place;
    touch.segment = p.segment;
    touch.direction = stands.direction;
    touch.penetration = stands.penetration;
    touch.offset = stands.offset;
    if (stands.memory) {
      touch.friction = stands.memory->friction;
      touch.largest = stands.memory->largest;
    }
    if (&stands == &p) {
      touch.weights = p.closest.weights;
      touch.share = p.share;
    }
    out.push_back(touch);
  }
}

void TouchFinder::find(const TouchFrame& frame, Index place, std::span<const Index> near, std::span<float> wake,
                       std::span<const Touch> memory, std::vector<Touch>& out) {
  const SurfaceNode& node = nodes_->nodes()[place];
  const Vec3& x = (*frame.x)[node.node];
  const bool all = one_sided_ && !memory.empty();
  own_of_ = none;
  std::size_t count = 0;
  for (std::size_t c = 0; c < near.size(); ++c) {
    if (wake[c] > frame.travel && !all) continue;
    if (places_.size() == count) places_.emplace_back();
    if (look(frame, x, node.half_thickness, near[c], wake[c], memory, places_[count]) && !averted(frame, place, places_[count])) ++count;
  }
  places_.resize(count);
  if (count == 0) return;
  if (count > 1) find_minima();
  recall(frame, memory);
  bool several = false, any = false;
  for (Place& p : places_) {
    if (p.standing != Standing::minimum) continue;
    decide(frame, node.node, p);
    several = several || (any && p.touches);
    any = any || p.touches;
  }
  if (!any) return;
  if (several) {
    keep_nearest_inside();
    share_forces();
  }
  collect(place, out);
}

}  // namespace kardan

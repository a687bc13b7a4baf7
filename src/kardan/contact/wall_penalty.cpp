#include "kardan/contact/wall_penalty.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

constexpr double squared_frequency = 0.6;  ///< omega^2 dt^2 of a body with RWPNAL = 1
constexpr double of_free_node = 0.1;       ///< k dt^2/m
constexpr double softening_from = 3;       ///< growth of dt^2 that a pressed spring bears

/// tau of the header, of a place in principal axes.
double mobility(const BodyInfo& body, const Vec3& p) {
  const Vec3& j = body.principal_inertia;
  return 3 / body.mass + (p.y * p.y + p.z * p.z) / j.x + (p.z * p.z + p.x * p.x) / j.y + (p.x * p.x + p.y * p.y) / j.z;
}

}  // namespace

void WallPenalty::initialise(const State& state, const std::vector<NodeIndex>& nodes, double scale) {
  std::vector<NodeIndex> sorted = nodes;
  const auto body_of = [&](NodeIndex n) { return state.nodes.body[n]; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](NodeIndex a, NodeIndex b) { return body_of(a) < body_of(b); });
  for (const NodeIndex n : sorted) {
    const BodyIndex b = body_of(n);
    const double mass = state.nodes.mass[n];
    if (b == none) {
      groups_.push_back({none, points_.size(), points_.size() + 1, 0});
      points_.push_back({n, {}, of_free_node * scale * mass});
      continue;
    }
    if (groups_.empty() || groups_.back().body != b) groups_.push_back({b, points_.size(), points_.size(), 0});
    Group& group = groups_.back();
    const BodyMotion& motion = state.bodies.motion[b];
    const Vec3 place = transpose(to_matrix(motion.orientation)) * (state.nodes.x[n] - motion.center);
    points_.push_back({n, place, mass});
    ++group.end;
    group.radius = std::max(group.radius, norm(place));
  }
  for (const Group& group : groups_) {
    if (group.body == none) continue;
    const BodyInfo& body = state.bodies.info[group.body];
    const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(group.begin), end = points_.begin() + static_cast<std::ptrdiff_t>(group.end);
    // Bodies of given mass may have nodes without any: then all weigh the same.
    if (std::any_of(begin, end, [](const Point& p) { return !(p.weight > 0); }))
      std::for_each(begin, end, [](Point& p) { p.weight = 1; });
    double sum = 0;
    std::for_each(begin, end, [&](const Point& p) { sum += p.weight * mobility(body, p.place); });
    std::for_each(begin, end, [&](Point& p) { p.weight *= squared_frequency * scale / sum; });
  }
  springs_.resize(points_.size());
}

/// Calls f(group, point's index, arm, place) for the points of all groups, arm and place as in Push without the wall's displacement; skips those that
/// skip(group, centre) names.
template <class Skip, class F>
void WallPenalty::for_each_point(const State& state, Skip&& skip, F&& f) const {
  for (const Group& group : groups_) {
    if (group.body == none) {
      f(group, group.begin, Vec3{}, state.nodes.x[points_[group.begin].node]);
      continue;
    }
    const BodyMotion& motion = state.bodies.motion[group.body];
    if (skip(group, motion.center)) continue;
    const Mat3 axes = to_matrix(motion.orientation);
    for (std::size_t i = group.begin; i < group.end; ++i) {
      const Vec3 arm = axes * points_[i].place;
      f(group, i, arm, motion.center + arm);
    }
  }
}

void WallPenalty::bear(const State& state, const WallShape& shape, const Vec3& displacement) {
  const auto all = [](const Group&, const Vec3&) { return false; };
  for_each_point(state, all, [&](const Group&, std::size_t i, const Vec3&, const Vec3& x) {
    const Vec3 r = x - displacement;
    Spring& spring = springs_[i];
    spring.free_depth = std::max(shape.depth(r).depth, 0.0);
    if (!(spring.free_depth > 0)) return;
    spring.anchor = r;
    spring.touch = shape.has_edges() && shape.beyond_edges(r) ? behind : pressed;
  });
}

void WallPenalty::let_go() {
  pushes_.clear();
  force_ = {};
}

void WallPenalty::apply(State& state, const WallShape& shape, const Vec3& displacement, double friction) {
  const Clock& clock = state.clock;
  let_go();
  if (!(clock.dt_previous > 0)) return;
  const auto far = [&](const Group& group, const Vec3& center) {
    if (shape.has_edges() || shape.clearance(center - displacement) <= group.radius) return false;
    std::fill(springs_.begin() + static_cast<std::ptrdiff_t>(group.begin), springs_.begin() + static_cast<std::ptrdiff_t>(group.end), Spring{});
    return true;
  };
  for_each_point(state, far, [&](const Group& group, std::size_t i, const Vec3& arm, const Vec3& x) {
    Push p{points_[i].node, group.body, arm, x - displacement, {}, 0};
    press(points_[i], springs_[i], shape, friction, clock.dt_previous, p);
    if (!(p.pressing > 0)) return;
    pushes_.push_back(p);
    force_ += p.force;
    if (group.body == none) {
      state.nodes.force[p.node] += p.force;
    } else {
      state.bodies.force[group.body] += p.force;
      state.bodies.moment[group.body] += cross(arm, p.force);
    }
  });
}

/// Force on one node, and what becomes of its spring.
void WallPenalty::press(const Point& point, Spring& spring, const WallShape& shape, double friction, double dt, Push& push) {
  const WallShape::Depth at = shape.depth(push.place);
  if (!(at.depth > 0)) {
    spring = {};
    return;
  }
  if (spring.touch == behind) return;
  if (shape.has_edges() && shape.beyond_edges(push.place)) {
    spring.touch = behind;
    return;
  }
  const double stiffest = point.weight / (dt * dt);
  if (spring.touch == apart) spring.anchor = push.place;
  if (spring.stiffness == 0) spring.stiffness = stiffest;
  spring.stiffness = std::min(spring.stiffness, softening_from * stiffest);
  spring.touch = pressed;
  spring.free_depth = std::min(spring.free_depth, at.depth);
  push.pressing = spring.stiffness * (at.depth - spring.free_depth);
  const Vec3 way = push.place - spring.anchor;
  Vec3 tangential = (way - at.normal * dot(way, at.normal)) * -spring.stiffness;
  const double size = norm(tangential), limit = friction * push.pressing;
  if (friction < 1 && size > limit) {
    tangential *= limit / size;
    spring.anchor = push.place + tangential / spring.stiffness;
  }
  push.force = at.normal * push.pressing + tangential;
}

double WallPenalty::power(const State& state, const Vec3& wall_velocity) const {
  double power = 0;
  for (const Push& p : pushes_) {
    Vec3 v = -wall_velocity;
    if (p.body == none)
      v += state.nodes.v[p.node];
    else
      v += state.bodies.motion[p.body].velocity + cross(state.bodies.motion[p.body].angular_velocity, p.arm);
    power += dot(p.force, v);
  }
  return power;
}

}  // namespace kardan

#include "kardan/rigid/initial_velocities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

/// V = sum m v / M and the w for which sum m r x (v - V) = (sum m (r^2 - r r^T)) w: the rigid motion with the nodes'
/// linear and angular momentum. Nodes without mass count equally if none has any.
void from_nodes(State& state, const BodyAssembly& assembly, std::size_t b) {
  const BodyNodes& nodes = assembly.nodes;
  const std::size_t first = nodes.first[b], last = nodes.first[b + 1];
  double total = 0;
  for (std::size_t i = first; i < last; ++i) total += state.nodes.mass[nodes.node[i]];
  const bool massless = !(total > 0);
  const auto weight = [&](std::size_t i) { return massless ? 1.0 : state.nodes.mass[nodes.node[i]]; };
  if (massless) total = static_cast<double>(last - first);
  if (first == last) return;

  Vec3 momentum, middle;
  const Mat3 rotation = to_matrix(state.bodies.motion[b].orientation);
  for (std::size_t i = first; i < last; ++i) {
    momentum += state.nodes.v[nodes.node[i]] * weight(i);
    middle += rotation * nodes.arm[i] * weight(i);
  }
  const Vec3 mean_velocity = momentum / total;
  middle = middle / total;
  Vec3 angular;
  Mat3 spread{};
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 r = rotation * nodes.arm[i] - middle;
    angular += cross(r, state.nodes.v[nodes.node[i]] - mean_velocity) * weight(i);
    spread += (Mat3::identity() * dot(r, r) - outer(r, r)) * weight(i);
  }
  BodyMotion& motion = state.bodies.motion[b];
  const bool turns = norm(angular) > 0 && determinant(spread) > 1e-18 * std::pow(trace(spread), 3.0);
  motion.angular_velocity = turns ? inverse(spread) * angular : Vec3{};
  // The nodes' middle need not be the centre of mass (*PART_INERTIA).
  motion.velocity = mean_velocity - cross(motion.angular_velocity, middle);
}

bool overridden(const Model& model, const State& state, const BodyAssembly& assembly, std::size_t b) {
  const auto begin = assembly.nodes.node.begin() + static_cast<std::ptrdiff_t>(assembly.nodes.first[b]);
  const auto end = assembly.nodes.node.begin() + static_cast<std::ptrdiff_t>(assembly.nodes.first[b + 1]);
  return std::any_of(model.initial_velocities.begin(), model.initial_velocities.end(), [&](const InitialVelocity& v) {
    if (!v.include_rigid || v.kind == InitialVelocity::Kind::rigid_body) return false;
    if (!v.override_parts.empty() &&
        std::none_of(v.override_parts.begin(), v.override_parts.end(),
                     [&](PartIndex p) { return p != none && state.bodies.of_part[p] == static_cast<BodyIndex>(b); }))
      return false;
    return v.all_nodes || std::any_of(v.nodes.begin(), v.nodes.end(),
                                      [&](NodeIndex n) { return std::find(begin, end, n) != end; });
  });
}

}  // namespace

void initial_body_velocities(const Model& model, State& state, const BodyAssembly& assembly, Diagnostics& diagnostics) {
  for (std::size_t b = 0; b < state.bodies.info.size(); ++b) {
    BodyMotion& motion = state.bodies.motion[b];
    from_nodes(state, assembly, b);
    if (!assembly.given_velocity[b]) continue;
    const Vec3 &v = assembly.initial_velocity[b], &w = assembly.initial_omega[b];
    const bool blank = norm(v) == 0 && norm(w) == 0;
    const bool moving = norm(motion.velocity) > 0 || norm(motion.angular_velocity) > 0;
    if (overridden(model, state, assembly, b)) continue;
    if (blank && moving) {
      diagnostics.notice(fmt::format("body {} has given inertia with blank velocities: it starts with the velocity of its nodes",
                                     state.bodies.info[b].id), "*PART_INERTIA");
      continue;
    }
    motion.velocity = v;
    motion.angular_velocity = w;
  }
  for (const InitialVelocity& v : model.initial_velocities) {
    if (v.kind != InitialVelocity::Kind::rigid_body) continue;
    const BodyIndex b = v.body_part == none ? none : state.bodies.of_part[v.body_part];
    if (b == none) {
      diagnostics.error(fmt::format("part {} is not a rigid body", v.body_part == none ? 0 : model.parts[v.body_part].id),
                        "name a part with *MAT_RIGID", "*INITIAL_VELOCITY_RIGID_BODY");
      continue;
    }
    const Mat3 axes = v.frame == none ? Mat3::identity() : model.frames[v.frame].axes;
    state.bodies.motion[b].velocity = axes * v.velocity;
    state.bodies.motion[b].angular_velocity = axes * v.angular_velocity;
  }
}

}  // namespace kardan

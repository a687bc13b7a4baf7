// Velocity of the material point of a node.
#pragma once

#include "kardan/state/state.hpp"

namespace kardan {

/// Velocity at the half step of a free node, or of the point of a rigid body where node n stands at t_n. Before the kick it is
/// the one at t_{n-1/2}, after it the one at t_{n+1/2}.
inline Vec3 velocity_of(const State& state, NodeIndex n) {
  const BodyIndex b = state.nodes.body[n];
  if (b == none) return state.nodes.v[n];
  const BodyMotion& motion = state.bodies.motion[b];
  return motion.velocity + cross(motion.angular_velocity, state.nodes.x[n] - motion.center);
}

}  // namespace kardan

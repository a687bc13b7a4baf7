#include "kardan/state/frames.hpp"

namespace kardan {

namespace {

/// Right-handed axes: `axis` (0-2) along `along`, the next one in the half plane of `in_plane`.
Mat3 axes_from(int axis, const Vec3& along, const Vec3& in_plane) {
  const Vec3 e0 = normalized(along), e2 = normalized(cross(e0, in_plane)), e1 = cross(e2, e0);
  switch (axis) {
    case 0: return Mat3::columns(e0, e1, e2);
    case 1: return Mat3::columns(e2, e0, e1);
    default: return Mat3::columns(e1, e2, e0);
  }
}

}  // namespace

Mat3 frame_axes(const Model& model, const State& state, Index frame) {
  if (frame == none) return Mat3::identity();
  const Frame& f = model.frames[frame];
  if (f.moves) {
    const Vec3& origin = state.nodes.x[f.nodes[0]];
    return axes_from(f.axis - 1, state.nodes.x[f.nodes[1]] - origin, state.nodes.x[f.nodes[2]] - origin);
  }
  if (f.carrier != none && state.nodes.body[f.carrier] != none) {
    const BodyIndex b = state.nodes.body[f.carrier];
    return to_matrix(state.bodies.motion[b].orientation * conjugate(state.bodies.info[b].initial_orientation)) * f.axes;
  }
  return f.axes;
}

Vec3 vector_direction(const Model& model, const State& state, Index vector) {
  const DirectionVector& v = model.vectors[vector];
  if (v.nodes[0] != none) return normalized(state.nodes.x[v.nodes[1]] - state.nodes.x[v.nodes[0]]);
  return normalized(frame_axes(model, state, v.frame) * (v.head - v.tail));
}

void need_frame(const Model& model, State& state, Index frame) {
  if (frame == none || !model.frames[frame].moves) return;
  for (const NodeIndex n : model.frames[frame].nodes) state.nodes.needed[n] = 1;
}

void need_vector(const Model& model, State& state, Index vector) {
  if (vector == none) return;
  const DirectionVector& v = model.vectors[vector];
  need_frame(model, state, v.frame);
  for (const NodeIndex n : v.nodes) {
    if (n != none) state.nodes.needed[n] = 1;
  }
}

}  // namespace kardan

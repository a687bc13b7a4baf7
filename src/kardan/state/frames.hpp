// Where the user's frames and vectors point at t_n: some follow nodes.
#pragma once

#include "kardan/base/vec3.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Axes (columns, global components) at t_n of a frame; identity for `none`. A frame of *DEFINE_COORDINATE_NODES with
/// FLAG = 1 is made afresh from its nodes: DIR = 1 local x along nodes 1-2 and node 3 in the local xy plane, 2 local y
/// along them and node 3 in the yz plane, 3 local z along them and node 3 in the zx plane. A frame with a carrier node
/// turns with the rigid body of that node.
Mat3 frame_axes(const Model& model, const State& state, Index frame);

/// Unit direction at t_n of a *DEFINE_VECTOR: head - tail in the axes of its frame, or between its two nodes.
Vec3 vector_direction(const Model& model, const State& state, Index vector);

/// Marks in state.nodes.needed the nodes that frame_axes() and vector_direction() read.
void need_frame(const Model& model, State& state, Index frame);
void need_vector(const Model& model, State& state, Index vector);

}  // namespace kardan

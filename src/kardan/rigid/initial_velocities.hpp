// Velocities of the bodies at t = 0.
#pragma once

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/body_assembly.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// In this order, the later overriding the earlier: by momentum from the velocities of the body's nodes; the velocities given
/// with *PART_INERTIA or *CONSTRAINED_NODAL_RIGID_BODY_INERTIA, unless an *INITIAL_VELOCITY with IRIGID = 1 covers the body
/// or all of them are blank; *INITIAL_VELOCITY_RIGID_BODY. Writes state.bodies.motion (velocity, angular velocity).
void initial_body_velocities(const Model& model, State& state, const BodyAssembly& assembly, Diagnostics& diagnostics);

}  // namespace kardan

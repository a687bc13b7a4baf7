// *INITIAL_VELOCITY, _NODE and _GENERATION.
#include "kardan/loads/load_system.hpp"
#include "kardan/loads/part_nodes.hpp"
#include "kardan/state/frames.hpp"

namespace kardan {

namespace {

void set_nodes(const Model& model, State& state, const InitialVelocity& load) {
  NodeState& nodes = state.nodes;
  const Mat3 axes = frame_axes(model, state, load.frame);
  const Vec3 v = axes * load.velocity, omega = axes * load.angular_velocity;
  const auto set = [&](NodeIndex n, const Vec3& velocity, const Vec3& angular_velocity) {
    nodes.v[n] = velocity;
    nodes.omega[n] = angular_velocity;
  };
  if (load.all_nodes) {
    for (std::size_t n = 0; n < nodes.v.size(); ++n) set(static_cast<NodeIndex>(n), v, omega);
  } else {
    for (const NodeIndex n : load.nodes) set(n, v, omega);
  }
  const Vec3 exempt_v = axes * load.exempt_velocity, exempt_omega = axes * load.exempt_angular_velocity;
  for (const NodeIndex n : load.exempt) set(n, exempt_v, exempt_omega);
}

/// Rotation about an axis on top of a translation: v = v0 + omega e x (x - p).
void set_generation(const Model& model, State& state, const InitialVelocity& load) {
  NodeState& nodes = state.nodes;
  const Mat3 axes = frame_axes(model, state, load.frame);
  const Vec3 v0 = axes * load.velocity;
  const double length = norm(load.axis_direction);
  const Vec3 omega = length > 0 ? load.axis_direction * (load.omega / length) : Vec3{};
  const auto set = [&](NodeIndex n) {
    nodes.v[n] = v0 + cross(omega, nodes.x[n] - load.axis_point);
    nodes.omega[n] = omega;
  };
  if (load.all_nodes) {
    for (std::size_t n = 0; n < nodes.v.size(); ++n) set(static_cast<NodeIndex>(n));
    return;
  }
  for (const NodeIndex n : nodes_of_parts(model, load.parts)) set(n);
  for (const NodeIndex n : load.nodes) set(n);
}

}  // namespace

void LoadSystem::set_initial_velocities(const Model& model, State& state, Diagnostics& diagnostics) {
  for (const InitialVelocity& load : model.initial_velocities) {
    switch (load.kind) {
      case InitialVelocity::Kind::nodes:
        set_nodes(model, state, load);
        break;
      case InitialVelocity::Kind::generation:
        if (load.omega != 0 && norm(load.axis_direction) == 0) {
          diagnostics.error("the axis of rotation has no direction (NX = NY = NZ = 0)", "give NX, NY, NZ",
                            "*INITIAL_VELOCITY_GENERATION");
          break;
        }
        set_generation(model, state, load);
        break;
      case InitialVelocity::Kind::rigid_body:
        break;  // a velocity of the body, not of its nodes: set by the bodies themselves
    }
  }
}

}  // namespace kardan

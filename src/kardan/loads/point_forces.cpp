// DOF 1-3 and 5-7: force and moment along the global axes, or those of frame CID. DOF 4 and 8: follower force and moment along
//   t = (x2 - x1) x (x3 - x1) / |...|
// of the current positions of M1, M2, M3; a positive follower moment turns counterclockwise about t.
// Source: Hallquist, LS-DYNA Keyword User's Manual, *LOAD_NODE, remarks.
#include "kardan/loads/point_forces.hpp"

#include <string>

#include "kardan/loads/node_velocity.hpp"
#include "kardan/state/frames.hpp"
#include "kardan/state/load_curve.hpp"

namespace kardan {

namespace {

constexpr int follower_force = 4, follower_moment = 8;

bool follower(const PointLoad& load) { return load.dof == follower_force || load.dof == follower_moment; }

Vec3 direction(const Model& model, const State& state, const PointLoad& load) {
  if (follower(load)) {
    const Vec3& origin = state.nodes.x[load.m[0]];
    return normalized(cross(state.nodes.x[load.m[1]] - origin, state.nodes.x[load.m[2]] - origin));
  }
  return frame_axes(model, state, load.frame).column(static_cast<std::size_t>(load.dof - 1) % 4);
}

}  // namespace

PointForces::PointForces(const Model& model, State& state, Diagnostics& diagnostics) : value_(model.point_loads.size()) {
  for (std::size_t l = 0; l < model.point_loads.size(); ++l) {
    const PointLoad& load = model.point_loads[l];
    const bool on_body = load.body_part != none;
    const char* keyword = on_body ? "*LOAD_RIGID_BODY" : "*LOAD_NODE";
    if (load.dof < 1 || load.dof > follower_moment) {
      diagnostics.error("DOF = " + std::to_string(load.dof) + " of a load; 1 to 8 are known", "give DOF 1 to 8", keyword);
      continue;
    }
    if (follower(load)) {
      if (load.m[0] == none || load.m[1] == none || load.m[2] == none) {
        diagnostics.error("a follower load (DOF = " + std::to_string(load.dof) + ") needs three nodes", "give M1, M2, M3",
                          keyword);
        continue;
      }
      for (const NodeIndex n : load.m) state.nodes.needed[n] = 1;
    }
    need_frame(model, state, load.frame);
    const bool moment = load.dof > follower_force;
    if (on_body) {
      const BodyIndex b = state.bodies.of_part[load.body_part];
      if (b == none) {
        diagnostics.error("part " + std::to_string(model.parts[load.body_part].id) + " is loaded as a rigid body and is none",
                          "give PID the number of a part of *MAT_RIGID or of a nodal rigid body", keyword);
        continue;
      }
      entries_.push_back({static_cast<Index>(l), none, b, moment});
      continue;
    }
    for (const NodeIndex n : load.nodes) {
      const BodyIndex b = state.nodes.body[n];
      const double resists = moment ? state.nodes.inertia[n] : state.nodes.mass[n];
      if (b == none && resists <= 0) {
        diagnostics.error("node " + std::to_string(model.nodes.id[n]) + " carries a " + (moment ? "moment" : "force") +
                              " but has no " + (moment ? "rotary inertia" : "mass"),
                          "load a node of an element or of a rigid body", keyword);
        continue;
      }
      state.nodes.needed[n] = 1;
      entries_.push_back({static_cast<Index>(l), n, b, moment});
    }
  }
}

double PointForces::apply(const Model& model, State& state) {
  for (std::size_t l = 0; l < value_.size(); ++l) {
    const PointLoad& load = model.point_loads[l];
    const double value = load.scale * load_curve_value(model, state.clock, load.curve);
    value_[l] = direction(model, state, load) * value;
  }
  for (const Entry& e : entries_) {
    auto& target = e.node != none ? (e.moment ? state.nodes.moment : state.nodes.force)
                                  : (e.moment ? state.bodies.moment : state.bodies.force);
    target[e.node != none ? e.node : e.body] += value_[e.load];
  }
  return power(state);
}

double PointForces::power(const State& state) const {
  double power = 0;
  for (const Entry& e : entries_) {
    Vec3 velocity;
    if (e.moment) {
      velocity = e.body == none ? state.nodes.omega[e.node] : state.bodies.motion[e.body].angular_velocity;
    } else {
      velocity = e.node != none ? velocity_of(state, e.node) : state.bodies.motion[e.body].velocity;
    }
    power += dot(value_[e.load], velocity);
  }
  return power;
}

}  // namespace kardan

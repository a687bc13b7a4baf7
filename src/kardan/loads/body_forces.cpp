// A base acceleration a acts on every mass m as the force -m a (so a positive *LOAD_BODY_Z drives the model towards -z).
//
// *LOAD_BODY_RX ...: the base turns with angular velocity w about an axis through c. Every mass feels the centrifugal force
//   f = -m w x (w x (x - c)),
// radially outward, on current coordinates; a change of w is not felt. Source: Hallquist, LS-DYNA Keyword User's Manual,
// *LOAD_BODY, remarks. On a rigid body of mass M, centre s and inertia J (about s) the sum over its masses is
//   F = -M w x (w x (s - c)),
//   T = -sum m r x (w x (w x r)) = -sum m (r x w)(w . r) = w x (S w),   S = sum m r r^T = tr(J)/2 I - J,
//     = -w x (J w)                                                     (the term of S along w drops out).
#include "kardan/loads/body_forces.hpp"

#include <algorithm>
#include <map>

#include "kardan/base/rotation.hpp"
#include "kardan/loads/part_nodes.hpp"
#include "kardan/state/frames.hpp"
#include "kardan/state/load_curve.hpp"

namespace kardan {

namespace {

constexpr int vector_axis = 6;

Vec3 unit(int axis) { return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}; }

Vec3 direction(const Model& model, const State& state, const BodyLoad& load) {
  const Vec3 local = load.axis == vector_axis ? normalized(load.vector) : unit(load.axis % 3);
  return frame_axes(model, state, load.frame) * local;
}

Vec3 inertia_times(const State& state, BodyIndex b, const Vec3& w) {
  const Mat3 r = to_matrix(state.bodies.motion[b].orientation);
  const Vec3 local = transpose(r) * w;
  const Vec3& j = state.bodies.info[b].principal_inertia;
  return r * Vec3{j.x * local.x, j.y * local.y, j.z * local.z};
}

}  // namespace

BodyForces::BodyForces(const Model& model, State& state, Diagnostics& diagnostics) {
  std::map<std::vector<PartIndex>, std::size_t> group_of;
  for (std::size_t l = 0; l < model.body_loads.size(); ++l) {
    const BodyLoad& load = model.body_loads[l];
    if (load.axis == vector_axis && norm(load.vector) == 0) {
      diagnostics.error("the vector of the body load has no direction (V1 = V2 = V3 = 0)", "give V1, V2, V3",
                        "*LOAD_BODY_VECTOR");
      continue;
    }
    need_frame(model, state, load.frame);
    const auto [place, fresh] = group_of.emplace(load.parts, groups_.size());
    if (fresh) groups_.emplace_back();
    groups_[place->second].loads.push_back(static_cast<Index>(l));
  }
  for (const auto& [parts, g] : group_of) {
    Group& group = groups_[g];
    std::vector<NodeIndex> candidates;
    std::vector<bool> moved(state.bodies.info.size(), parts.empty());
    if (parts.empty()) {
      candidates.resize(model.nodes.size());
      for (std::size_t n = 0; n < candidates.size(); ++n) candidates[n] = static_cast<NodeIndex>(n);
    } else {
      candidates = nodes_of_parts(model, parts);
      for (const PartIndex p : parts) {
        if (state.bodies.of_part[p] != none) moved[state.bodies.of_part[p]] = true;
      }
    }
    for (const NodeIndex n : candidates) {
      if (state.nodes.body[n] == none && state.nodes.mass[n] > 0) group.nodes.push_back(n);
    }
    for (std::size_t b = 0; b < moved.size(); ++b) {
      if (moved[b]) group.bodies.push_back(static_cast<BodyIndex>(b));
    }
    group.spins.reserve(group.loads.size());
  }
}

Vec3 BodyForces::Group::force_per_mass(const Vec3& x) const {
  Vec3 f = -acceleration;
  for (const Spin& s : spins) f -= cross(s.omega, cross(s.omega, x - s.center));
  return f;
}

double BodyForces::apply(const Model& model, State& state) {
  for (Group& group : groups_) {
    group.acceleration = {};
    group.spins.clear();
    for (const Index l : group.loads) {
      const BodyLoad& load = model.body_loads[l];
      const bool own = state.clock.relaxing && load.relaxation_curve != none;
      const double value = load.scale * load_curve_value(model, state.clock, own ? load.relaxation_curve : load.curve);
      const Vec3 along = direction(model, state, load);
      if (load.axis >= 3 && load.axis != vector_axis) {
        group.spins.push_back({along * value, load.center});
      } else {
        group.acceleration += along * value;
      }
    }
    for (const NodeIndex n : group.nodes) {
      state.nodes.force[n] += group.force_per_mass(state.nodes.x[n]) * state.nodes.mass[n];
    }
    for (const BodyIndex b : group.bodies) {
      state.bodies.force[b] += group.force_per_mass(state.bodies.motion[b].center) * state.bodies.info[b].mass;
      for (const Group::Spin& s : group.spins) state.bodies.moment[b] -= cross(s.omega, inertia_times(state, b, s.omega));
    }
  }
  return power(state);
}

double BodyForces::power(const State& state) const {
  double power = 0;
  for (const Group& group : groups_) {
    for (const NodeIndex n : group.nodes) {
      power += state.nodes.mass[n] * dot(group.force_per_mass(state.nodes.x[n]), state.nodes.v[n]);
    }
    for (const BodyIndex b : group.bodies) {
      const BodyMotion& motion = state.bodies.motion[b];
      power += state.bodies.info[b].mass * dot(group.force_per_mass(motion.center), motion.velocity);
      for (const Group::Spin& s : group.spins) {
        power -= dot(cross(s.omega, inertia_times(state, b, s.omega)), motion.angular_velocity);
      }
    }
  }
  return power;
}

}  // namespace kardan

// The force on a mass m is  f_d = -D m v;  D [1/time] is the damping constant, on each global axis times its factor ST, SR. On a rigid
// body likewise the force at the centre is -D M v and the moment -D L, L its angular momentum.
// *DAMPING_RELATIVE takes the velocity against the point of a rigid body where the node stands, D = 2 zeta (2 pi f), and puts the opposite
// force on that body. Source: Hallquist, LS-DYNA Keyword User's Manual, *DAMPING.
//
// The half step: with v_n = (v_{n-1/2} + v_{n+1/2})/2 and a kick of length k the central difference method becomes
//   v_{n+1/2} = [(2 - D k) v_{n-1/2} + 2 k f/m] / (2 + D k)
// (Underwood, Dynamic relaxation, in Computational Methods for Transient Analysis, 1983, eq. 2.9): stable for every D, and the damping
// does not shorten the stable step. It is the force
//   f_d = -D m (v_{n-1/2} + v*)/2 / (1 + D k/2),     v* = v_{n-1/2} + k f/m  the velocity after the kick without damping,
// and each kick dissipates exactly  k D m |v_n|^2.
#include "kardan/loads/damping.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>

#include "kardan/loads/part_nodes.hpp"
#include "kardan/state/load_curve.hpp"

namespace kardan {

namespace {

/// -D p / (1 + D k/2) on each axis; p is the mean of the momenta before and after the kick without damping.
Vec3 damping_force(const Vec3& rate, const Vec3& momentum, double kick) {
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = -rate[i] * momentum[i] / (1 + 0.5 * kick * rate[i]);
  return result;
}

/// How many elements each node has: in `parts`, and in all.
struct ElementCount {
  std::vector<std::uint32_t> damped, all;

  ElementCount(const Model& model, const std::vector<PartIndex>& parts)
      : damped(model.nodes.size(), 0), all(model.nodes.size(), 0) {
    std::vector<std::uint8_t> wanted(model.parts.size(), 0);
    for (const PartIndex p : parts) wanted[p] = 1;
    const auto count = [&](const auto& block, std::size_t used) {
      for (std::size_t e = 0; e < block.size(); ++e) {
        for (std::size_t k = 0; k < used; ++k) {
          const NodeIndex n = block.nodes[e][k];
          if (n == none) continue;
          ++all[n];
          if (wanted[block.part[e]]) ++damped[n];
        }
      }
    };
    count(model.shells, 4);
    count(model.solids, 8);
    count(model.beams, 2);
  }
};

}  // namespace

Damping::Damping(const Model& model, State& state, Diagnostics& diagnostics) {
  for (const DampingLaw& law : model.dampings) {
    Group& group = groups_.emplace_back();
    const bool relative = law.relative_to != none;
    if (relative && state.bodies.of_part[law.relative_to] == none) {
      diagnostics.error("part " + std::to_string(model.parts[law.relative_to].id) + " leads a damping and is no rigid body",
                        "give PIDRB the number of a part of *MAT_RIGID or of a nodal rigid body", "*DAMPING_RELATIVE");
      continue;
    }
    const auto take_node = [&](NodeIndex n, double share) {
      if (state.nodes.body[n] == none && state.nodes.mass[n] > 0) group.nodes.push_back({n, share, {}, {}, {}, {}});
    };
    std::vector<bool> damped(state.bodies.info.size(), law.parts.empty() && !relative);
    if (law.parts.empty()) {
      for (std::size_t n = 0; n < model.nodes.size(); ++n) take_node(static_cast<NodeIndex>(n), 1.0);
    } else {
      const ElementCount count(model, law.parts);
      for (const NodeIndex n : nodes_of_parts(model, law.parts))
        take_node(n, count.all[n] > 0 ? static_cast<double>(count.damped[n]) / count.all[n] : 1.0);
      for (const PartIndex p : law.parts)
        if (!relative && state.bodies.of_part[p] != none) damped[state.bodies.of_part[p]] = true;
    }
    for (std::size_t b = 0; b < damped.size(); ++b)
      if (damped[b]) group.bodies.push_back({static_cast<BodyIndex>(b), {}, {}});
    if (relative) group.bodies.push_back({state.bodies.of_part[law.relative_to], {}, {}});
  }
  if (!groups_.empty()) state.registry.add_value({"loads.damping", "energy", "loads.account"}, meter_);
}

void Damping::before_kick(const State& state) {
  for (Group& group : groups_) {
    for (DampedNode& d : group.nodes) {
      d.v_before = state.nodes.v[d.node];
      d.omega_before = state.nodes.omega[d.node];
    }
  }
}

void Damping::apply(const Model& model, State& state) {
  if (groups_.empty()) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const DampingLaw& law = model.dampings[g];
    const double rate = law.value * load_curve_value(model, state.clock, law.curve);
    if (law.relative_to != none) {
      damp_relative(state, groups_[g], 4 * std::numbers::pi * law.frequency * rate);
    } else {
      damp_nodes(state, groups_[g], law.translation * rate, law.rotation * rate);
      damp_bodies(state, groups_[g], law.translation * rate, law.rotation * rate);
    }
  }
  double power = power_on_bodies(state);
  for (const Group& group : groups_)
    for (const DampedNode& d : group.nodes) power += dot(d.force, d.v_before) + dot(d.moment, d.omega_before);
  meter_.before(power);
}

void Damping::damp_nodes(State& state, Group& group, const Vec3& translation, const Vec3& rotation) const {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick();
  for (DampedNode& d : group.nodes) {
    const NodeIndex n = d.node;
    if (nodes.mass[n] <= 0) continue;  // tied to a segment, which has its mass
    d.force = damping_force(translation * d.share, (d.v_before + nodes.v[n]) * (0.5 * nodes.mass[n]), kick);
    nodes.v[n] += d.force * (kick / nodes.mass[n]);
    if (nodes.inertia[n] <= 0) continue;
    d.moment = damping_force(rotation * d.share, (d.omega_before + nodes.omega[n]) * (0.5 * nodes.inertia[n]), kick);
    nodes.omega[n] += d.moment * (kick / nodes.inertia[n]);
  }
}

void Damping::damp_bodies(State& state, Group& group, const Vec3& translation, const Vec3& rotation) const {
  BodyState& bodies = state.bodies;
  const double kick = state.clock.kick();
  for (DampedBody& d : group.bodies) {
    const BodyMotion& motion = bodies.motion[d.body];
    const Vec3 momentum = motion.velocity * bodies.info[d.body].mass + bodies.force[d.body] * (0.5 * kick);
    d.force = damping_force(translation, momentum, kick);
    d.moment = damping_force(rotation, motion.angular_momentum + bodies.moment[d.body] * (0.5 * kick), kick);
    bodies.force[d.body] += d.force;
    bodies.moment[d.body] += d.moment;
  }
}

void Damping::damp_relative(State& state, Group& group, double rate) const {
  NodeState& nodes = state.nodes;
  DampedBody& lead = group.bodies.front();
  const BodyMotion& motion = state.bodies.motion[lead.body];
  const double kick = state.clock.kick();
  // The change of the lead body's angular velocity in this kick is left out: of second order in the step.
  const Vec3 lead_velocity = motion.velocity + state.bodies.force[lead.body] * (0.5 * kick / state.bodies.info[lead.body].mass);
  lead.force = lead.moment = {};
  for (DampedNode& d : group.nodes) {
    const NodeIndex n = d.node;
    if (nodes.mass[n] <= 0) continue;
    const Vec3 arm = nodes.x[n] - motion.center;
    const Vec3 relative = (d.v_before + nodes.v[n]) * 0.5 - lead_velocity - cross(motion.angular_velocity, arm);
    d.force = damping_force(Vec3{1, 1, 1} * (rate * d.share), relative * nodes.mass[n], kick);
    nodes.v[n] += d.force * (kick / nodes.mass[n]);
    lead.force -= d.force;
    lead.moment -= cross(arm, d.force);
  }
  state.bodies.force[lead.body] += lead.force;
  state.bodies.moment[lead.body] += lead.moment;
}

double Damping::power_on_bodies(const State& state) const {
  double power = 0;
  for (const Group& group : groups_) {
    for (const DampedBody& d : group.bodies) {
      const BodyMotion& motion = state.bodies.motion[d.body];
      power += dot(d.force, motion.velocity) + dot(d.moment, motion.angular_velocity);
    }
  }
  return power;
}

void Damping::account(State& state) {
  if (groups_.empty()) return;
  double power = power_on_bodies(state);
  for (const Group& group : groups_)
    for (const DampedNode& d : group.nodes) power += dot(d.force, state.nodes.v[d.node]) + dot(d.moment, state.nodes.omega[d.node]);
  state.energy.system_damping -= meter_.after(power, state.clock);
}

}  // namespace kardan

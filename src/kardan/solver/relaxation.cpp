// Dynamic relaxation before t = 0: every cycle the velocities are multiplied by DRFCTR before the kick,
//   v_{n+1/2} = DRFCTR v_{n-1/2} + k f/m,
// until the kinetic energy of the distortion has died away. Source: Hallquist, LS-DYNA Theory Manual, Dynamic relaxation and system
// damping; Underwood 1983.
#include "kardan/solver/relaxation.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "kardan/base/rotation.hpp"
#include "kardan/contact/contact_system.hpp"
#include "kardan/contact/rigid_wall.hpp"
#include "kardan/contact/tied.hpp"
#include "kardan/elements/element_system.hpp"
#include "kardan/loads/load_system.hpp"
#include "kardan/solver/node_mover.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan {

namespace {

Mat3 inertia_of(const State& state, std::size_t b) {
  const Mat3 axes = to_matrix(state.bodies.motion[b].orientation);
  return axes * Mat3::diagonal(state.bodies.info[b].principal_inertia) * transpose(axes);
}

/// f(mass, x, v) for each free node and each body as a point.
template <class F>
void for_each_mass(const State& state, F&& f) {
  const NodeState& nodes = state.nodes;
  for (std::size_t n = 0; n < nodes.x.size(); ++n)
    if (nodes.body[n] == none && nodes.mass[n] > 0) f(nodes.mass[n], nodes.x[n], nodes.v[n]);
  for (std::size_t b = 0; b < state.bodies.info.size(); ++b)
    f(state.bodies.info[b].mass, state.bodies.motion[b].center, state.bodies.motion[b].velocity);
}

void scale_velocities(State& state, double factor) {
  for (std::vector<Vec3>* velocities : {&state.nodes.v, &state.nodes.omega})
    for (Vec3& v : *velocities) v *= factor;
  for (BodyMotion& m : state.bodies.motion) {
    m.velocity *= factor;
    m.angular_velocity *= factor;
    m.angular_momentum *= factor;
  }
}

}  // namespace

void Velocities::restore(State& state) const {
  state.nodes.v = v_;
  state.nodes.omega = omega_;
  for (std::size_t b = 0; b < motion_.size(); ++b) {
    BodyMotion& m = state.bodies.motion[b];
    m.velocity = motion_[b].velocity;
    m.angular_velocity = motion_[b].angular_velocity;
    m.angular_momentum = inertia_of(state, b) * m.angular_velocity;
  }
}

void Velocities::register_state(Registry& registry) {
  registry.keep({"relaxation.v", "length/time", "solver"}, v_);
  registry.keep({"relaxation.omega", "1/time", "solver"}, omega_);
  registry.keep({"relaxation.bodies", "mixed", "solver"}, motion_);
}

void Relaxation::register_state(Registry& registry) {
  registry.keep_value({"relaxation.watch", "energy, 1", "solver"}, watch);
  registry.keep_value({"relaxation.carry", "time", "solver"}, hand.carry());
  initial.register_state(registry);
}

MotionEnergy motion_energy(const State& state) {
  double mass = 0;
  Vec3 first_moment, momentum, angular_momentum;
  Mat3 inertia;
  MotionEnergy energy;
  for_each_mass(state, [&](double m, const Vec3& x, const Vec3& v) {
    mass += m;
    first_moment += x * m;
    momentum += v * m;
  });
  if (mass <= 0) return energy;
  const Vec3 center = first_moment / mass;
  for_each_mass(state, [&](double m, const Vec3& x, const Vec3& v) {
    const Vec3 r = x - center;
    angular_momentum += cross(r, v) * m;
    inertia += (Mat3::identity() * dot(r, r) - outer(r, r)) * m;
    energy.total += 0.5 * m * dot(v, v);
  });
  const NodeState& nodes = state.nodes;
  for (std::size_t n = 0; n < nodes.x.size(); ++n) {
    if (nodes.body[n] != none || nodes.mass[n] <= 0) continue;
    angular_momentum += nodes.omega[n] * nodes.inertia[n];
    inertia += Mat3::identity() * nodes.inertia[n];
    energy.total += 0.5 * nodes.inertia[n] * dot(nodes.omega[n], nodes.omega[n]);
  }
  for (std::size_t b = 0; b < state.bodies.info.size(); ++b) {
    const BodyMotion& m = state.bodies.motion[b];
    angular_momentum += m.angular_momentum;
    inertia += inertia_of(state, b);
    energy.total += 0.5 * dot(m.angular_velocity, m.angular_momentum);
  }
  double rigid = 0.5 * dot(momentum, momentum) / mass;
  const PrincipalAxes principal = principal_axes(inertia);
  const double largest = std::max({principal.values.x, principal.values.y, principal.values.z});
  for (std::size_t i = 0; i < 3; ++i) {
    const double along = dot(principal.axes.column(i), angular_momentum);
    if (principal.values[i] > 1e-12 * largest) rigid += 0.5 * along * along / principal.values[i];
  }
  energy.distortional = std::max(0.0, energy.total - rigid);
  return energy;
}

void RelaxationWatch::add(const MotionEnergy& energy) {
  recent_.total = std::max(recent_.total, energy.total);
  recent_.distortional = std::max(recent_.distortional, energy.distortional);
  if (++cycles_ % control_.check != 0) return;
  largest_.total = std::max(largest_.total, recent_.total);
  largest_.distortional = std::max(largest_.distortional, recent_.distortional);
  const bool distorts = largest_.distortional > 1e-6 * largest_.total;
  const double now = distorts ? recent_.distortional : recent_.total;
  const double most = distorts ? largest_.distortional : largest_.total;
  ratio_ = most > 0 ? now / most : 0;
  at_rest_ = ratio_ < control_.tolerance;
  recent_ = {};
}

void Solver::relax() {
  const DynamicRelaxation& control = model_.control.relaxation;
  if (!state_.clock.relaxing) {
    scale_velocities(state_, 0.0);
    state_.clock.relaxing = 1;
  }
  clear_forces();  // of all nodes at first
  looked_at_ = false;
  loads_->apply(model_, state_);
  walls_->apply(model_, state_, nodes_->fastest());
  ties_->apply(model_, state_);
  elements_->internal_forces(model_, state_);
  choose_time_step(*relaxation_rule_);
  contact();
  scale_velocities(state_, control.factor);
  kick();
  RelaxationWatch& watch = relaxation_->watch;
  watch.add(motion_energy(state_));
  if (watch.at_rest() || state_.clock.time >= control.end_time || stop_requested_.load(std::memory_order_relaxed))
    return end_relaxation();  // not drifted: stresses and positions agree
  rigid_->drift(model_, state_);
  nodes_->drift(state_);
  ties_->drift(state_);
  relaxation_->hand.advance(state_.clock, control.end_time);
}

void Solver::end_relaxation() {
  const RelaxationWatch& watch = relaxation_->watch;
  spdlog::info("dynamic relaxation: {} after {} cycles, kinetic energy {:.3g} of its largest", watch.at_rest() ? "at rest" : "ended",
               watch.cycles(), watch.ratio());
  relaxation_pending_ = false;
  looked_at_ = true;
  state_.clock = Clock{};
  state_.energy.external_work = 0;
  contacts_->restart(state_);
  relaxation_->initial.restore(state_);
  loads_->restart(model_, state_);
  walls_->restart();
  ties_->restart();
}

}  // namespace kardan

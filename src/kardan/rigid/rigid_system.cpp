#include "kardan/rigid/rigid_system.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "kardan/rigid/body_assembly.hpp"
#include "kardan/rigid/body_motions.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/exact_joints.hpp"
#include "kardan/rigid/initial_velocities.hpp"
#include "kardan/rigid/joint_set.hpp"
#include "kardan/rigid/joint_setup.hpp"
#include "kardan/rigid/joint_stiffness.hpp"
#include "kardan/rigid/motors.hpp"
#include "kardan/rigid/node_resultants.hpp"
#include "kardan/rigid/penalty_joints.hpp"

namespace kardan {

struct RigidSystem::Impl {
  JointHolding holding = JointHolding::exact;
  BodyAssembly assembly;
  BodySet bodies;
  BodyMotions motions;
  JointSet joints;
  Motors motors;
  JointFailure failure;
  ExactJoints exact;
  PenaltyJoints penalty;
  JointStiffnesses stiffness;
  std::vector<std::size_t> needed;        ///< into assembly.nodes: nodes kept current every cycle
  std::vector<NodeIndex> needed_node;
  std::vector<BodyIndex> needed_body;
  bool needed_listed = false;
  std::vector<double> acting;             ///< see acting_forces(); empty where the rows' forces are unique
  double reported_work = 0;               ///< of motions and motors, already in the ledger

  void list_needed(const State& state);
  void set_trial(const State& state);
  void solve_joints(const Model& model, State& state);
  void find_first_joint_forces(const Model& model, const State& state);
  void check_rotation(const State& state) const;
  void take_velocities(State& state);  ///< of bodies and needed nodes, at t_{n+1/2}
  void fill_body_reports(State& state) const;
  const std::vector<double>& row_forces() const { return holding == JointHolding::exact ? exact.force : penalty.force; }
  /// Forces by which joints fail and rub: shared among redundant rows.
  const std::vector<double>& acting_forces() const { return acting.empty() ? row_forces() : acting; }
  void share_forces();
  const JointSeparation& separation() const { return holding == JointHolding::exact ? exact.largest : penalty.largest; }
};

RigidSystem::RigidSystem(const Model& model, State& state, JointHolding holding, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>()) {
  Impl& s = *impl_;
  s.holding = holding;
  s.assembly = assemble_bodies(model, state, diagnostics);
  const std::size_t n = state.bodies.info.size();
  state.bodies.report.assign(n, {});
  state.bodies.force.assign(n, {});
  state.bodies.moment.assign(n, {});
  s.bodies.initialise(state, s.motions.initialise(model, state, s.assembly, diagnostics));
  setup_joints(model, state, s.joints, diagnostics);
  s.joints.analyse(s.bodies);
  s.motors.initialise(model, s.joints, diagnostics);
  s.failure.initialise(model, s.joints);
  s.stiffness.initialise(model, state, s.joints, diagnostics);
  s.exact.initialise(s.joints);
  s.penalty.initialise(model, s.joints, diagnostics);
  state.joints.assign(model.joints.size(), {});

  state.registry.add({"joints.force", "force or moment", "rigid.kick"},
                     holding == JointHolding::exact ? s.exact.force : s.penalty.force);
  state.registry.add_value({"rigid.reported_work", "energy", "rigid.account"}, s.reported_work);
  s.motions.register_state(state);
  s.motors.register_state(state);
  s.stiffness.register_state(state);
  s.bodies.register_state(state.registry);
  s.joints.register_state(state.registry);
  s.exact.register_state(state.registry);
  s.penalty.register_state(state.registry);
  state.registry.keep_list({"joints.acting_force", "force or moment", "rigid.kick"}, s.acting);
}

RigidSystem::~RigidSystem() = default;
RigidSystem::RigidSystem(RigidSystem&&) noexcept = default;
RigidSystem& RigidSystem::operator=(RigidSystem&&) noexcept = default;

void RigidSystem::set_initial_velocities(const Model& model, State& state, Diagnostics& diagnostics) {
  Impl& s = *impl_;
  const BodyNodes& nodes = s.assembly.nodes;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) s.bodies.rotation[b] = to_matrix(state.bodies.motion[b].orientation);
  initial_body_velocities(model, state, s.assembly, diagnostics);

  // Prescribed motions, then the joints, at t = 0.
  s.motions.prescribe(model, state, s.bodies, true);
  double before = 0, after = 0;
  const auto kinetic = [&](std::size_t b, const Vec3& v, const Vec3& w) {
    return 0.5 * state.bodies.info[b].mass * dot(v, v) + 0.5 * dot(w, s.bodies.inertia_times(b, w));
  };
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    s.bodies.update_mobility(b);
    const BodyMotion& m = state.bodies.motion[b];
    s.bodies.trial[b].velocity = m.velocity;
    s.bodies.trial[b].angular_momentum = s.bodies.inertia_times(b, m.angular_velocity);
    s.bodies.advance(state, b, 0.0);
    before += kinetic(b, s.bodies.trial[b].constrained_velocity, s.bodies.trial[b].angular_velocity);
  }
  if (!s.joints.joints.empty()) {
    find_redundant_joints(model, state, s.joints, s.bodies, s.exact, diagnostics);
    std::vector<double> rates(s.joints.total_rows, 0.0);
    s.motors.initial_rates(model, state, s.joints, rates);
    s.exact.project_velocities(state, s.joints, s.bodies, rates);
  }
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    s.bodies.advance(state, b, 0.0);
    BodyMotion& m = state.bodies.motion[b];
    m.velocity = s.bodies.trial[b].constrained_velocity;
    m.angular_velocity = s.bodies.trial[b].angular_velocity;
    m.angular_momentum = s.bodies.inertia_times(b, m.angular_velocity);
    after += kinetic(b, m.velocity, m.angular_velocity);
  }
  state.energy.initial_joint_loss = before - after;
  if (std::abs(before - after) > 1e-9 * before)
    diagnostics.notice(fmt::format("initial velocities contradict the joints: they were brought into agreement by impulses in the "
                                   "joints, kinetic energy {:.9g} -> {:.9g}", before, after), "*INITIAL_VELOCITY");
  s.list_needed(state);
  for (std::size_t k = 0; k < s.needed.size(); ++k) {
    const BodyMotion& m = state.bodies.motion[s.needed_body[k]];
    const Vec3 r = s.bodies.rotation[s.needed_body[k]] * nodes.arm[s.needed[k]];
    state.nodes.v[s.needed_node[k]] = m.velocity + cross(m.angular_velocity, r);
    state.nodes.omega[s.needed_node[k]] = m.angular_velocity;
  }
}

double RigidSystem::stable_time_step(const State& state) const {
  double fastest = 0;
  for (const BodyMotion& m : state.bodies.motion) fastest = std::max(fastest, norm(m.angular_velocity));
  return fastest > 0 ? 0.5 / fastest : std::numeric_limits<double>::infinity();
}

double RigidSystem::default_time_step(const Model& model, const State& state) const {
  const double by_rotation = 0.02 * stable_time_step(state);
  return std::min(model.control.termination.end_time / 20000.0, by_rotation);
}

void RigidSystem::Impl::list_needed(const State& state) {
  needed.clear();
  needed_node.clear();
  needed_body.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t i = assembly.nodes.first[b]; i < assembly.nodes.first[b + 1]; ++i)
      if (state.nodes.needed[assembly.nodes.node[i]]) {
        needed.push_back(i);
        needed_node.push_back(assembly.nodes.node[i]);
        needed_body.push_back(static_cast<BodyIndex>(b));
      }
  needed_listed = true;
}

void RigidSystem::Impl::set_trial(const State& state) {
  const double kick = state.clock.kick();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyMotion& m = state.bodies.motion[b];
    BodyTrial& t = bodies.trial[b];
    t.velocity = m.velocity + state.bodies.force[b] * (kick * bodies.inverse_mass(b));
    t.angular_momentum = m.angular_momentum + state.bodies.moment[b] * kick;
  }
}

void RigidSystem::Impl::find_first_joint_forces(const Model& model, const State& state) {
  // Friction at t = 0 needs the joints' forces before there are any: those of a kick without it.
  if (holding != JointHolding::exact) return;
  set_trial(state);
  motions.prescribe(model, state, bodies, false);
  for (std::size_t b = 0; b < bodies.size(); ++b) bodies.update_mobility(b);
  joints.linearise(state, bodies);
  exact.solve(model, state, joints, bodies, state.clock.kick(), state.clock.dt);
  share_forces();
}

void RigidSystem::Impl::share_forces() {
  acting.clear();  // the redundancy may be gone
  const bool asked = failure.watches() || stiffness.asks_for_joint_forces();
  if (!asked || holding != JointHolding::exact || !joints.has_redundant_rows()) return;
  acting = exact.shared_forces(joints, bodies);
}

void RigidSystem::Impl::check_rotation(const State& state) const {
  const double limit = 1.0 / (state.clock.dt * state.clock.dt);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyTrial& t = bodies.trial[b];
    // Not-a-number in either sum fails the comparison too.
    if (dot(t.angular_velocity, t.angular_velocity) <= limit && dot(t.center, t.center) < 1e300) continue;
    const Vec3& x = state.bodies.motion[b].center;
    throw RunError(fmt::format("body {} at ({:.6g}, {:.6g}, {:.6g}) turns by {:.3g} rad in one step of {:.3g} at t = {:.6g} (velocity "
                               "{:.4g}, angular velocity {:.4g}): the time step is too long, or a force has gone wild",
                               state.bodies.info[b].id, x.x, x.y, x.z, norm(t.angular_velocity) * state.clock.dt,
                               state.clock.dt, state.clock.time, norm(t.velocity), norm(t.angular_velocity)));
  }
}

void RigidSystem::Impl::solve_joints(const Model& model, State& state) {
  const double kick = state.clock.kick(), h = state.clock.dt;
  // Only the matrix of the joints asks for the response of free bodies; penalty joints refresh it now and then.
  const bool matrix_wanted = holding == JointHolding::exact ? !joints.joints.empty() : penalty.refresh_due(h);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (matrix_wanted || bodies.mobility[b].constraint != none) bodies.update_mobility(b);
  if (joints.joints.empty()) {
    for (std::size_t b = 0; b < bodies.size(); ++b) bodies.advance(state, b, h);
    return;
  }
  joints.linearise(state, bodies);
  if (holding == JointHolding::exact) {
    motors.aim(model, state, joints, true);
    exact.solve(model, state, joints, bodies, kick, h);
  } else {
    motors.aim(model, state, joints, false);
    penalty.apply(state, joints, bodies, kick, h);
    for (std::size_t b = 0; b < bodies.size(); ++b) bodies.advance(state, b, h);
  }
}

void RigidSystem::Impl::take_velocities(State& state) {
  const double h = state.clock.dt;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyMotion& m = state.bodies.motion[b];
    BodyTrial& t = bodies.trial[b];
    const Vec3 momentum = bodies.angular_momentum_after(b, h);
    // The trial keeps the velocities at t_{n-1/2}, which the reports at t_n need.
    t.velocity = m.velocity;
    t.angular_momentum = m.angular_momentum;
    m.velocity = t.constrained_velocity;
    m.angular_momentum = momentum;
    std::swap(m.angular_velocity, t.angular_velocity);
  }
  // Eqs. (9) and (12): velocities of nodes from the positions at both ends of the step.
  for (std::size_t k = 0; k < needed.size(); ++k) {
    const NodeIndex n = needed_node[k];
    const BodyTrial& t = bodies.trial[needed_body[k]];
    state.nodes.v[n] = (t.center + t.rotation * assembly.nodes.arm[needed[k]] - state.nodes.x[n]) / h;
    state.nodes.omega[n] = state.bodies.motion[needed_body[k]].angular_velocity;
  }
}

void RigidSystem::Impl::fill_body_reports(State& state) const {
  const double kick = state.clock.kick(), share = state.clock.share_before();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyMotion& after = state.bodies.motion[b];
    const BodyTrial& before = bodies.trial[b];
    BodyReport& r = state.bodies.report[b];
    r.velocity = before.velocity + (after.velocity - before.velocity) * share;
    if (bodies.mobility[b].constraint != none) {
      r.angular_velocity = before.angular_velocity + (after.angular_velocity - before.angular_velocity) * share;
    } else {
      const Vec3 momentum = before.angular_momentum + (after.angular_momentum - before.angular_momentum) * share;
      r.angular_velocity = bodies.inverse_inertia_times(b, momentum);
    }
    r.acceleration = (after.velocity - before.velocity) / kick;
    r.angular_acceleration = (after.angular_velocity - before.angular_velocity) / kick;
    r.force = state.bodies.force[b];
    r.moment = state.bodies.moment[b];
  }
}

void RigidSystem::gather_forces(State& state) const { add_node_resultants(state, impl_->needed_node, impl_->needed_body); }

void RigidSystem::kick(const Model& model, State& state) {
  Impl& s = *impl_;
  KARDAN_ASSERT(s.needed_listed);
  if (state.clock.cycle == 0 && s.stiffness.asks_for_joint_forces()) s.find_first_joint_forces(model, state);
  s.stiffness.apply(model, state, s.bodies, s.joints, s.acting_forces());
  s.set_trial(state);
  s.motions.prescribe(model, state, s.bodies, false);
  s.solve_joints(model, state);
  s.check_rotation(state);
  s.motions.account(model, state, s.bodies);
  s.motors.account(s.joints, s.row_forces(), state.clock);
  s.share_forces();
  for (Index j : s.failure.check(model, state, s.joints, s.bodies, s.acting_forces()))
    spdlog::info("joint {} ({}) fails at t = {:.6g}", model.joints[j].id, to_string(model.joints[j].kind), state.clock.time);
  s.take_velocities(state);
}

void RigidSystem::drift(const Model&, State& state) {
  Impl& s = *impl_;
  s.joints.remember_step(state, s.bodies, state.clock.dt);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    BodyMotion& m = state.bodies.motion[b];
    const BodyTrial& t = s.bodies.trial[b];
    m.center = t.center;
    m.orientation = t.orientation;
    s.bodies.rotation[b] = t.rotation;
  }
  for (std::size_t k = 0; k < s.needed.size(); ++k) {
    const BodyTrial& t = s.bodies.trial[s.needed_body[k]];
    state.nodes.x[s.needed_node[k]] = t.center + t.rotation * s.assembly.nodes.arm[s.needed[k]];
  }
}

void RigidSystem::update_reports(const Model&, State& state) const {
  const Impl& s = *impl_;
  const BodyNodes& nodes = s.assembly.nodes;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const BodyMotion& m = state.bodies.motion[b];
    const BodyReport& report = state.bodies.report[b];
    const Mat3 rotation = to_matrix(m.orientation);
    for (std::size_t i = nodes.first[b]; i < nodes.first[b + 1]; ++i) {
      const NodeIndex n = nodes.node[i];
      const Vec3 r = rotation * nodes.arm[i];
      state.nodes.x[n] = m.center + r;
      state.nodes.v_now[n] = report.velocity + cross(report.angular_velocity, r);
      state.nodes.a[n] = report.acceleration + cross(report.angular_acceleration, r) +
                         cross(report.angular_velocity, cross(report.angular_velocity, r));
      if (state.nodes.needed[n]) continue;
      state.nodes.v[n] = m.velocity + cross(m.angular_velocity, r);
      state.nodes.omega[n] = m.angular_velocity;
    }
  }
  const std::vector<double> forces =
      s.holding == JointHolding::exact ? s.exact.shared_forces(s.joints, s.bodies) : s.penalty.force;
  double c[6];
  for (std::size_t j = 0; j < s.joints.joints.size(); ++j) {
    const Index index = s.joints.joints[j].model_joint;
    JointReport& report = state.joints[index];
    std::tie(report.force, report.moment) = s.joints.resultant(s.bodies, j, forces.data() + s.joints.offset[j]);
    s.joints.residual_now(state, s.bodies, j, c);
    std::tie(report.separation, report.angular_separation) = s.joints.separation(j, c);
    report.energy = s.holding == JointHolding::penalty ? s.penalty.stored[j] + s.penalty.dissipated[j] : 0.0;
    report.failed = s.joints.failed[j];
  }
}

void RigidSystem::account_work(State& state) {
  Impl& s = *impl_;
  const double work = s.motions.work(state.clock) + s.motors.work(state.clock);
  state.energy.external_work += work - s.reported_work;
  s.reported_work = work;
}

void RigidSystem::account(const Model&, State& state) {
  Impl& s = *impl_;
  s.fill_body_reports(state);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const BodyReport& r = state.bodies.report[b];
    const BodyInfo& info = state.bodies.info[b];
    const double kinetic = 0.5 * info.mass * dot(r.velocity, r.velocity) +
                           0.5 * dot(r.angular_velocity, s.bodies.inertia_times(b, r.angular_velocity));
    state.energy.kinetic += kinetic;
    const Vec3 step = r.force * state.clock.dt;
    state.energy.resolution += 0.5 * dot(step, step) / info.mass;
    if (info.part != none) state.energy.part_kinetic[info.part] += kinetic;
  }
  for (std::size_t j = 0; j < s.joints.joints.size(); ++j)
    if (s.holding == JointHolding::penalty) state.energy.joint += s.penalty.stored[j] + s.penalty.dissipated[j];
  state.energy.joint += s.stiffness.energy(state);
  state.energy.stopper += s.motions.stopper_energy();
}

RigidSystem::Separation RigidSystem::largest_separation() const {
  const JointSeparation& largest = impl_->separation();
  return {largest.distance, largest.angle, largest.joint};
}

}  // namespace kardan

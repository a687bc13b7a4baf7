#include "kardan/solver/solver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kardan/contact/contact_system.hpp"
#include "kardan/contact/rigid_wall.hpp"
#include "kardan/contact/tied.hpp"
#include "kardan/elements/element_system.hpp"
#include "kardan/loads/load_system.hpp"
#include "kardan/solver/node_mover.hpp"
#include "kardan/solver/relaxation.hpp"

namespace kardan {

namespace {

template <class Block>
std::int64_t count_deformable(const Model& model, const Block& block) {
  return std::count_if(block.part.begin(), block.part.end(), [&](PartIndex p) { return !model.rigid_part(p); });
}

TimeStepOwner owner_of(const Governing& governing) {
  using Kind = TimeStepOwner::Kind;
  static constexpr Kind kinds[] = {Kind::shell, Kind::solid, Kind::beam, Kind::discrete};  // by ElementKind
  return {kinds[static_cast<int>(governing.kind)], governing.element, 0};
}

/// Upper bound of the free nodes' speeds after the damping, from the largest before and after the kick. Damping of nodes makes each
/// component of a velocity a sum of those two with weights that make up one in magnitude; relative damping adds the motion of a body.
double speed_bound(const Model& model, double before, double after) {
  const bool relative = std::any_of(model.dampings.begin(), model.dampings.end(), [](const DampingLaw& d) { return d.relative_to != none; });
  if (relative) return std::numeric_limits<double>::infinity();
  return model.dampings.empty() && model.non_reflecting.empty() ? after : std::hypot(before, after);
}

}  // namespace

HoldingChoice joint_holding(const Model& model, std::optional<JointHolding> given) {
  if (given)
    return {*given, fmt::format("joints: {} (--joints)", *given == JointHolding::exact ? "exact" : "penalty")};
  switch (model.control.rigid.lmf) {
    case 1:
      return {JointHolding::exact, "joints: exact (*CONTROL_RIGID LMF = 1)"};
    case 0:
      return {JointHolding::penalty,
              "joints: penalty (*CONTROL_RIGID LMF = 0); LMF = 1, a blank field or --joints exact hold them exactly"};
    default:
      return {JointHolding::exact, "joints: exact (Kardan's default)"};
  }
}

Solver::Solver(const Model& model, const SolverOptions& options, Diagnostics& diagnostics) : model_(model) {
  timers_.start();
  omp_set_num_threads(std::max(1, options.threads));
  end_time_ = options.end_time.value_or(model.control.termination.end_time);
  set_up(options, diagnostics);
  if (!diagnostics.ok()) throw InputError(diagnostics);
  register_state();
  timers_.lap(Phase::setup);
}

Solver::~Solver() = default;

void Solver::set_up(const SolverOptions& options, Diagnostics& diagnostics) {
  if (!(end_time_ > 0))
    diagnostics.error("the run has no end time", "give ENDTIM > 0, or --end on the command line", "*CONTROL_TERMINATION");
  if (options.dt && !(*options.dt > 0)) diagnostics.error("the time step of --dt must be positive");

  state_.nodes.resize(model_.nodes.size());
  state_.nodes.x = model_.nodes.x;
  elements_ = std::make_unique<ElementSystem>(model_, state_, diagnostics);
  const HoldingChoice choice = joint_holding(model_, options.joints);
  if (!model_.joints.empty()) diagnostics.notice(choice.reason);
  rigid_ = std::make_unique<RigidSystem>(model_, state_, choice.holding, diagnostics);
  if (!diagnostics.ok()) return;
  ties_ = std::make_unique<TiedContacts>(model_, state_, diagnostics);
  LoadSystem::set_initial_velocities(model_, state_, diagnostics);
  loads_ = std::make_unique<LoadSystem>(model_, state_, diagnostics);  // takes out velocities against supports
  contacts_ = std::make_unique<ContactSystem>(model_, state_, *ties_, diagnostics);
  if (!diagnostics.ok()) return;
  ties_->size_reports(model_, state_);
  ties_->take_masses(state_);
  rigid_->set_initial_velocities(model_, state_, diagnostics);
  walls_ = std::make_unique<RigidWalls>(model_, state_, diagnostics);
  nodes_ = std::make_unique<NodeMover>(model_, state_);
  ties_->follow(state_);

  for (std::size_t i = 0; i < state_.nodes.x.size(); ++i) {
    const bool attached = state_.nodes.body[i] != none;
    if (attached && !state_.nodes.needed[i]) continue;
    summed_nodes_.push_back(static_cast<NodeIndex>(i));
    if (attached || !(state_.nodes.mass[i] > 0)) summed_not_kicked_.push_back(static_cast<NodeIndex>(i));
  }
  const std::int64_t deformable = count_deformable(model_, model_.shells) + count_deformable(model_, model_.solids) +
                                  count_deformable(model_, model_.beams);
  elements_processed_ = deformable + static_cast<std::int64_t>(model_.discretes.size());
  StepFacts facts;
  facts.deformable = deformable > 0;
  facts.rigid_elements = {elements_->rigid_courant_time_step(model_, state_), {}, "rigid elements"};
  facts.rigid_default = rigid_->default_time_step(model_, state_);
  rule_ = std::make_unique<TimeStepRule>(model_, facts, options.dt, end_time_);
  relaxation_pending_ = model_.control.relaxation.on;
  if (relaxation_pending_) {
    relaxation_ = std::make_unique<Relaxation>(model_.control.relaxation, state_);
    relaxation_rule_ = std::make_unique<TimeStepRule>(model_, facts, options.dt, model_.control.relaxation.end_time,
                                                      model_.control.relaxation.step_scale);
  }
  diagnostics.notice(rule_->reason());
}

void Solver::register_state() {
  Registry& registry = state_.registry;
  Clock& clock = state_.clock;
  registry.add_value({"clock.cycle", "1", "solver"}, clock.cycle);
  registry.add_value({"clock.time", "time", "solver"}, clock.time);
  registry.add_value({"clock.carry", "time", "solver"}, clock_hand_.carry());
  registry.add_value({"clock.dt", "time", "solver"}, clock.dt);
  registry.add_value({"clock.dt_previous", "time", "solver"}, clock.dt_previous);
  registry.add({"nodes.x", "length", "nodes.drift, rigid.drift"}, state_.nodes.x);
  registry.add({"nodes.v", "length/time", "nodes.kick, rigid.drift"}, state_.nodes.v);
  registry.add({"nodes.omega", "1/time", "nodes.kick, rigid.drift"}, state_.nodes.omega);
  registry.add({"nodes.force", "force", "elements, loads"}, state_.nodes.force);
  registry.add({"nodes.moment", "force*length", "elements, loads"}, state_.nodes.moment);
  registry.add({"bodies.motion", "length, 1, length/time, mass*length^2/time", "rigid"}, state_.bodies.motion);
  registry.add_value({"energy.external_work", "energy", "loads, rigid"}, state_.energy.external_work);
  registry.keep_value({"energy.initial", "energy", "solver"}, state_.energy.initial);
  registry.keep({"welds", "mixed", "loads, elements"}, state_.welds);
  registry.keep_value({"solver.first_dt", "time", "solver"}, first_dt_);
  registry.keep_value({"solver.deleted", "1", "solver"}, deleted_);
  registry.keep_value({"clock.relaxing", "1", "solver"}, clock.relaxing);
  registry.keep_value({"solver.relaxation_pending", "1", "solver"}, relaxation_pending_);
  if (relaxation_) relaxation_->register_state(registry);
  if (!ties_->empty() && model_.control.time_step.dt2ms == 0) {  // ties that end give masses back; scaled masses are registered already
    registry.keep({"nodes.mass", "mass", "contact.drop_deleted"}, state_.nodes.mass);
    registry.keep({"nodes.inertia", "mass*length^2", "contact.drop_deleted"}, state_.nodes.inertia);
  }
  nodes_->register_state(model_, state_);
}

StopReason Solver::run() {
  while (step()) {
  }
  return stop_;
}

bool Solver::step() {
  if (stop_ != StopReason::running) return false;
  timers_.start();
  try {
    if (relaxation_pending_) {
      relax();
      return true;
    }
    clear_forces();
    loads_->apply(model_, state_);
    walls_->apply(model_, state_, nodes_->fastest());
    ties_->apply(model_, state_);
    timers_.lap(Phase::loads);
    elements_->internal_forces(model_, state_);
    take_masses();
    timers_.lap(Phase::elements);
    choose_time_step(*rule_);
    stop_ = reason_to_stop();
    find_due_observers();
    timers_.lap(Phase::time_step);
    contact();
    timers_.lap(Phase::contact);
    kick();
    if (looked_at_) {
      nodes_->settle(state_);
      ties_->settle(state_);
    }
    timers_.lap(Phase::nodes);
    account();
    timers_.lap(Phase::ledger);
  } catch (const RunError&) {
    stop_ = StopReason::broken;
    find_due_observers();
    nodes_->settle_broken(state_);
    notify();
    throw;
  }
  try {
    notify();
  } catch (const RunError&) {  // a result cannot be written
    stop_ = StopReason::broken;
    throw;
  }
  timers_.lap(Phase::observers);
  if (stop_ != StopReason::running) return false;
  rigid_->drift(model_, state_);
  timers_.lap(Phase::rigid);
  nodes_->drift(state_);
  ties_->drift(state_);
  clock_hand_.advance(state_.clock, end_time_);
  timers_.lap(Phase::nodes);
  return true;
}

void Solver::contact() {
  if (contacts_->empty() && ties_->empty()) return;
  if (const std::int64_t deleted = elements_->deleted(); deleted != deleted_) {
    deleted_ = deleted;
    const auto alive = [this](ElementKind kind, Index element) { return elements_->alive(kind, element); };
    if (ties_->drop_deleted(model_, state_, alive)) nodes_->sort(model_, state_);
    contacts_->drop_deleted(alive);
  }
  if (!contacts_->empty()) contacts_->apply(state_);
}

void Solver::kick() {
  const double fastest = nodes_->fastest();
  walls_->before_kick(state_, fastest);
  nodes_->kick(model_, state_, *elements_, looked_at_);
  const double after = std::max(nodes_->fastest(), ties_->transfer(state_));
  timers_.lap(Phase::nodes);
  rigid_->gather_forces(state_);
  loads_->damp(model_, state_);
  timers_.lap(Phase::loads);
  rigid_->kick(model_, state_);
  timers_.lap(Phase::rigid);
  walls_->hold(model_, state_, speed_bound(model_, fastest, after));
  loads_->constrain_velocities(model_, state_);
  ties_->follow(state_);
}

/// Mass scaling: also of nodes that are tied to segments, whose mass the segments carry.
void Solver::take_masses() {
  const std::vector<NodeIndex>& changed = elements_->scale_masses(model_, state_);
  if (changed.empty()) return;
  nodes_->take_masses(state_, changed);
  nodes_->take_masses(state_, ties_->pass_on_masses(state_));
}

void Solver::clear_forces() {
  // After a cycle that nobody looked at the free nodes have been cleared already.
  for (NodeIndex node : looked_at_ ? summed_nodes_ : summed_not_kicked_)
    state_.nodes.force[static_cast<std::size_t>(node)] = state_.nodes.moment[static_cast<std::size_t>(node)] = {};
  for (std::vector<Vec3>* sums : {&state_.bodies.force, &state_.bodies.moment})
    std::fill(sums->begin(), sums->end(), Vec3{});
}

void Solver::choose_time_step(const TimeStepRule& rule) {
  StepBound stable;
  stable.dt = elements_->stable_time_step();
  if (std::isfinite(stable.dt)) stable.owner = owner_of(elements_->governing());
  step_ = rule.next(model_, state_.clock, stable, rigid_->stable_time_step(state_));
  if (!(step_.dt > 0) || !std::isfinite(step_.dt))
    throw RunError(fmt::format("time step {:g} (set by {}) at t = {:g}, cycle {}", step_.dt, to_string(step_),
                               state_.clock.time, state_.clock.cycle));
  state_.clock.dt = step_.dt;
  state_.step_owner = step_.owner;
  if (state_.clock.cycle > 0) return;
  first_dt_ = step_.dt;
  const TimeStepControl& control = model_.control.time_step;
  if (control.erode > 0) elements_->erode_below(model_.control.termination.dt_min * first_dt_ / (control.scale > 0 ? control.scale : 0.9));
}

void Solver::account() {
  EnergyLedger& energy = state_.energy;
  const double end_energy = model_.control.termination.end_energy;
  // Work is summed every cycle; the energies at t_n only where somebody looks at them.
  if (looked_at_) energy.begin(model_.parts.size());
  loads_->account(model_, state_);
  rigid_->account_work(state_);
  walls_->close_kick(state_);
  ties_->account(state_);
  if (!looked_at_) return;
  elements_->account(model_, state_);
  rigid_->account(model_, state_);
  contacts_->account(state_);
  ties_->report(state_);
  walls_->account(state_);
  nodes_->account(state_);
  if (state_.clock.cycle == 0) energy.initial = energy.total();
  if (end_energy > 0 && stop_ == StopReason::running && std::abs(energy.ratio() - 1) * 100 > end_energy) {
    stop_ = StopReason::energy;
    find_due_observers();
  }
}

StopReason Solver::reason_to_stop() const {
  const Termination& termination = model_.control.termination;
  if (state_.clock.time >= end_time_) return StopReason::end_time;
  if (termination.end_cycle > 0 && state_.clock.cycle >= termination.end_cycle) return StopReason::end_cycle;
  if (state_.added_mass.percent() > termination.end_mass) return StopReason::mass;
  if (!step_.to_end && state_.clock.dt < termination.dt_min * first_dt_) return StopReason::min_step;
  if (stop_requested_.load(std::memory_order_relaxed)) return StopReason::interrupted;
  return StopReason::running;
}

StepView Solver::view() const { return {step_, timers_, end_time_, stop_, elements_processed_}; }

void Solver::find_due_observers() {
  const StepView now = view();
  due_.clear();
  for (Observer* observer : observers_)
    if (now.last() || observer->due(state_, now)) due_.push_back(observer);
  looked_at_ = !due_.empty() || state_.clock.cycle == 0 || now.last() || model_.control.termination.end_energy > 0;
}

void Solver::notify() {
  const StepView now = view();
  bool reports_current = false;
  const auto looks_at_elements = [&](const Observer* observer) { return observer->reads_elements(state_, now); };
  if (std::any_of(due_.begin(), due_.end(), looks_at_elements)) elements_->report(model_, state_);
  for (Observer* observer : due_) {
    if (!reports_current && observer->reads_nodes()) {
      rigid_->update_reports(model_, state_);
      reports_current = true;
    }
    observer->at(model_, state_, now);
  }
}

}  // namespace kardan

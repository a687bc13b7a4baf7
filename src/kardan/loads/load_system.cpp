#include "kardan/loads/load_system.hpp"

#include "kardan/loads/body_forces.hpp"
#include "kardan/loads/common_motions.hpp"
#include "kardan/loads/damping.hpp"
#include "kardan/loads/node_constraints.hpp"
#include "kardan/loads/non_reflecting.hpp"
#include "kardan/loads/point_forces.hpp"
#include "kardan/loads/pressure_loads.hpp"
#include "kardan/loads/rigid_groups.hpp"
#include "kardan/loads/taken_dofs.hpp"
#include "kardan/loads/velocity_ties.hpp"
#include "kardan/state/work_meter.hpp"

namespace kardan {

struct LoadSystem::Impl {
  Impl(const Model& model, State& state, Diagnostics& diagnostics)
      : body_forces(model, state, diagnostics),
        point_forces(model, state, diagnostics),
        pressure_loads(model, state, diagnostics),
        damping(model, state, diagnostics),
        non_reflecting(model, state, diagnostics),
        constraints(model, state, diagnostics),
        taken(model),
        common_motions(model, state, taken, diagnostics),
        rigid_groups(model, state, taken, diagnostics),
        ties(model, state, taken, diagnostics) {
    state.registry.add_value({"loads.work", "energy", "loads.account"}, meter);
    state.registry.add_value({"loads.outflow", "energy", "loads.account"}, outflow);
    state.registry.add_value({"loads.counted_work", "energy", "loads.account"}, counted);
    if (diagnostics.ok()) tie_nodes(model, state);  // initial velocities against ties go before the first energy is counted
  }

  void tie_nodes(const Model& model, State& state) {
    common_motions.impose(model, state);
    rigid_groups.impose(model, state);
    ties.impose(model, state);
  }

  BodyForces body_forces;
  PointForces point_forces;
  PressureLoads pressure_loads;
  Damping damping;
  NonReflecting non_reflecting;
  NodeConstraints constraints;
  TakenDofs taken;
  CommonMotions common_motions;
  RigidGroups rigid_groups;
  VelocityTies ties;
  WorkMeter meter, outflow;
  double counted = 0;  ///< what of state.energy.external_work came from here
};

LoadSystem::LoadSystem(const Model& model, State& state, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(model, state, diagnostics)) {}
LoadSystem::~LoadSystem() = default;
LoadSystem::LoadSystem(LoadSystem&&) noexcept = default;
LoadSystem& LoadSystem::operator=(LoadSystem&&) noexcept = default;

void LoadSystem::apply(const Model& model, State& state) {
  impl_->constraints.before_kick(state);
  impl_->damping.before_kick(state);
  impl_->non_reflecting.before_kick(state);
  double power = impl_->body_forces.apply(model, state);
  power += impl_->point_forces.apply(model, state);
  power += impl_->pressure_loads.apply(model, state);
  impl_->meter.before(power);
}

void LoadSystem::damp(const Model& model, State& state) {
  impl_->damping.apply(model, state);
  impl_->outflow.before(impl_->non_reflecting.apply(state));
}

void LoadSystem::constrain_velocities(const Model& model, State& state) {
  impl_->tie_nodes(model, state);
  impl_->constraints.impose(model, state);
}

void LoadSystem::account(const Model&, State& state) {
  const Impl& s = *impl_;
  const double power = s.body_forces.power(state) + s.point_forces.power(state) + s.pressure_loads.power(state);
  double work = impl_->meter.after(power, state.clock) + impl_->constraints.account(state);
  work += impl_->outflow.after(s.non_reflecting.power(state), state.clock);
  state.energy.external_work += work - impl_->counted;
  impl_->counted = work;
  impl_->damping.account(state);
}

void LoadSystem::restart(const Model& model, State& state) {
  impl_->meter = impl_->outflow = WorkMeter{};
  impl_->counted = 0;
  impl_->damping.restart();
  impl_->constraints.restart();
  impl_->tie_nodes(model, state);
}

}  // namespace kardan

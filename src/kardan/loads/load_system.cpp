#include "kardan/loads/load_system.hpp"

#include "kardan/loads/body_forces.hpp"
#include "kardan/loads/node_constraints.hpp"
#include "kardan/loads/point_forces.hpp"
#include "kardan/loads/pressure_loads.hpp"
#include "kardan/loads/work_meter.hpp"

namespace kardan {

struct LoadSystem::Impl {
  Impl(const Model& model, State& state, Diagnostics& diagnostics)
      : body_forces(model, state, diagnostics),
        point_forces(model, state, diagnostics),
        pressure_loads(model, state, diagnostics),
        constraints(model, state, diagnostics) {
    state.registry.add_value({"loads.work", "energy", "loads.account"}, meter);
    state.registry.add_value({"loads.counted_work", "energy", "loads.account"}, counted);
  }

  BodyForces body_forces;
  PointForces point_forces;
  PressureLoads pressure_loads;
  NodeConstraints constraints;
  WorkMeter meter;
  double counted = 0;  ///< what of state.energy.external_work came from here
};

LoadSystem::LoadSystem(const Model& model, State& state, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(model, state, diagnostics)) {}
LoadSystem::~LoadSystem() = default;
LoadSystem::LoadSystem(LoadSystem&&) noexcept = default;
LoadSystem& LoadSystem::operator=(LoadSystem&&) noexcept = default;

void LoadSystem::apply(const Model& model, State& state) {
  impl_->constraints.before_kick(state);
  double power = impl_->body_forces.apply(model, state);
  power += impl_->point_forces.apply(model, state);
  power += impl_->pressure_loads.apply(model, state);
  impl_->meter.before(power);
}

void LoadSystem::constrain_velocities(const Model& model, State& state) { impl_->constraints.impose(model, state); }

void LoadSystem::account(const Model&, State& state) {
  const double power = impl_->body_forces.power(state) + impl_->point_forces.power(state) + impl_->pressure_loads.power(state);
  const double work = impl_->meter.after(power, state.clock) + impl_->constraints.account(state);
  state.energy.external_work += work - impl_->counted;
  impl_->counted = work;
}

}  // namespace kardan

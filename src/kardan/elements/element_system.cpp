#include "kardan/elements/element_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "kardan/elements/beam/beam_forces.hpp"
#include "kardan/elements/beam/discrete_beams.hpp"
#include "kardan/elements/discrete/discrete_forces.hpp"
#include "kardan/elements/geometry.hpp"
#include "kardan/elements/lumped_mass.hpp"
#include "kardan/elements/mass_scaling.hpp"
#include "kardan/elements/section_forces.hpp"
#include "kardan/elements/shell/shell_forces.hpp"
#include "kardan/elements/solid/solid_forces.hpp"

namespace kardan {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Longitudinal wave speed of a plate, a solid or a bar [length/time].
double plate_speed(const BulkProperties& m) {
  return std::sqrt(m.youngs_modulus / (m.density * (1 - m.poissons_ratio * m.poissons_ratio)));
}
double solid_speed(const BulkProperties& m) {
  const double nu = m.poissons_ratio;
  return std::sqrt(m.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * m.density));
}
double bar_speed(const BulkProperties& m) { return std::sqrt(m.youngs_modulus / m.density); }

}  // namespace

struct ElementSystem::Impl {
  Impl(const Model& model, State& state, Diagnostics& diagnostics)
      : shells(model, state, diagnostics),
        solids(model, state, diagnostics),
        beams(model, state, diagnostics),
        discrete_beams(model, state, diagnostics),
        discretes(model, state, diagnostics) {}

  /// f(TileElements&) for all elements that are tiled.
  template <class F>
  void for_each_tiles(F&& f) {
    for (TileElements* elements : shells.elements()) f(*elements);
    f(beams.elements());
    for (TileElements* elements : solids.elements()) f(*elements);
  }

  ShellForces shells;
  SolidForces solids;
  BeamForces beams;
  DiscreteBeams discrete_beams;
  DiscreteForces discretes;
  MassScaling mass_scaling;
  std::unique_ptr<SectionForces> sections;  ///< made once the elements are complete
};

ElementSystem::ElementSystem(const Model& model, State& state, Diagnostics& diagnostics) {
  add_lumped_masses(model, state, diagnostics);
  impl_ = std::make_unique<Impl>(model, state, diagnostics);
  if (diagnostics.ok()) {
    impl_->sections = std::make_unique<SectionForces>(
        model, std::array<std::vector<TileElements*>, 3>{impl_->shells.elements(), impl_->solids.elements(), {&impl_->beams.elements()}});
  }
  state.discretes.assign(model.discretes.size(), DiscreteReport{});
  state.results.beam.resize(model.beams.size());
  state.energy.part_internal.assign(model.parts.size(), 0.0);
  state.energy.part_hourglass.assign(model.parts.size(), 0.0);
  if (model.control.time_step.dt2ms == 0 || !diagnostics.ok()) return;
  impl_->mass_scaling.start(model, state);
  impl_->for_each_tiles([&](TileElements& elements) { elements.prepare_mass_scaling(state); });
}

ElementSystem::~ElementSystem() = default;
ElementSystem::ElementSystem(ElementSystem&&) noexcept = default;
ElementSystem& ElementSystem::operator=(ElementSystem&&) noexcept = default;

void ElementSystem::internal_forces(const Model& model, State& state) {
  impl_->shells.internal_forces(model, state);
  impl_->solids.internal_forces(model, state);
  impl_->beams.internal_forces(model, state);
  impl_->discrete_beams.internal_forces(model, state);
  impl_->discretes.internal_forces(model, state);
}

const std::vector<NodeIndex>& ElementSystem::scale_masses(const Model& model, State& state) {
  MassScaling& scaling = impl_->mass_scaling;
  scaling.clear();
  if (scaling.active(model, state)) {
    impl_->for_each_tiles([&](TileElements& elements) { scaling.scale(model, state, elements); });
  }
  return scaling.changed();
}

void ElementSystem::erode_below(double step) {
  impl_->for_each_tiles([step](TileElements& elements) { elements.erode_below(step); });
}

std::int64_t ElementSystem::deleted() const {
  return impl_->shells.deleted() + impl_->solids.deleted() + impl_->beams.elements().deleted();
}

bool ElementSystem::alive(ElementKind kind, Index element) const {
  const auto in = [element](const std::vector<TileElements*>& all) {
    return std::all_of(all.begin(), all.end(), [element](const TileElements* e) { return e->alive(element) > 0; });
  };
  if (kind == ElementKind::shell) return in(impl_->shells.elements());
  if (kind == ElementKind::solid) return in(impl_->solids.elements());
  return kind != ElementKind::beam || impl_->beams.elements().alive(element) > 0;
}

void ElementSystem::add_forces(State& state, NodeIndex begin, NodeIndex end) const {
  impl_->shells.add_forces(state, begin, end);
  impl_->solids.add_forces(state, begin, end);
  impl_->beams.add_forces(state, begin, end);
}

double ElementSystem::stable_time_step() const { return governing().time_step; }

Governing ElementSystem::governing() const {
  return std::min({impl_->shells.governing(), impl_->solids.governing(), impl_->beams.governing(), impl_->discrete_beams.governing(),
                   impl_->discretes.governing()},
                  [](const Governing& a, const Governing& b) { return a.time_step < b.time_step; });
}

double ElementSystem::rigid_courant_time_step(const Model& model, const State& state) const {
  double dt = unlimited;
  const auto each = [&](const auto& block, auto&& step) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      if (!model.rigid_part(block.part[e])) continue;
      const Part& part = model.parts[static_cast<std::size_t>(block.part[e])];
      const BulkProperties bulk = bulk_properties(model.materials[static_cast<std::size_t>(part.material)]);
      const double own = step(e, bulk);
      if (own > 0) dt = std::min(dt, own);  // NaN and 0: an element without stiffness, density or size limits nothing
    }
  };
  const int isdo = model.control.time_step.isdo;
  each(model.shells, [&](std::size_t e, const BulkProperties& m) {
    const auto& n = model.shells.nodes[e];
    return shell_length(gather_coordinates(state.nodes.x, n), is_triangle(n), isdo) / plate_speed(m);
  });
  each(model.solids, [&](std::size_t e, const BulkProperties& m) {
    const auto& n = model.solids.nodes[e];
    return solid_length(gather_coordinates(state.nodes.x, n), n) / solid_speed(m);
  });
  each(model.beams, [&](std::size_t e, const BulkProperties& m) {
    const auto x = gather_coordinates(state.nodes.x, std::array{model.beams.nodes[e][0], model.beams.nodes[e][1]});
    return norm(x[1] - x[0]) / bar_speed(m);
  });
  return dt;
}

void ElementSystem::report(const Model& model, State& state) const {
  impl_->shells.report(model, state);
  impl_->solids.report(state.results.solid);
}

void ElementSystem::account(const Model& model, State& state) {
  EnergyLedger& energy = state.energy;
  energy.spring_damper = impl_->discretes.energy();
  std::fill(energy.part_internal.begin(), energy.part_internal.end(), 0.0);
  std::fill(energy.part_hourglass.begin(), energy.part_hourglass.end(), 0.0);
  impl_->shells.add_energies(energy.part_internal, energy.part_hourglass);
  impl_->solids.add_energies(energy.part_internal, energy.part_hourglass);
  impl_->beams.add_energies(energy.part_internal, energy.part_hourglass);
  impl_->discrete_beams.add_energies(model, energy.part_internal);
  impl_->beams.report(state, state.results.beam);
  impl_->discrete_beams.report(state.results.beam);
  impl_->beams.report_welds(state);
  impl_->sections->report(model, state);
  energy.eroded_internal = impl_->shells.eroded_energy() + impl_->solids.eroded_energy() + impl_->beams.elements().eroded_energy();
  state.results.deleted_shells = impl_->shells.deleted();
  state.results.deleted_solids = impl_->solids.deleted();
  state.results.deleted_beams = impl_->beams.elements().deleted();
  energy.internal = std::accumulate(energy.part_internal.begin(), energy.part_internal.end(), 0.0);
  energy.hourglass = std::accumulate(energy.part_hourglass.begin(), energy.part_hourglass.end(), 0.0);
}

}  // namespace kardan

#include "kardan/elements/mass_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kardan/elements/lumped_mass.hpp"
#include "kardan/elements/tiles/tile_elements.hpp"

namespace kardan {

void MassScaling::start(const Model&, State& state) {
  state.added_mass.physical = std::accumulate(state.nodes.mass.begin(), state.nodes.mass.end(), 0.0);
  state.registry.add_value({"mass.added", "mass", "elements.scale_masses"}, state.added_mass.added);
  state.registry.add({"nodes.mass", "mass", "elements.scale_masses"}, state.nodes.mass);
  state.registry.keep({"nodes.inertia", "mass*length^2", "elements.scale_masses"}, state.nodes.inertia);
  state.registry.keep({"energy.part_mass", "mass", "elements.scale_masses"}, state.energy.part_mass);
}

bool MassScaling::active(const Model& model, const State& state) const {
  const TimeStepControl& control = model.control.time_step;
  return control.dt2ms != 0 && !(control.scale_mass_once && state.clock.cycle > 0);
}

void MassScaling::add(State& state, NodeIndex node, double mass, double inertia) {
  const auto n = static_cast<std::size_t>(node);
  if (state.nodes.body[n] != none) return;
  state.nodes.mass[n] += mass;
  state.nodes.inertia[n] += inertia;
  state.added_mass.added += mass;
  changed_.push_back(node);
  if (state.clock.cycle > 0) {
    const Vec3 &v = state.nodes.v[n], &omega = state.nodes.omega[n];
    state.energy.external_work += 0.5 * (mass * dot(v, v) + inertia * dot(omega, omega));
  }
}

void MassScaling::scale(const Model& model, State& state, TileElements& elements) {
  const double dt2ms = model.control.time_step.dt2ms;
  const auto raise = [&](const auto& block, Index element, double increase) {
    const auto e = static_cast<std::size_t>(element);
    const NodeShare share = node_share(model, elements.kind(), element);
    state.energy.part_mass[static_cast<std::size_t>(block.part[e])] += increase * share.mass * share.nodes;
    const auto& nodes = block.nodes[e];
    const auto end = elements.kind() == ElementKind::beam ? nodes.begin() + 2 : nodes.end();  // without the orientation node
    for (auto n = nodes.begin(); n != end; ++n) {
      if (std::find(nodes.begin(), n, *n) == n) add(state, *n, increase * share.mass, increase * share.inertia);
    }
  };
  elements.scale_masses(std::abs(dt2ms), dt2ms > 0, [&](Index element, double increase) {
    if (elements.kind() == ElementKind::shell) raise(model.shells, element, increase);
    if (elements.kind() == ElementKind::solid) raise(model.solids, element, increase);
    if (elements.kind() == ElementKind::beam) raise(model.beams, element, increase);
  });
}

}  // namespace kardan

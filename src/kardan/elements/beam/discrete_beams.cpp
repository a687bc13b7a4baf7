#include "kardan/elements/beam/discrete_beams.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kardan/base/rotation.hpp"

namespace kardan {

namespace {

/// Forces of node 2 that the first three of six values are in the axes, or moments of the last three.
Vec3 in_axes(const std::array<Vec3, 3>& axes, const std::array<double, 6>& values, std::size_t first) {
  return axes[0] * values[first] + axes[1] * values[first + 1] + axes[2] * values[first + 2];
}

std::string name_of(const Model& model, Index beam) { return "discrete beam " + std::to_string(model.beams.id[beam]); }

}  // namespace

DiscreteBeams::DiscreteBeams(const Model& model, State& state, Diagnostics& diagnostics)
    : law_of_material_(model.materials.size(), none), bound_(model.nodes.size()) {
  for (std::size_t e = 0; e < model.beams.size(); ++e) {
    const Part& part = model.parts[model.beams.part[e]];
    if (part.section == none || part.material == none || model.rigid_part(model.beams.part[e])) continue;
    const Section& section = model.sections[part.section];
    if (section.kind == ElementKind::beam && section.beam.elform == beam_elform::discrete)
      add_element(model, state, static_cast<Index>(e), diagnostics);
  }
  if (elements_.empty() || !diagnostics.ok()) return;
  check_masses(model, state, diagnostics);
  if (can_fail_) state.results.beam.alive.resize(model.beams.size(), 1);
  state.registry.add({"discrete_beams.history", "mixed", "elements.internal_forces"}, history_);
}

void DiscreteBeams::add_element(const Model& model, State& state, Index beam, Diagnostics& diagnostics) {
  const Part& part = model.parts[model.beams.part[beam]];
  const BeamSection section = beam_section(model, beam);
  Element element;
  element.beam = beam;
  element.nodes = {model.beams.nodes[beam][0], model.beams.nodes[beam][1]};
  element.scoor = section.scoor;
  const int kind = std::abs(section.scoor);
  const double length = norm(model.nodes.x[element.nodes[1]] - model.nodes.x[element.nodes[0]]);
  if (kind > 3 && kind != 12 && kind != 13 && kind != 14) {
    diagnostics.error(name_of(model, beam) + " has SCOOR = " + std::to_string(section.scoor), "give SCOOR 0, 1, 2, 3, 12 or 13, or the negative",
                      "*SECTION_BEAM");
    return;
  }
  History history;
  if (!find_law(model, part, element, diagnostics) || !start_axes(model, section, element, history, diagnostics)) return;
  if (element.cable) {
    element.cable_area = section.cable_area;
    element.free_length = length - section.cable_offset;
    if (!(length > 0 && element.free_length > 0)) {
      diagnostics.error(name_of(model, beam) + " is a cable without length", "give its nodes a distance larger than OFFSET", "*SECTION_BEAM");
      return;
    }
  } else if (!element.extended() && length > 0) {
    diagnostics.warning(name_of(model, beam) + " is " + std::to_string(length) + " long with SCOOR = " + std::to_string(section.scoor) +
                            ": it is computed as if its nodes were one point, so a rotation strains it and its forces have a couple",
                        "use SCOOR = 2 or 3 (or -2, -3), or nodes in one place", "*SECTION_BEAM");
  }
  for (const NodeIndex n : element.nodes) {
    state.nodes.needed[n] = 1;
    bound_.use(n);
  }
  elements_.push_back(element);
  history_.push_back(history);
}

bool DiscreteBeams::find_law(const Model& model, const Part& part, Element& element, Diagnostics& diagnostics) {
  const Material& material = model.materials[part.material];
  const auto* fields = std::get_if<FieldMaterial>(&material.law);
  const std::string name = "material " + std::to_string(material.id);
  if (fields == nullptr || (fields->number != 66 && fields->number != 67 && fields->number != 71)) {
    if (law_of_material_[part.material] == none) {
      diagnostics.error("part " + std::to_string(part.id) + " has discrete beams (ELFORM 6) of " + name +
                            ", which this version does not compute",
                        "use *MAT_066, *MAT_067 or *MAT_071", "*PART");
      law_of_material_[part.material] = 0;
    }
    return false;
  }
  element.cable = fields->number == 71;
  if (law_of_material_[part.material] == none) {
    law_of_material_[part.material] = static_cast<Index>(element.cable ? cables_.size() : six_dof_.size());
    if (element.cable) {
      cables_.push_back(CableLaw::make(model, *fields, name, diagnostics).value_or(CableLaw{}));
    } else {
      six_dof_.push_back(SixDofLaw::make(model, *fields, name, diagnostics).value_or(SixDofLaw{}));
      can_fail_ = can_fail_ || six_dof_.back().can_fail();
    }
  }
  element.law = law_of_material_[part.material];
  return true;
}

bool DiscreteBeams::start_axes(const Model& model, const BeamSection& section, const Element& element, History& h,
                               Diagnostics& diagnostics) const {
  const Vec3 line = model.nodes.x[element.nodes[1]] - model.nodes.x[element.nodes[0]];
  const NodeIndex third = model.beams.nodes[element.beam][2];
  const auto vector = model.beams.orientation.find(element.beam);
  const bool oriented = third != none || vector != model.beams.orientation.end();
  h.axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (element.cable) {
    h.axes[0] = norm(line) > 0 ? normalized(line) : h.axes[0];
    return true;
  }
  if (section.frame != none) {
    const Mat3& axes = model.frames[section.frame].axes;
    for (std::size_t i = 0; i < 3; ++i) h.axes[i] = axes.column(i);
  } else if (oriented && norm(line) > 0) {
    const Vec3 in_plane = vector != model.beams.orientation.end() ? vector->second : model.nodes.x[third] - model.nodes.x[element.nodes[0]];
    const Vec3 normal = cross(line, in_plane);
    if (!(norm(normal) > 1e-9 * norm(line) * norm(in_plane))) {
      diagnostics.error(name_of(model, element.beam) + " has its third node on its axis", "move the third node, or give CID", "*ELEMENT_BEAM");
      return false;
    }
    h.axes[0] = normalized(line);
    h.axes[2] = normalized(normal);
    h.axes[1] = cross(h.axes[2], h.axes[0]);
  }
  if (element.along_nodes() && !(norm(line) > 0)) {
    diagnostics.error(name_of(model, element.beam) + " has SCOOR = " + std::to_string(element.scoor) + " and no length to put its r-axis along",
                      "use SCOOR = -3 … 3 other than 2, or give its nodes a distance", "*SECTION_BEAM");
    return false;
  }
  return true;
}

void DiscreteBeams::check_masses(const Model& model, const State& state, Diagnostics& diagnostics) const {
  const std::vector<std::uint8_t> carried = carried_nodes(model);
  for (const Element& element : elements_) {
    bool turns = !element.cable && element.extended();
    if (!element.cable) {
      const SixDofLaw& law = six_dof_[element.law];
      for (std::size_t i = 3; i < 6; ++i) turns = turns || law.stiffness(i) > 0 || law.damping(i) > 0;
    }
    for (const NodeIndex n : element.nodes) {
      if (carried[n]) continue;
      const bool no_mass = !(state.nodes.mass[n] > 0);
      if (!no_mass && !(turns && !(state.nodes.inertia[n] > 0))) continue;
      diagnostics.error(name_of(model, element.beam) + " acts on node " + std::to_string(model.nodes.id[n]) + ", which has no " +
                            (no_mass ? "mass" : "rotary inertia"),
                        no_mass ? "give VOL and RO" : "give INER of *SECTION_BEAM, or attach the node to a shell or rigid body", "*SECTION_BEAM");
    }
  }
}

/// Six relative velocities over the step before t_n in the axes of its middle; brings the axes to t_n.
std::array<double, 6> DiscreteBeams::relative_velocity(const State& state, const Element& e, History& h) const {
  const NodeState& nodes = state.nodes;
  const double dt = state.clock.dt_previous;
  const Vec3 &w1 = nodes.omega[e.nodes[0]], &w2 = nodes.omega[e.nodes[1]];
  const Vec3 spin = e.scoor == 0 ? (w1 + w2) * 0.5 : e.carrier() == 1 ? w2 : w1;
  const Vec3 line = nodes.x[e.nodes[1]] - nodes.x[e.nodes[0]];
  Vec3 velocity = nodes.v[e.nodes[1]] - nodes.v[e.nodes[0]];
  if (e.extended()) velocity -= cross(spin, line - velocity * (0.5 * dt));
  const Mat3 turn = to_matrix(hughes_winget(spin * dt));
  const std::array<Vec3, 3> old = h.axes;
  for (Vec3& axis : h.axes) axis = turn * axis;
  if (e.along_nodes()) {
    h.axes[0] = normalized(line);
    h.axes[1] = normalized(h.axes[1] - h.axes[0] * dot(h.axes[0], h.axes[1]));
    h.axes[2] = cross(h.axes[0], h.axes[1]);
  }
  std::array<double, 6> rates{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 middle = (old[i] + h.axes[i]) * 0.5;
    rates[i] = dot(middle, velocity);
    rates[i + 3] = dot(middle, w2 - w1);
  }
  return rates;
}

void DiscreteBeams::six_forces(State& state, const Element& e, History& h) {
  const std::array<double, 6> rates = relative_velocity(state, e, h), old = h.force;
  const double dt = state.clock.dt_previous;
  const SixDofLaw& law = six_dof_[e.law];
  for (std::size_t i = 0; i < 6; ++i) {
    h.displacement[i] += rates[i] * dt;
    h.force[i] = law.force(i, h.displacement[i], rates[i]);
    h.energy += 0.5 * (old[i] + h.force[i]) * rates[i] * dt;
  }
  if (law.fails(h.force, h.displacement)) {
    h.alive = 0;
    h.force = {};
    return;
  }
  NodeState& nodes = state.nodes;
  const Vec3 force = in_axes(h.axes, h.force, 0), moment = in_axes(h.axes, h.force, 3);
  nodes.force[e.nodes[0]] += force;
  nodes.force[e.nodes[1]] -= force;
  nodes.moment[e.nodes[0]] += moment;
  nodes.moment[e.nodes[1]] -= moment;
  if (e.extended()) nodes.moment[e.nodes[e.carrier()]] += cross(nodes.x[e.nodes[1]] - nodes.x[e.nodes[0]], force);
}

void DiscreteBeams::cable_force(State& state, const Element& e, History& h) {
  NodeState& nodes = state.nodes;
  const Vec3 line = nodes.x[e.nodes[1]] - nodes.x[e.nodes[0]];
  const double length = norm(line), stretch = length - e.free_length, old = h.force[0];
  h.force[0] = cables_[e.law].force(length, e.free_length, e.cable_area);
  if (state.clock.dt_previous > 0) h.energy += 0.5 * (old + h.force[0]) * (stretch - h.displacement[0]);
  h.displacement[0] = stretch;
  if (length > 0) h.axes[0] = line / length;
  nodes.force[e.nodes[0]] += h.axes[0] * h.force[0];
  nodes.force[e.nodes[1]] -= h.axes[0] * h.force[0];
}

void DiscreteBeams::internal_forces(const Model& model, State& state) {
  if (elements_.empty()) return;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    History& h = history_[k];
    if (h.alive == 0) continue;
    if (e.cable)
      cable_force(state, e, h);
    else
      six_forces(state, e, h);
    if (!std::isfinite(h.energy)) throw RunError(name_of(model, e.beam) + " has a force that is not finite");
  }
  bound_step(model, state);
}

/// Eigenvalue of an element between the masses and inertias of its ends: of the translations, with the lever of an extended one, plus
/// that of the rotations.
void DiscreteBeams::bound_step(const Model& model, const State& state) {
  bound_.begin(state);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    if (history_[k].alive == 0) continue;
    const InverseMass w1 = largest_inverse_mass(state, e.nodes[0]), w2 = largest_inverse_mass(state, e.nodes[1]);
    double translation = w1.translation + w2.translation;
    const double rotation = w1.rotation + w2.rotation;
    if (e.extended()) {
      const Vec3 line = state.nodes.x[e.nodes[1]] - state.nodes.x[e.nodes[0]];
      translation += dot(line, line) * (e.carrier() == 1 ? w2 : w1).rotation;
    }
    double stiffness = 0, damping = 0;
    if (e.cable) {
      stiffness = cables_[e.law].stiffness(e.free_length, e.cable_area) * translation;
    } else {
      const SixDofLaw& law = six_dof_[e.law];
      stiffness = std::max({law.stiffness(0), law.stiffness(1), law.stiffness(2)}) * translation +
                  std::max({law.stiffness(3), law.stiffness(4), law.stiffness(5)}) * rotation;
      damping = std::max({law.damping(0), law.damping(1), law.damping(2)}) * translation +
                std::max({law.damping(3), law.damping(4), law.damping(5)}) * rotation;
    }
    const std::array<InverseMass, 2> w{w1, w2};
    for (std::size_t a = 0; a < 2; ++a) {
      if (w[a].translation > 0 || w[a].rotation > 0) bound_.add(state, e.nodes[a], stiffness, damping, static_cast<Index>(k));
    }
  }
  governing_ = {};
  governing_.kind = ElementKind::beam;
  if (const StepBound::Smallest s = bound_.smallest(); s.element != none) {
    governing_.time_step = s.time_step;
    governing_.element = model.beams.id[elements_[s.element].beam];
  }
}

void DiscreteBeams::add_energies(const Model& model, std::vector<double>& internal) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) internal[model.beams.part[elements_[k].beam]] += history_[k].energy;
}

void DiscreteBeams::report(BeamResults& results) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const std::array<double, 6>& f = history_[k].force;
    const Index beam = elements_[k].beam;
    results.axial[beam] = f[0];
    results.shear[beam] = {f[1], f[2]};
    results.torsion[beam] = f[3];
    results.bending[beam] = {f[4], f[5]};
    if (!results.alive.empty()) results.alive[beam] = history_[k].alive > 0 ? 1 : 0;
  }
}

}  // namespace kardan

#include "kardan/elements/discrete/discrete_forces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kardan/base/rotation.hpp"

namespace kardan {

namespace {

constexpr int torsional = 1;

const DiscreteSection& section_of(const Model& model, Index section) { return model.sections[section].discrete; }

}  // namespace

DiscreteForces::DiscreteForces(const Model& model, State& state, Diagnostics& diagnostics)
    : law_of_material_(model.materials.size(), none), bound_(model.nodes.size()) {
  const std::size_t count = model.discretes.size();
  elements_.resize(count);
  history_.resize(count);
  inverse_mass_.resize(count);
  tangent_.resize(count);
  for (std::size_t e = 0; e < count; ++e) add_element(model, state, e, diagnostics);
  if (count > 0) check_masses(model, state, diagnostics);
  state.registry.add({"discretes.history", "mixed", "elements.internal_forces"}, history_);
  state.registry.add_value({"discretes.energy", "energy", "elements.internal_forces"}, energy_);
}

void DiscreteForces::add_element(const Model& model, State& state, std::size_t e, Diagnostics& diagnostics) {
  const auto& block = model.discretes;
  const Part& part = model.parts[block.part[e]];
  const std::string name = "discrete element " + std::to_string(block.id[e]);
  Element& element = elements_[e];
  element.nodes = block.nodes[e];
  element.scale = block.scale[e];
  element.orientation = block.orientation[e];
  element.section = part.section;
  if (part.section == none || model.sections[part.section].kind != ElementKind::discrete) {
    diagnostics.error(name + ": part " + std::to_string(part.id) + " has no discrete section",
                      "give SECID the number of a *SECTION_DISCRETE", "*ELEMENT_DISCRETE");
    return;
  }
  element.law = law_of(model, part, diagnostics);
  for (const NodeIndex n : element.nodes) {
    if (n == none) continue;
    state.nodes.needed[n] = 1;
    bound_.use(n);
  }
  if (element.law == none || !set_line(model, state, e, element, diagnostics)) return;
  History& h = history_[e];
  h.arm = arm(model, state, element);
  h.axis = axis(model, state, element, h.arm, {});
  h.elongation = block.offset[e];
  h.law = initial_history(*laws_[element.law].material, h.elongation);
}

Index DiscreteForces::law_of(const Model& model, const Part& part, Diagnostics& diagnostics) {
  if (part.material == none) {
    diagnostics.error("part " + std::to_string(part.id) + " has discrete elements but no material",
                      "give MID the number of a *MAT_SPRING or *MAT_DAMPER", "*PART");
    return none;
  }
  if (law_of_material_[part.material] != none) return law_of_material_[part.material];
  const Material& material = model.materials[part.material];
  const auto* law = std::get_if<SpringMaterial>(&material.law);
  const std::string name = "material " + std::to_string(material.id) + " of part " + std::to_string(part.id);
  if (law == nullptr) {
    const auto* unsupported = std::get_if<UnsupportedMaterial>(&material.law);
    diagnostics.error(name + (unsupported ? " (" + unsupported->keyword + ")" : "") + " is no spring or damper of this version",
                      "use one of *MAT_S01 to *MAT_S08", "*PART");
    return none;
  }
  const std::size_t errors = diagnostics.error_count();
  check_spring(*law, model.curves, name, diagnostics);
  if (diagnostics.error_count() != errors) return none;
  laws_.push_back({law, spring_bounds(*law, model.curves)});
  return law_of_material_[part.material] = static_cast<Index>(laws_.size()) - 1;
}

bool DiscreteForces::set_line(const Model& model, State& state, std::size_t e, Element& element, Diagnostics& diagnostics) {
  const std::string name = "discrete element " + std::to_string(model.discretes.id[e]);
  if (element.orientation == none) {
    element.line = Line::nodes;
    if (element.nodes[1] == none || norm(arm(model, state, element)) == 0) {
      diagnostics.error(name + (element.nodes[1] == none ? " goes to the ground" : " has two nodes in one place") +
                            " and therefore no direction",
                        "give VID the number of a *DEFINE_SD_ORIENTATION", "*ELEMENT_DISCRETE");
      return false;
    }
    return true;
  }
  const SdOrientation& o = model.sd_orientations[element.orientation];
  static constexpr Line lines[] = {Line::fixed, Line::fixed_plane, Line::moving, Line::moving_plane};
  if (o.iop < 0 || o.iop > 3) {
    diagnostics.error("orientation " + std::to_string(o.id) + " has IOP = " + std::to_string(o.iop), "give IOP 0, 1, 2 or 3",
                      "*DEFINE_SD_ORIENTATION");
    return false;
  }
  element.line = lines[o.iop];
  const bool by_nodes = o.iop >= 2;
  if (by_nodes ? o.nodes[0] == none || o.nodes[1] == none : norm(o.vector) == 0) {
    diagnostics.error("orientation " + std::to_string(o.id) + " has no " + (by_nodes ? "nodes" : "direction"),
                      by_nodes ? "give NID1 and NID2" : "give XT, YT, ZT", "*DEFINE_SD_ORIENTATION");
    return false;
  }
  if (by_nodes) {
    for (const NodeIndex n : o.nodes) state.nodes.needed[n] = 1;
  }
  return true;
}

void DiscreteForces::check_masses(const Model& model, const State& state, Diagnostics& diagnostics) const {
  const std::vector<std::uint8_t> carried = carried_nodes(model);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    if (element.law == none) continue;
    const bool turns = section_of(model, element.section).dro == torsional;
    for (const NodeIndex n : element.nodes) {
      if (n == none || carried[n]) continue;
      if ((turns ? state.nodes.inertia[n] : state.nodes.mass[n]) <= 0) {
        diagnostics.error("discrete element " + std::to_string(model.discretes.id[e]) + " acts on node " +
                              std::to_string(model.nodes.id[n]) + ", which has no " + (turns ? "rotary inertia" : "mass"),
                          turns ? "give the node an *ELEMENT_INERTIA, a shell or a rigid body" : "give the node an *ELEMENT_MASS",
                          "*ELEMENT_DISCRETE");
      }
    }
  }
}

Vec3 DiscreteForces::arm(const Model& model, const State& state, const Element& element) const {
  const NodeIndex n1 = element.nodes[0], n2 = element.nodes[1];
  return (n2 == none ? model.nodes.x[n1] : state.nodes.x[n2]) - state.nodes.x[n1];
}

Vec3 DiscreteForces::axis(const Model& model, const State& state, const Element& element, const Vec3& a,
                            const Vec3& fallback) const {
  const auto unit = [&](const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? v / length : fallback;
  };
  if (element.line == Line::nodes) return unit(a);
  const SdOrientation& o = model.sd_orientations[element.orientation];
  const bool moving = element.line == Line::moving || element.line == Line::moving_plane;
  const Vec3 n = unit(moving ? state.nodes.x[o.nodes[1]] - state.nodes.x[o.nodes[0]] : o.vector);
  if (element.line == Line::fixed || element.line == Line::moving) return n;
  return unit(a - n * dot(n, a));
}

/// Rate of elongation (rotation) over the step before t_n; brings arm, axis and elongation to t_n.
///
/// Along the line of the nodes the elongation is the change of length; along other lines, and about an axis, it is summed
/// from increments, because a direction that turns adds nothing to it.
double DiscreteForces::rate(const Model& model, const State& state, const Element& element, History& h, double& elongation) {
  const double dt = state.clock.dt_previous;
  const Vec3 old_arm = h.arm, old_axis = h.axis;
  h.arm = arm(model, state, element);
  h.axis = axis(model, state, element, h.arm, old_axis);
  const auto velocity = [&](NodeIndex n) { return n == none ? Vec3{} : state.nodes.v[n]; };
  const auto spin = [&](NodeIndex n) {
    if (n == none) return Vec3{};
    return state.nodes.body[n] == none ? state.nodes.omega[n] : state.bodies.motion[state.nodes.body[n]].angular_velocity;
  };
  const Vec3 sum = h.axis + old_axis;
  const double length = norm(sum);
  const Vec3 mid = length > 0 ? sum / length : sum;
  double rate;
  if (section_of(model, element.section).dro == torsional) {
    rate = dot(mid, spin(element.nodes[1]) - spin(element.nodes[0]));
    elongation = h.elongation + rate * dt;
  } else if (dt == 0) {
    rate = dot(h.axis, velocity(element.nodes[1]) - velocity(element.nodes[0]));
    elongation = h.elongation;
  } else {
    const bool by_length = element.line == Line::nodes;
    const double change = by_length ? norm(h.arm) - norm(old_arm) : dot(mid, h.arm - old_arm);
    elongation = h.elongation + change;
    rate = change / dt;
  }
  return rate;
}

/// Law, scale S, dynamic magnification F (1 + KD |v| / V0), failure at FD, clearance CL and the stops CDL, TDL.
/// Source: Hallquist, LS-DYNA Keyword User's Manual, *SECTION_DISCRETE.
double DiscreteForces::force_of(const Model& model, const State& state, std::size_t e, double d, double v) {
  const Element& element = elements_[e];
  const DiscreteSection& s = section_of(model, element.section);
  History& h = history_[e];
  const Law& law = laws_[element.law];
  if ((s.fd > 0 && d >= s.fd) || (s.fd < 0 && d <= s.fd)) h.failed = 1;
  tangent_[e] = {0, 0};
  if (h.failed != 0) return 0.0;
  // With a clearance the spring is in compression only, and begins where the clearance is used up.
  const double felt = s.cl != 0 ? std::min(0.0, d + std::abs(s.cl)) : d;
  const double magnification = s.kd != 0 && s.v0 != 0 ? 1.0 + s.kd * std::abs(v) / s.v0 : 1.0;
  const double force = spring_force(*law.material, model.curves, felt, v, state.clock.time, state.clock.dt_previous, h.law);
  tangent_[e] = {std::abs(element.scale) * law.bounds.stiffness * magnification, std::abs(element.scale) * law.bounds.damping};
  if (magnification != 1.0) tangent_[e][1] += std::abs(element.scale * force) * s.kd / s.v0;
  return element.scale * force * magnification + stop_force(state, s, e, d, v);
}

/// Stops at CDL and TDL. LS-DYNA gives both nodes a common acceleration there; Kardan pushes with a spring of a quarter of
/// the largest stiffness that the ends' masses allow at the last step (m / (4 dt^2)), and a damper of half the critical damping,
/// in the sense of the stop only.
double DiscreteForces::stop_force(const State& state, const DiscreteSection& s, std::size_t e, double d, double v) const {
  const double beyond = s.tdl > 0 && d > s.tdl ? d - s.tdl : (s.cdl != 0 && d < -std::abs(s.cdl) ? d + std::abs(s.cdl) : 0.0);
  const double dt = state.clock.dt_previous, w = inverse_mass_[e][0] + inverse_mass_[e][1];
  if (beyond == 0 || dt == 0 || w == 0) return 0.0;
  const double k = 0.25 / (w * dt * dt), c = std::sqrt(k / w);
  const double push = k * beyond + c * v;
  return push * beyond > 0 ? push : 0.0;
}

/// 1/m of an end for a force along the axis (1/I for a moment about it): of the node, or of its body at that point.
double DiscreteForces::inverse_mass(const State& state, NodeIndex n, const Vec3& axis, bool turns) const {
  if (n == none) return 0.0;
  const BodyIndex b = state.nodes.body[n];
  if (b == none) {
    const double m = turns ? state.nodes.inertia[n] : state.nodes.mass[n];
    return m > 0 ? 1.0 / m : 0.0;
  }
  const BodyInfo& info = state.bodies.info[b];
  const BodyMotion& motion = state.bodies.motion[b];
  const Vec3 couple = turns ? axis : cross(state.nodes.x[n] - motion.center, axis);
  const Vec3 local = transpose(to_matrix(motion.orientation)) * couple;
  const Vec3& j = info.principal_inertia;
  const auto part = [](double c, double inertia) { return inertia > 0 ? c * c / inertia : 0.0; };
  const double angular = part(local.x, j.x) + part(local.y, j.y) + part(local.z, j.z);
  return angular + (turns || info.mass <= 0 ? 0.0 : 1.0 / info.mass);
}

void DiscreteForces::internal_forces(const Model& model, State& state) {
  if (elements_.empty()) return;
  energy_ = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const bool turns = section_of(model, element.section).dro == torsional;
    History& h = history_[e];
    double elongation = 0;
    const double v = rate(model, state, element, h, elongation);
    for (std::size_t i = 0; i < 2; ++i) inverse_mass_[e][i] = inverse_mass(state, element.nodes[i], h.axis, turns);
    const double force = force_of(model, state, e, elongation, v);
    if (!std::isfinite(force)) {
      throw RunError("discrete element " + std::to_string(model.discretes.id[e]) + " has the force " + std::to_string(force) +
                     " at an elongation of " + std::to_string(elongation));
    }
    h.energy += 0.5 * (h.force + force) * (elongation - h.elongation);
    energy_ += h.energy;
    h.force = force;
    h.elongation = elongation;
    const Vec3 pull = h.axis * force;
    auto& target = turns ? state.nodes.moment : state.nodes.force;
    target[element.nodes[0]] += pull;
    if (element.nodes[1] != none) target[element.nodes[1]] -= pull;
    state.discretes[e] = {force, elongation, -pull};
  }
  bound_step(model, state);
}

void DiscreteForces::bound_step(const Model& model, const State& state) {
  bound_.begin(state);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const double w = inverse_mass_[e][0] + inverse_mass_[e][1];
    for (std::size_t i = 0; i < 2; ++i) {
      const NodeIndex n = elements_[e].nodes[i];
      if (n == none || inverse_mass_[e][i] == 0) continue;
      bound_.add(state, n, tangent_[e][0] * w, tangent_[e][1] * w, static_cast<Index>(e));
    }
  }
  governing_ = {};
  governing_.kind = ElementKind::discrete;
  if (const StepBound::Smallest s = bound_.smallest(); s.element != none) {
    governing_.time_step = s.time_step;
    governing_.element = model.discretes.id[s.element];
  }
}

}  // namespace kardan

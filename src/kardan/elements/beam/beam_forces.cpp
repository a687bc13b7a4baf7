#include "kardan/elements/beam/beam_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kardan/elements/beam/beam_setup.hpp"
#include "kardan/elements/damping_factors.hpp"
#include "kardan/elements/initial_stress.hpp"
#include "kardan/elements/lumped_mass.hpp"

namespace kardan {

namespace {

bool tiled(const Model& model, Index beam) {
  const PartIndex p = model.beams.part[beam];
  const Part& part = model.parts[p];
  if (part.section == none || part.material == none || model.rigid_part(p)) return false;
  return model.sections[part.section].kind != ElementKind::beam || model.sections[part.section].beam.elform != beam_elform::discrete;
}

TileElements cut(const Model& model) {
  std::vector<Index> elements;
  std::vector<NodeIndex> flat;
  flat.reserve(2 * model.beams.size());
  for (std::size_t e = 0; e < model.beams.size(); ++e) {
    if (tiled(model, static_cast<Index>(e))) elements.push_back(static_cast<Index>(e));
    flat.push_back(model.beams.nodes[e][0]);
    flat.push_back(model.beams.nodes[e][1]);
  }
  return TileElements({"beams", "beam", ElementKind::beam, model.beams.id, {elements, model.beams.part, flat, 2, model.nodes.x}, 6},
                      model.nodes.size());
}

/// Failure of *MAT_SPOTWELD; nothing for other materials.
void set_weld_failure(const Material& material, BeamProperties& p) {
  const auto* weld = std::get_if<FieldMaterial>(&material.law);
  if (weld == nullptr || weld->number != spot_weld_material) return;
  constexpr std::array<const char*, 6> limits{"nrr", "nrs", "nrt", "mrr", "mss", "mtt"};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (const double limit = weld->value(limits[i]); limit > 0) p.inverse_limit[i] = 1 / limit;
    p.breaks = p.breaks || p.inverse_limit[i] > 0;
  }
  p.failure_time = weld->value("tfail");
  p.breaks = p.breaks || p.failure_time > 0;
}

/// Resultants of *INITIAL_STRESS_BEAM (F11, T11, M12, M13, M22, M23) into the values of a Belytschko-Schwer beam.
void set_resultants(const std::vector<double>& given, double* values) {
  constexpr std::array<std::size_t, 6> order{0, 1, 2, 4, 3, 5};  // axial, torsion, M_s at nodes 1 and 2, M_t likewise
  for (std::size_t i = 0; i < order.size(); ++i) values[(beam_history::force + order[i]) * block_lanes] = given[i];
}

/// Energy of the resultants with the element's own stiffness (beam_formulations.hpp): of two end moments with the matrix c [4 + phi, 2 - phi;
/// 2 - phi, 4 + phi] it is ((4 + phi) (a^2 + b^2) - 2 (2 - phi) a b)/(24 c (1 + phi)).
double resultant_energy(const double* values) {
  const auto constant = [values](std::size_t i) { return values[(beam_history::constant + i) * block_lanes]; };
  const auto force = [values](std::size_t i) { return values[(beam_history::force + i) * block_lanes]; };
  const auto bending = [](double c, double phi, double a, double b) {
    return c > 0 ? ((4 + phi) * (a * a + b * b) - 2 * (2 - phi) * a * b) / (24 * c * (1 + phi)) : 0.0;
  };
  const double torsion = constant(1) > 0 ? force(1) * force(1) / (2 * constant(1)) : 0.0;
  return force(0) * force(0) / (2 * constant(0)) + torsion + bending(constant(2), constant(3), force(2), force(3)) +
         bending(constant(4), constant(5), force(4), force(5));
}

/// Kernels of a formulation, null where it is not computed.
const TileKernels* kernels_of(int elform) {
  switch (elform) {
    case beam_elform::hughes_liu:
    case beam_elform::spot_weld:
      return &hughes_liu();
    case beam_elform::belytschko_schwer:
      return &belytschko_schwer();
    case beam_elform::truss:
      return &truss();
    default:
      return nullptr;
  }
}

}  // namespace

BeamForces::BeamForces(const Model& model, State& state, Diagnostics& diagnostics)
    : elements_(cut(model)), laws_(model.parts.size()), properties_(model.parts.size()), nodes_(&model.beams.nodes) {
  bool good = true;
  for (const PartIndex part : elements_.parts()) good = set_up_part(model, part, diagnostics) && good;
  if (!good || elements_.empty()) return;
  elements_.start(state);
  if (elements_.deletable()) state.results.beam.alive.assign(model.beams.size(), 1);
  std::vector<bool> complained(model.parts.size(), false);
  elements_.for_each([&](Index beam, PartIndex part, double* own) {
    if (!complained[part]) complained[part] = !start_element(model, beam, part, own, diagnostics);
  });
  add_welds(model, state);
  damp(model);
  preload(model, diagnostics);
}

bool BeamForces::set_up_part(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  if (section.kind != ElementKind::beam) return false;  // the lumped masses have complained
  const BeamSection& s = section.beam;
  const std::string name = "part " + std::to_string(part.id) + " has deformable beams of ";
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error(name + what + ", which this version does not compute", cure, keyword);
    good = false;
  };
  const TileKernels* kernels = kernels_of(s.elform);
  if (kernels == nullptr) {
    refuse("ELFORM = " + std::to_string(s.elform) + " (section " + std::to_string(section.id) + ")", "use ELFORM 1, 2, 3, 6 or 9",
           "*SECTION_BEAM");
  }
  std::optional<Law> law = make_law(model, part, LawUse::beam, 1.0, diagnostics);
  if (!law) return false;
  if (s.elform == beam_elform::belytschko_schwer && stiffness_damping_of(model, p)) {
    refuse("ELFORM = 2 with *DAMPING_PART_STIFFNESS", "use ELFORM = 1, or take the damping away", "*DAMPING_PART_STIFFNESS");
  } else if (s.elform == beam_elform::belytschko_schwer && law->inlined != InlinedLaw::elastic) {
    refuse("ELFORM = 2 and a material other than *MAT_ELASTIC", "use ELFORM = 1, or *MAT_ELASTIC", "*PART");
  }
  const auto* fields = std::get_if<FieldMaterial>(&model.materials[part.material].law);
  if ((fields != nullptr && fields->number == spot_weld_material) != (s.elform == beam_elform::spot_weld)) {
    refuse("ELFORM = " + std::to_string(s.elform) + " with material " + std::to_string(model.materials[part.material].id),
           "use ELFORM = 9 and *MAT_SPOTWELD with each other only", "*PART");
  }
  if (kernels != nullptr && kernels == &hughes_liu() && (s.cst < 0 || s.cst > 1 || s.rule < 1 || s.rule > 5)) {
    refuse("CST = " + std::to_string(s.cst) + " with QR = " + std::to_string(s.rule), "use CST 0 or 1 and QR 1 to 5", "*SECTION_BEAM");
  }
  if (!good) return false;
  laws_[p] = std::move(*law);
  const Law& own = laws_[p];
  BeamProperties properties;
  properties.law = {own.constants.get(), own.update, own.history(), own.tensors};
  properties.youngs_modulus = own.youngs_modulus;
  properties.shear_modulus = own.shear;
  properties.shear_factor = s.shrf;
  properties.torsion = s.twists_freely ? 0 : 1;
  set_weld_failure(model.materials[part.material], properties);
  if (s.elform == beam_elform::truss) properties.points = 1;
  if (kernels == &hughes_liu()) integration_points(s, properties);
  properties_[p] = std::make_shared<const BeamProperties>(properties);
  const bool erodes = model.control.time_step.erode / 100 == 1;
  elements_.set_kernel(p, {kernel_for(*kernels, own), properties_[p], beam_history_size(properties.points, own.history()),
                           ((own.can_fail || properties.breaks) && properties.points > 0) || erodes, 0.0, erodes});
  return true;
}

bool BeamForces::start_element(const Model& model, Index beam, PartIndex part, double* own, Diagnostics& diagnostics) const {
  const auto& nodes = model.beams.nodes[beam];
  const double length = norm(model.nodes.x[nodes[1]] - model.nodes.x[nodes[0]]);
  const BeamSection section = beam_section(model, beam);
  const Law& law = laws_[part];
  if (!(length > 0) || !(beam_area(section) > 0)) return true;  // the lumped masses have complained
  const std::optional<Vec3> axis = initial_axis(model, beam, section);
  if (!axis) {
    diagnostics.error("beam " + std::to_string(model.beams.id[beam]) + " of part " + std::to_string(model.parts[part].id) +
                          " has no direction across its axis",
                      "give a third node that is not on the line of the first two, or the vector of *ELEMENT_BEAM_ORIENTATION",
                      "*ELEMENT_BEAM");
    return false;
  }
  for (std::size_t c = 0; c < 3; ++c) own[(beam_history::axis + c) * block_lanes] = (*axis)[c];
  const BeamLump lump = beam_lump(model, beam, law.density);
  own[beam_history::mass * block_lanes] = lump.mass;
  own[beam_history::inertia * block_lanes] = lump.inertia;
  const auto constants = section_constants(section, law, length);
  for (std::size_t i = 0; i < constants.size(); ++i) own[(beam_history::constant + i) * block_lanes] = constants[i];
  const std::size_t per_point = beam_point_values(law.history());
  for (std::size_t i = 0; i < static_cast<std::size_t>(properties_[part]->points); ++i) {
    double* point = own + (beam_history::count + i * per_point + 3) * block_lanes;
    for (std::size_t k = 0; k < law.history(); ++k) point[k * block_lanes] = law.start[k];
  }
  return true;
}

void BeamForces::damp(const Model& model) {
  if (model.stiffness_dampings.empty()) return;
  const auto beta = [&](Index beam, PartIndex part) {
    const StiffnessDamping* damping = stiffness_damping_of(model, part);
    const auto& nodes = model.beams.nodes[beam];
    const double length = norm(model.nodes.x[nodes[1]] - model.nodes.x[nodes[0]]);
    return damping ? damping_factor(*damping, length * std::sqrt(laws_[part].density / laws_[part].youngs_modulus)) : 0.0;
  };
  elements_.set_damping(beta);
  elements_.for_each([&](Index beam, PartIndex part, double* own) {
    const Law& law = laws_[part];
    for (std::size_t i = 0; law.damping != Law::npos && i < static_cast<std::size_t>(properties_[part]->points); ++i)
      own[(beam_history::count + i * beam_point_values(law.history()) + 3 + law.damping) * block_lanes] = beta(beam, part);
  });
}

void BeamForces::preload(const Model& model, Diagnostics& diagnostics) {
  PreloadCheck check(model);
  for (const auto& [beam, given] : initial_stresses_of(model, ElementKind::beam)) {
    if (elements_.values_of(beam) == nullptr) continue;  // rigid or discrete
    const PartIndex part = elements_.part_of(beam);
    if (check.takes(model, part, laws_[part], *given, diagnostics)) preload_beam(model, *given, beam, diagnostics);
  }
}

void BeamForces::preload_beam(const Model& model, const InitialStress& given, Index beam, Diagnostics& diagnostics) {
  const PartIndex part = elements_.part_of(beam);
  const BeamProperties& p = *properties_[part];
  const Law& law = laws_[part];
  const auto& nodes = model.beams.nodes[beam];
  const Vec3 line = model.nodes.x[nodes[1]] - model.nodes.x[nodes[0]];
  const double length = norm(line);
  const auto refuse = [&](const std::string& what, const std::string& cure) {
    diagnostics.error("beam " + std::to_string(model.beams.id[beam]) + " is given " + what, cure, "*INITIAL_STRESS_BEAM");
  };
  double* const values = elements_.values_of(beam);
  const auto value = [values](std::size_t row) -> double& { return values[row * block_lanes]; };
  if (p.points == 0) {
    if (given.resultants.empty()) return refuse("stresses of points; its formulation has resultants", "give F11 to M23 and NPTS = 1 of ELFORM 2");
    set_resultants(given.resultants, values);
    return elements_.add_energy(beam, resultant_energy(values));
  }
  if (given.points.empty()) return refuse("resultants; its formulation has stresses", "give the stresses of its points");
  const auto same = [&](const InitialStress::Point& point) { return point.stress == given.points.front().stress; };
  if (!std::all_of(given.points.begin(), given.points.end(), same))
    return refuse("stresses that differ over the section; which point is which is not known to Kardan", "give one stress for all points");
  const Vec3 r = line / length, s{value(beam_history::axis), value(beam_history::axis + 1), value(beam_history::axis + 2)};
  const Vec3 t = cross(r, s);
  const Mat3 axes = Mat3::columns(r, s, t);
  const InitialStress::Point& point = given.points.front();
  const StressVector stress = given.local ? point.stress : in_axes(point.stress, axes);
  const double own_stress[3] = {stress[0], stress[3], stress[5]};
  const std::size_t per_point = beam_point_values(law.history());
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.points); ++i) {
    double* const own = values + (beam_history::count + i * per_point) * block_lanes;
    for (std::size_t c = 0; c < 3; ++c) own[c * block_lanes] = own_stress[c];
    preload_history(law, point.plastic_strain, own + 3 * block_lanes);
  }
  const double shear = own_stress[1] * own_stress[1] + own_stress[2] * own_stress[2];
  const double volume = beam_area(beam_section(model, beam)) * length;
  elements_.add_energy(beam, volume * (own_stress[0] * own_stress[0] / p.youngs_modulus + p.shear_factor * shear / p.shear_modulus) / 2);
}

void BeamForces::internal_forces(const Model& model, State& state) {
  elements_.internal_forces(model, state, [](const State&, Index) { return "has no length or a value that is not finite"; });
  if (!welds_.empty()) note_failures(state);
}

/// In the cycle in which they fail, whoever looks at it.
void BeamForces::note_failures(State& state) {
  const std::int64_t deleted = elements_.deleted();
  if (deleted == known_deleted_) return;
  known_deleted_ = deleted;
  for (std::size_t i = 0; i < welds_.size(); ++i) {
    WeldReport& weld = state.welds[first_weld_ + i];
    if (weld.failed || elements_.alive(welds_[i]) > 0) continue;
    weld.failed = true;
    weld.failure_time = state.clock.time;
  }
}

void BeamForces::report(const State& state, BeamResults& results) const {
  if (elements_.empty()) return;
  elements_.for_each([&](Index beam, PartIndex, const double* own) {
    const auto force = [&](std::size_t i) { return own[(beam_history::force + i) * block_lanes]; };
    const auto& n = (*nodes_)[beam];
    const double living = elements_.alive(beam), length = norm(state.nodes.x[n[1]] - state.nodes.x[n[0]]);
    results.axial[beam] = living * force(0);
    results.torsion[beam] = living * force(1);
    results.shear[beam] = {-living * (force(4) + force(5)) / length, living * (force(2) + force(3)) / length};
    results.bending[beam] = {0.5 * living * (force(3) - force(2)), 0.5 * living * (force(5) - force(4))};
    if (!results.alive.empty()) results.alive[beam] = living > 0 ? 1 : 0;
  });
}

void BeamForces::add_welds(const Model& model, State& state) {
  first_weld_ = state.welds.size();
  for (std::size_t e = 0; e < model.beams.size(); ++e) {
    const auto beam = static_cast<Index>(e);
    if (elements_.values_of(beam) == nullptr) continue;
    if (model.sections[model.parts[elements_.part_of(beam)].section].beam.elform != beam_elform::spot_weld) continue;
    welds_.push_back(beam);
    WeldReport& weld = state.welds.emplace_back();
    weld.kind = WeldReport::Kind::beam;
    weld.id = model.beams.id[e];
  }
}

void BeamForces::report_welds(State& state) const {
  const BeamResults& r = state.results.beam;
  for (std::size_t i = 0; i < welds_.size(); ++i) {
    const auto e = static_cast<std::size_t>(welds_[i]);
    WeldReport& weld = state.welds[first_weld_ + i];
    weld.axial = r.axial[e];
    weld.shear = std::hypot(r.shear[e][0], r.shear[e][1]);
    weld.moment = std::hypot(r.bending[e][0], r.bending[e][1]);
    weld.torsion = r.torsion[e];
    const auto& n = (*nodes_)[e];
    weld.length = norm(state.nodes.x[n[1]] - state.nodes.x[n[0]]);
  }
}

}  // namespace kardan

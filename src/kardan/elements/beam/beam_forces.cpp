#include "kardan/elements/beam/beam_forces.hpp"

#include <array>
#include <cmath>
#include <string>

#include "kardan/elements/beam/beam_setup.hpp"
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
  if (s.elform == beam_elform::belytschko_schwer && law->inlined != InlinedLaw::elastic) {
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

void BeamForces::internal_forces(const Model& model, State& state) {
  elements_.internal_forces(model, state, [](const State&, Index) { return "has no length or a value that is not finite"; });
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

}  // namespace kardan

#include "kardan/elements/solid/solid_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kardan/elements/free_sides.hpp"
#include "kardan/elements/geometry.hpp"
#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"

namespace kardan {

namespace {

constexpr int one_point = 1;

SolidProperties properties_of(const Model& model, const Part& part, const Law& law) {
  SolidProperties p;
  p.law = {law.constants.get(), law.update, law.history(), law.tensors};
  p.density = law.density;
  p.longitudinal = law.longitudinal;
  p.wave_speed = std::sqrt(law.longitudinal / law.density);
  const HourglassChoice h = hourglass_of(model, part);
  p.q1 = h.q1;
  p.q2 = h.q2;
  p.stiffness_hourglass = h.stiffness();
  p.hourglass = p.stiffness_hourglass ? h.membrane * law.longitudinal / 16 : h.membrane * p.density * p.wave_speed / 4;
  return p;
}

/// Nodes of a solid as the trilinear map needs them. A tetrahedron N1 N2 N3 N4 N4 N4 N4 N4 would be half of itself (its
/// face of four nodes is not flat); N1 N2 N3 N3 N4 N4 N4 N4 is all of it, with the constant gradients of the
/// tetrahedron.
std::array<NodeIndex, 8> mapped_nodes(const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 4) return nodes;
  std::array<NodeIndex, 4> corner{};
  std::size_t count = 0;
  for (const NodeIndex n : nodes) {
    const auto end = corner.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(corner.begin(), end, n) == end) corner[count++] = n;
  }
  return {corner[0], corner[1], corner[2], corner[2], corner[3], corner[3], corner[3], corner[3]};
}

TileElements cut(const Model& model) {
  std::vector<Index> elements;
  std::vector<NodeIndex> flat;
  flat.reserve(model.solids.size() * 8);
  for (std::size_t e = 0; e < model.solids.size(); ++e) {
    const Part& part = model.parts[model.solids.part[e]];
    if (part.section != none && part.material != none && !model.rigid_part(model.solids.part[e])) {
      elements.push_back(static_cast<Index>(e));
    }
    const std::array<NodeIndex, 8> nodes = mapped_nodes(model.solids.nodes[e]);
    flat.insert(flat.end(), nodes.begin(), nodes.end());
  }
  return TileElements({"solids", "solid", ElementKind::solid, model.solids.id, {elements, model.solids.part, flat, 8, model.nodes.x}, 3},
                      model.nodes.size());
}

}  // namespace

SolidForces::SolidForces(const Model& model, State& state, Diagnostics& diagnostics)
    : elements_(cut(model)), laws_(model.parts.size()) {
  bool good = true;
  for (const PartIndex part : elements_.parts()) good = set_up_part(model, part, diagnostics) && good;
  if (!good || elements_.empty()) return;
  elements_.start(state);
  start_histories(model);
  state.results.solid.stress.assign(model.solids.size(), StressVector{});
  state.results.solid.plastic_strain.assign(model.solids.size(), 0.0);
  if (elements_.deletable()) state.results.solid.alive.assign(model.solids.size(), 1);
}

void SolidForces::start_histories(const Model& model) {
  elements_.for_each([&](Index solid, PartIndex part, double* own) {
    const auto& nodes = model.solids.nodes[solid];
    const double volume = solid_volume(gather_coordinates(model.nodes.x, nodes), nodes);
    own[solid_history::volume * block_lanes] = volume;
    own[solid_history::size * block_lanes] = std::cbrt(volume);
    const std::vector<double>& start = laws_[part].start;
    for (std::size_t k = 0; k < start.size(); ++k) own[(solid_history::law + k) * block_lanes] = start[k];
  });
  const std::vector<std::uint8_t> faces = free_faces(model.solids);
  elements_.scale_steps([&](Index solid, PartIndex part) {
    return free_solid_factor(model, solid, faces[solid], {laws_[part].density, laws_[part].shear, laws_[part].longitudinal, 0});
  });
}

bool SolidForces::set_up_part(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error("part " + std::to_string(part.id) + " has deformable solids of " + what +
                          ", which this version does not compute",
                      cure, keyword);
    good = false;
  };
  std::optional<Law> law = make_law(model, part, LawUse::solid, 1.0, diagnostics);
  if (!law) good = false;
  if (section.kind != ElementKind::solid) return false;  // the lumped masses have complained
  if (section.solid.elform != one_point) {
    refuse("ELFORM = " + std::to_string(section.solid.elform) + " (section " + std::to_string(section.id) + ")",
           "use ELFORM = 1", "*SECTION_SOLID");
  }
  if (const int type = hourglass_of(model, part).type; type < 1 || type > 5) {
    refuse("hourglass control IHQ = " + std::to_string(type),
           "use IHQ = 1, 2 or 3 (viscous), 4 or 5 (stiffness), by *HOURGLASS", "*HOURGLASS");
  }
  if (!good) return false;
  laws_[p] = std::move(*law);
  elements_.set_kernel(p, {kernel_for(hexahedron(), laws_[p]), std::make_shared<const SolidProperties>(properties_of(model, part, laws_[p])),
                           solid_history::law + laws_[p].history(), laws_[p].can_fail, laws_[p].deletion.step});
  return true;
}

void SolidForces::internal_forces(const Model& model, State& state) {
  elements_.internal_forces(model, state, [&model](const State& now, Index solid) {
    const auto& nodes = model.solids.nodes[solid];
    const double volume = solid_volume(gather_coordinates(now.nodes.x, nodes), nodes);
    return volume <= 0 ? fmt::format("has the negative volume {:.6g}", volume) : std::string("has a value that is not finite");
  });
}

void SolidForces::report(SolidResults& results) const {
  elements_.for_each([&](Index solid, PartIndex part, const double* own) {
    const bool alive = elements_.alive(solid) > 0;
    for (std::size_t c = 0; c < 6; ++c) results.stress[solid][c] = alive ? own[(solid_history::stress + c) * block_lanes] : 0.0;
    const std::size_t strain = laws_[part].plastic_strain;
    if (strain != Law::npos) results.plastic_strain[solid] = own[(solid_history::law + strain) * block_lanes];
    if (!results.alive.empty()) results.alive[solid] = alive;
  });
}

}  // namespace kardan

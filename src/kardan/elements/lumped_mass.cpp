#include "kardan/elements/lumped_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "kardan/elements/geometry.hpp"
#include "kardan/elements/solid/solid_shape.hpp"

namespace kardan {

namespace {

/// Section and material of a part, checked once a part instead of once an element.
struct PartProperties {
  const Section* section = nullptr;  ///< null if the part cannot be used
  BulkProperties bulk;
  bool rigid = false;
};

std::string part_name(const Part& part) {
  return "part " + std::to_string(part.id) + (part.title.empty() ? "" : " \"" + part.title + "\"");
}

/// Properties of every part that has elements of this kind; complains once a part.
class PartTable {
 public:
  PartTable(const Model& model, ElementKind kind, const std::vector<PartIndex>& part_of_element, Diagnostics& diagnostics)
      : entries_(model.parts.size()) {
    std::vector<bool> used(model.parts.size(), false);
    for (const PartIndex p : part_of_element) used[static_cast<std::size_t>(p)] = true;
    for (std::size_t p = 0; p < used.size(); ++p) {
      if (used[p]) entries_[p] = look_up(model, kind, model.parts[p], diagnostics);
    }
  }
  const PartProperties& operator[](PartIndex p) const { return entries_[static_cast<std::size_t>(p)]; }

 private:
  static PartProperties look_up(const Model& model, ElementKind kind, const Part& part, Diagnostics& diagnostics) {
    if (part.section == none || part.material == none) {
      diagnostics.error(part_name(part) + " has elements but no " + (part.section == none ? "section" : "material"),
                        "give SECID and MID of the part the numbers of a *SECTION and a *MAT", "*PART");
      return {};
    }
    const Section& section = model.sections[static_cast<std::size_t>(part.section)];
    if (section.kind != kind) {
      static constexpr const char* names[] = {"shell", "solid", "beam", "discrete"};
      diagnostics.error(part_name(part) + " has " + names[static_cast<int>(kind)] + " elements but a " +
                            names[static_cast<int>(section.kind)] + " section (" + std::to_string(section.id) + ")",
                        "give SECID the number of a section of the elements' kind", "*PART");
      return {};
    }
    const Material& material = model.materials[static_cast<std::size_t>(part.material)];
    return {&section, bulk_properties(material), material.rigid()};
  }

  std::vector<PartProperties> entries_;
};

/// Adds equal shares of `mass` to the distinct nodes, `distinct` of them (1: all of it to each); returns the share.
template <std::size_t N>
double share_mass(std::vector<double>& nodal, const std::array<NodeIndex, N>& nodes, int distinct, double mass) {
  const double share = mass / distinct;
  for (std::size_t a = 0; a < N; ++a) {
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(a), nodes[a]) ==
        nodes.begin() + static_cast<std::ptrdiff_t>(a)) {
      nodal[static_cast<std::size_t>(nodes[a])] += share;
    }
  }
  return share;
}

double shell_mass(const ShellSection& section, double density, double area, double thickness) {
  return area * (thickness * density + section.mass_per_area);
}

/// Rotary inertia of a shell's node whose mass is `mass`.
double shell_inertia(double mass, double area, double thickness) { return mass * std::max(thickness * thickness / 12.0, area / 8.0); }

void add_shells(const Model& model, State& state, Diagnostics& diagnostics) {
  const ShellElements& shells = model.shells;
  const PartTable parts(model, ElementKind::shell, shells.part, diagnostics);
  for (std::size_t e = 0; e < shells.size(); ++e) {
    const PartProperties& part = parts[shells.part[e]];
    if (part.section == nullptr) continue;
    const auto& nodes = shells.nodes[e];
    const double area = shell_area(gather_coordinates(model.nodes.x, nodes));
    const double thickness = mean_thickness(model, static_cast<Index>(e));
    const double mass = shell_mass(part.section->shell, part.bulk.density, area, thickness);
    if (!(area > 0) || !(thickness > 0)) {
      diagnostics.error("shell " + std::to_string(shells.id[e]) + " has " + (area > 0 ? "no thickness" : "no area"),
                        area > 0 ? "give T1 of its section" : "check the coordinates of its nodes", "*ELEMENT_SHELL");
      continue;
    }
    const bool triangle = is_triangle(nodes);
    const double share = share_mass(state.nodes.mass, nodes, triangle ? 3 : 4, mass);
    if (part.rigid) continue;
    state.energy.part_mass[static_cast<std::size_t>(shells.part[e])] += mass;
    const double inertia = shell_inertia(share, area, thickness);
    for (std::size_t a = 0; a < (triangle ? 3u : 4u); ++a) state.nodes.inertia[static_cast<std::size_t>(nodes[a])] += inertia;
  }
}

void add_solids(const Model& model, State& state, Diagnostics& diagnostics) {
  const SolidElements& solids = model.solids;
  const PartTable parts(model, ElementKind::solid, solids.part, diagnostics);
  for (std::size_t e = 0; e < solids.size(); ++e) {
    const PartProperties& part = parts[solids.part[e]];
    if (part.section == nullptr) continue;
    const auto& nodes = solids.nodes[e];
    const double volume = solid_volume(gather_coordinates(model.nodes.x, nodes), nodes);
    // A rigid solid only carries mass, and a mesh mirrored from its other half is common: its orientation does not matter.
    if (volume == 0 || (volume < 0 && !part.rigid)) {
      diagnostics.error("solid " + std::to_string(solids.id[e]) + " has the volume " + std::to_string(volume),
                        "number its nodes so that the fourth to first face points inwards, or check their coordinates",
                        "*ELEMENT_SOLID");
      continue;
    }
    const double mass = std::abs(volume) * part.bulk.density;
    const double share = share_mass(state.nodes.mass, nodes, distinct_nodes(nodes), mass);
    if (part.rigid) continue;
    state.energy.part_mass[static_cast<std::size_t>(solids.part[e])] += mass;
    share_mass(state.nodes.inertia, nodes, 1, solid_inertia(model, e, share));
  }
}

void add_beams(const Model& model, State& state, Diagnostics& diagnostics) {
  const BeamElements& beams = model.beams;
  const PartTable parts(model, ElementKind::beam, beams.part, diagnostics);
  std::vector<double> added(model.parts.size(), 0.0);
  for (std::size_t e = 0; e < beams.size(); ++e) {
    const PartProperties& part = parts[beams.part[e]];
    if (part.section == nullptr) continue;
    const BeamLump lump = beam_lump(model, static_cast<Index>(e), part.bulk.density);
    if (!(lump.mass > 0) && part.bulk.density > 0) {
      diagnostics.error("beam " + std::to_string(beams.id[e]) + " of part " +
                            std::to_string(model.parts[static_cast<std::size_t>(beams.part[e])].id) + " has no volume",
                        "give its section an area (TS1/TT1, A, or VOL of ELFORM 6), its nodes a distance", "*SECTION_BEAM");
      continue;
    }
    if (!part.rigid) state.energy.part_mass[static_cast<std::size_t>(beams.part[e])] += 2 * lump.mass;
    for (std::size_t a = 0; a < 2; ++a) {
      const auto n = static_cast<std::size_t>(beams.nodes[e][a]);
      state.nodes.mass[n] += lump.mass;
      if (!part.rigid) state.nodes.inertia[n] += lump.inertia;
    }
    added[static_cast<std::size_t>(beams.part[e])] += 2 * lump.added;
  }
  for (std::size_t p = 0; p < added.size(); ++p) {
    if (added[p] > 0) diagnostics.notice(part_name(model.parts[p]) + ": DT of its spot welds adds the mass " + std::to_string(added[p]));
  }
}

}  // namespace

namespace {

/// Factor on the mass of a spot weld with DT of *MAT_SPOTWELD; 1 for all other beams.
double weld_mass_factor(const Model& model, Index beam, double length) {
  const Part& part = model.parts[static_cast<std::size_t>(model.beams.part[static_cast<std::size_t>(beam)])];
  const auto* weld = std::get_if<FieldMaterial>(&model.materials[static_cast<std::size_t>(part.material)].law);
  if (weld == nullptr || weld->number != spot_weld_material || !(weld->value("dt") > 0)) return 1;
  const double ratio = weld->value("dt") / length * std::sqrt(weld->youngs_modulus / weld->density);
  return std::max(1.0, ratio * ratio);
}

}  // namespace

BeamLump beam_lump(const Model& model, Index beam, double density) {
  const auto& nodes = model.beams.nodes[static_cast<std::size_t>(beam)];
  const double length =
      norm(model.nodes.x[static_cast<std::size_t>(nodes[1])] - model.nodes.x[static_cast<std::size_t>(nodes[0])]);
  const BeamSection section = beam_section(model, beam);
  const double volume = beam_volume(section, length), mass = 0.5 * density * volume;
  if (section.elform == beam_elform::discrete) {
    if (section.inertia >= 0) return {mass, 0.5 * section.inertia};
    const double radius = std::cbrt(3 * volume / (4 * std::numbers::pi));  // INER = -1: a solid sphere of the volume VOL
    return {mass, 0.4 * mass * radius * radius};
  }
  if (section.elform == beam_elform::truss) return {mass, 0};
  const BeamMoments moments = beam_moments(section);
  const double share = section.elform == beam_elform::belytschko_schwer ? 1.0 / 12 : section.elform == beam_elform::spot_weld ? 0.25 : 0.125;
  const double radius_square = std::max(moments.ss, moments.tt) / beam_area(section) + share * length * length;
  const double scaled = mass * weld_mass_factor(model, beam, length);
  return {scaled, scaled * radius_square, scaled - mass};
}

NodeShare node_share(const Model& model, ElementKind kind, Index element) {
  const auto e = static_cast<std::size_t>(element);
  const PartIndex own_part = kind == ElementKind::shell ? model.shells.part[e] : kind == ElementKind::solid ? model.solids.part[e] : model.beams.part[e];
  const Part& part = model.parts[static_cast<std::size_t>(own_part)];
  const double density = bulk_properties(model.materials[static_cast<std::size_t>(part.material)]).density;
  if (kind == ElementKind::beam) {
    const BeamLump lump = beam_lump(model, element, density);
    return {lump.mass, lump.inertia, 2};
  }
  if (kind == ElementKind::solid) {
    const auto& nodes = model.solids.nodes[e];
    const int count = distinct_nodes(nodes);
    const double share = std::abs(solid_volume(gather_coordinates(model.nodes.x, nodes), nodes)) * density / count;
    return {share, solid_inertia(model, e, share), count};
  }
  const auto& nodes = model.shells.nodes[e];
  const int count = is_triangle(nodes) ? 3 : 4;
  const double area = shell_area(gather_coordinates(model.nodes.x, nodes)), thickness = mean_thickness(model, element);
  const double share = shell_mass(model.sections[static_cast<std::size_t>(part.section)].shell, density, area, thickness) / count;
  return {share, shell_inertia(share, area, thickness), count};
}

void add_lumped_masses(const Model& model, State& state, Diagnostics& diagnostics) {
  state.energy.part_mass.assign(model.parts.size(), 0.0);
  add_shells(model, state, diagnostics);
  add_solids(model, state, diagnostics);
  add_beams(model, state, diagnostics);
  for (const PointMass& m : model.masses) {
    state.nodes.mass[static_cast<std::size_t>(m.node)] += m.mass;
    if (m.part != none && !model.rigid_part(m.part)) state.energy.part_mass[static_cast<std::size_t>(m.part)] += m.mass;
  }
  for (const PointInertia& m : model.inertias) {
    state.nodes.mass[static_cast<std::size_t>(m.node)] += m.mass;
    state.nodes.inertia[static_cast<std::size_t>(m.node)] += trace(m.inertia) / 3.0;
  }
}

}  // namespace kardan

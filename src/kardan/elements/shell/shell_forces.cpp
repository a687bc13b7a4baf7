#include "kardan/elements/shell/shell_forces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "kardan/elements/damping_factors.hpp"
#include "kardan/elements/free_sides.hpp"
#include "kardan/elements/geometry.hpp"
#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/initial_stress.hpp"
#include "kardan/elements/lumped_mass.hpp"

namespace kardan {

namespace {

/// Deformable shells that are, or are not, C0 triangles.
std::vector<Index> deformable_shells(const Model& model, bool c0_triangles) {
  std::vector<bool> deformable(model.parts.size()), sorts(model.parts.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    deformable[p] = part.section != none && part.material != none && !model.rigid_part(static_cast<PartIndex>(p));
    if (!deformable[p]) continue;
    ShellFormulation formulation;
    Diagnostics unheard;  // make_part() complains
    find_formulation(model.sections[part.section], {}, unheard, formulation);
    sorts[p] = sorts_triangles(model, formulation);
  }
  std::vector<Index> elements;
  for (std::size_t e = 0; e < model.shells.size(); ++e) {
    const auto part = static_cast<std::size_t>(model.shells.part[e]);
    const bool c0 = is_triangle(model.shells.nodes[e]) && sorts[part];
    if (deformable[part] && c0 == c0_triangles) elements.push_back(static_cast<Index>(e));
  }
  return elements;
}

TileElements cut(const Model& model, const char* name, bool c0_triangles) {
  const std::vector<Index> elements = deformable_shells(model, c0_triangles);
  const std::span<const NodeIndex> flat(model.shells.size() == 0 ? nullptr : model.shells.nodes.front().data(), model.shells.size() * 4);
  return TileElements({name, "shell", ElementKind::shell, model.shells.id, {elements, model.shells.part, flat, 4, model.nodes.x}, 6, true},
                      model.nodes.size());
}

/// Height of a shell's mid surface over its nodes: of *ELEMENT_SHELL_OFFSET, else by NLOC.
double offset_of(const Model& model, Index shell, double thickness) {
  if (const auto own = model.shells.offset.find(shell); own != model.shells.offset.end()) return own->second;
  const Index section = model.parts[model.shells.part[shell]].section;
  return -0.5 * model.sections[section].shell.nloc * thickness;
}

/// Stable step over that of a shell whose mid surface lies in its nodes. With the offset z, the radius of gyration r of the rotary inertia and the plate's
/// i = h/sqrt(12), membrane and bending are coupled to [1, z/r; z/r, (i^2 + z^2)/r^2]: the step goes with the root of its largest eigenvalue.
double offset_factor(double offset, double thickness, double area) {
  if (offset == 0) return 1.0;
  const double own = thickness * thickness / 12, r2 = std::max(own, area / 8), d = (own + offset * offset) / r2;
  return 1 / std::sqrt(std::max(1.0, 0.5 * (1 + d + std::sqrt((1 - d) * (1 - d) + 4 * offset * offset / r2))));
}

}  // namespace

ShellForces::ShellForces(const Model& model, State& state, Diagnostics& diagnostics)
    : formulations_(model.parts.size()), laws_(model.parts.size()), quads_{cut(model, "shells", false), {}},
      triangles_{cut(model, "triangles", true), {}} {
  std::vector<PartIndex> parts = quads_.elements.parts();
  const std::vector<PartIndex> others = triangles_.elements.parts();
  parts.insert(parts.end(), others.begin(), others.end());
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  bool good = true;
  for (const PartIndex part : parts) good = make_part(model, part, diagnostics) && good;
  if (!good) return;
  for (Group* group : {&quads_, &triangles_}) {
    group->properties.resize(model.parts.size());
    for (const PartIndex part : group->elements.parts()) set_kernel(model, part, *group);
    start(model, state, *group);
  }
  preload(model, diagnostics);
  state.results.shell.layers = std::max(1, std::abs(model.output.maxint));
  if (quads_.elements.deletable() || triangles_.elements.deletable()) state.results.shell.alive.assign(model.shells.size(), 1);
}

bool ShellForces::make_part(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  const std::string name = "part " + std::to_string(part.id);
  if (section.kind != ElementKind::shell) return false;  // the lumped masses have complained
  bool good = find_formulation(section, name, diagnostics, formulations_[p]);
  const ShellFormulation& formulation = formulations_[p];
  std::optional<Law> law = make_law(model, part, LawUse::shell, formulation.membrane ? 0.0 : section.shell.shrf, diagnostics);
  if (!law) good = false;
  if (thickness_rule(model, section.shell).points.size() > max_shell_points) {
    diagnostics.error(name + " has more than " + std::to_string(max_shell_points) + " points through the thickness",
                      "use at most " + std::to_string(max_shell_points), "*SECTION_SHELL");
    good = false;
  }
  const auto parts_of_quads = quads_.elements.parts();
  const bool quads = std::binary_search(parts_of_quads.begin(), parts_of_quads.end(), p);
  if (formulation.triangles && quads) {
    diagnostics.error(name + " has ELFORM = 4, triangles, but some of its shells have four nodes", "use ELFORM = 2 or 16", "*SECTION_SHELL");
    good = false;
  }
  if (!good) return false;
  laws_[p] = std::move(*law);
  if (model.control.shell_bwc == 1 && quads && !formulation.fully_integrated && !formulation.membrane) {
    diagnostics.warning("BWC = 1: " + name + " is computed without the stiffness of Belytschko, Wong and Chiang for warped shells", {}, "*CONTROL_SHELL");
  }
  if (formulation.fully_integrated && hourglass_of(model, part).type == 8) {
    diagnostics.warning("IHQ = 8: " + name + " is computed without the stiffness against warping that it adds to fully integrated shells", {}, "*HOURGLASS");
  }
  if (model.control.shell_istupd == 4 && laws_[p].plastic_strain == Law::npos) {
    diagnostics.warning("ISTUPD = 4: the material of " + name + " has no plastic strain; its thickness follows the strains beyond nu/E of the stresses",
                        {}, "*CONTROL_SHELL");
  }
  return true;
}

void ShellForces::set_kernel(const Model& model, PartIndex p, Group& group) {
  const bool c0 = &group == &triangles_;
  const ShellFormulation& formulation = formulations_[p];
  ShellProperties properties = shell_properties(model, model.parts[p], laws_[p], formulation, c0);
  for (const auto& [shell, offset] : model.shells.offset) properties.offsets = properties.offsets || model.shells.part[shell] == p;
  if (formulation.membrane) properties.offsets = false;
  const TileKernels& kernels = c0 ? c0_triangle() : (formulation.fully_integrated ? fully_integrated() : belytschko_tsay());
  group.properties[p] = std::make_shared<const ShellProperties>(properties);
  const bool erodes = model.control.time_step.erode / 10 % 10 == 1;
  group.elements.set_kernel(p, {kernel_for(kernels, laws_[p]), group.properties[p], shell_history_size(properties, laws_[p].history()),
                                laws_[p].can_fail || erodes, laws_[p].deletion.step, erodes});
}

void ShellForces::start(const Model& model, State& state, Group& group) {
  group.elements.start(state);
  group.elements.for_each([&](Index shell, PartIndex part, double* own) {
    const Law& law = laws_[part];
    const ShellProperties& p = *group.properties[part];
    const std::size_t per_point = shell_point_values(law.history()), kept = shell_kept(p, law.history());
    for (std::size_t first = 5; first < kept; first += per_point) {
      for (std::size_t k = 0; k < law.history(); ++k) own[(first + k) * block_lanes] = law.start[k];
    }
    const double thickness = mean_thickness(model, shell);
    own[(kept + kept_thickness) * block_lanes] = thickness;
    // The points' heights have NLOC in them already.
    const double by_nloc = -0.5 * model.sections[model.parts[part].section].shell.nloc * thickness;
    if (p.offsets) own[(kept + kept_offset) * block_lanes] = offset_of(model, shell, thickness) - by_nloc;
  });
  const std::vector<std::uint8_t> edges = free_edges(model.shells);
  const auto step_factor = [&](Index shell, PartIndex part) {
    const Law& law = laws_[part];
    const ShellSection& section = model.sections[model.parts[part].section].shell;
    const bool membrane = formulations_[part].membrane;
    const double thickness = mean_thickness(model, shell);
    const FreeBody body{law.density + section.mass_per_area / thickness, law.shear, law.longitudinal, membrane ? 0.0 : section.shrf * law.shear};
    const double area = shell_area(gather_coordinates(model.nodes.x, model.shells.nodes[shell]));
    return free_shell_factor(model, shell, edges[shell], body, thickness) *
           (membrane ? 1.0 : offset_factor(offset_of(model, shell, thickness), thickness, area));
  };
  group.elements.scale_steps(step_factor);
  if (model.stiffness_dampings.empty()) return;
  const auto beta = [&](Index shell, PartIndex part) {
    const StiffnessDamping* damping = stiffness_damping_of(model, part);
    const auto& nodes = model.shells.nodes[shell];
    const double length = shell_length(gather_coordinates(model.nodes.x, nodes), is_triangle(nodes), model.control.time_step.isdo);
    return damping ? damping_factor(*damping, length / group.properties[part]->wave_speed * step_factor(shell, part)) : 0.0;
  };
  group.elements.set_damping(beta);
  group.elements.for_each([&](Index shell, PartIndex part, double* own) {
    const Law& law = laws_[part];
    const std::size_t kept = shell_kept(*group.properties[part], law.history());
    for (std::size_t first = 5; law.damping != Law::npos && first < kept; first += shell_point_values(law.history()))
      own[(first + law.damping) * block_lanes] = beta(shell, part);
  });
}

void ShellForces::preload(const Model& model, Diagnostics& diagnostics) {
  PreloadCheck check(model);
  for (const auto& [shell, given] : initial_stresses_of(model, ElementKind::shell)) {
    Group& group = quads_.elements.values_of(shell) ? quads_ : triangles_;
    if (group.elements.values_of(shell) == nullptr) continue;  // of a rigid part
    const PartIndex part = group.elements.part_of(shell);
    if (check.takes(model, part, laws_[part], *given, diagnostics)) preload_shell(model, *given, shell, group);
  }
}

void ShellForces::preload_shell(const Model& model, const InitialStress& given, Index shell, Group& group) {
  const PartIndex part = group.elements.part_of(shell);
  const ShellProperties& p = *group.properties[part];
  const ShellSection& section = model.sections[model.parts[part].section].shell;
  const Law& law = laws_[part];
  const auto x = gather_coordinates(model.nodes.x, model.shells.nodes[shell]);
  const Mat3 frame = shell_frame(x);
  const bool membrane = formulations_[part].membrane;
  const double volume = shell_area(x) * mean_thickness(model, shell);
  double* const values = group.elements.values_of(shell);
  const std::size_t per_point = shell_point_values(law.history());
  double energy = 0;
  for (int g = 0; g < p.in_plane; ++g) {
    for (int i = 0; i < p.points; ++i) {
      const double t = p.zeta[i] + (membrane ? 0.0 : section.nloc);
      const PointPreload point = shell_preload(given, t, g, p.in_plane);
      StressVector s = given.local ? point.stress : in_axes(point.stress, frame);
      s[2] = 0;  // plane stress
      if (membrane) s[4] = s[5] = 0;
      double* const own = values + static_cast<std::size_t>(g * p.points + i) * per_point * block_lanes;
      energy += volume * 0.5 * p.weight[i] / p.in_plane * elastic_energy(law, s, membrane ? 0.0 : section.shrf);
      for (std::size_t c = 0; const double stress : {s[0], s[1], s[3], s[4], s[5]}) own[block_lanes * c++] = stress;
      preload_history(law, point.plastic_strain, own + 5 * block_lanes);
    }
  }
  group.elements.add_energy(shell, energy);
}

void ShellForces::internal_forces(const Model& model, State& state) {
  const auto fault = [](const State&, Index) { return "has no area or a value that is not finite"; };
  quads_.elements.internal_forces(model, state, fault);
  triangles_.elements.internal_forces(model, state, fault);
}

void ShellForces::add_forces(State& state, NodeIndex begin, NodeIndex end) const {
  quads_.elements.add_forces(state, begin, end);
  triangles_.elements.add_forces(state, begin, end);
}

const Governing& ShellForces::governing() const {
  const Governing &a = quads_.elements.governing(), &b = triangles_.elements.governing();
  return b.time_step < a.time_step ? b : a;
}

void ShellForces::add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
  quads_.elements.add_energies(internal, hourglass);
  triangles_.elements.add_energies(internal, hourglass);
}

bool ShellForces::stress(Index shell, int point, double (&s)[5]) const {
  const Group& group = group_of(shell);
  const double* own = group.elements.values_of(shell);
  if (own == nullptr) return false;
  const PartIndex part = group.elements.part_of(shell);
  const ShellProperties& p = *group.properties[part];
  const std::size_t per_point = shell_point_values(laws_[part].history());
  for (std::size_t c = 0; c < 5; ++c) {
    s[c] = 0;
    for (int g = 0; g < p.in_plane; ++g) s[c] += own[(static_cast<std::size_t>(g * p.points + point) * per_point + c) * block_lanes] / p.in_plane;
  }
  return true;
}

}  // namespace kardan

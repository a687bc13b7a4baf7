#include "kardan/elements/shell/shell_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "kardan/elements/free_sides.hpp"
#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/lumped_mass.hpp"

namespace kardan {

namespace {

constexpr int elform_belytschko_tsay = 2;

/// How many of an element's points must fail before it is deleted.
double failing_points(const ElementDeletion& deletion, int points) {
  if (deletion.points == 0) return points;
  const double count = deletion.points > 0 ? deletion.points : std::ceil(-deletion.points / 100 * points - 1e-9);
  return std::clamp(count, 1.0, static_cast<double>(points));
}

ShellProperties properties_of(const Model& model, const Part& part, const Law& law) {
  const ShellSection& section = model.sections[part.section].shell;
  const double rho = law.density, e = law.youngs_modulus, nu = law.poissons_ratio;
  const double transverse = section.shrf * law.shear;  // k G
  ShellProperties p;
  p.law = {law.constants.get(), law.update, law.history(), 0};
  p.points = section.nip > 0 ? section.nip : 2;
  gauss_rule(p.points, p.zeta, p.weight);
  for (int i = 0; i < p.points; ++i) p.zeta[i] -= section.nloc;  // NLOC = 1: the nodes lie on the top surface
  p.wave_speed = std::sqrt(e / (rho * (1 - nu * nu)));
  p.side_lengths = model.control.time_step.isdo != 1;
  p.failing_points = failing_points(law.deletion, p.points);
  const HourglassChoice h = hourglass_of(model, part);
  p.stiffness_hourglass = h.stiffness();
  const double shear_ratio = e > 0 ? transverse / e : 0.0;  // k G / E; shells of *MAT_NULL have neither
  if (p.stiffness_hourglass) {
    p.hourglass_membrane = h.membrane * e / 8;
    p.hourglass_bending = h.bending * e / 192;
    p.hourglass_warping = h.warping * transverse / 12;
  } else {
    const double viscous = rho * p.wave_speed / 4;
    p.hourglass_membrane = h.membrane * viscous;
    p.hourglass_bending = h.bending * viscous / 24;
    p.hourglass_warping = h.warping * viscous * shear_ratio * 2 / 3;
  }
  return p;
}

std::vector<Index> deformable_shells(const Model& model) {
  std::vector<Index> elements;
  for (std::size_t e = 0; e < model.shells.size(); ++e) {
    const Part& part = model.parts[model.shells.part[e]];
    if (part.section != none && part.material != none && !model.rigid_part(model.shells.part[e])) {
      elements.push_back(static_cast<Index>(e));
    }
  }
  return elements;
}

TileElements cut(const Model& model) {
  const std::vector<Index> elements = deformable_shells(model);
  const std::span<const NodeIndex> flat(model.shells.size() == 0 ? nullptr : model.shells.nodes.front().data(), model.shells.size() * 4);
  return TileElements({"shells", "shell", ElementKind::shell, model.shells.id, {elements, model.shells.part, flat, 4, model.nodes.x}, 6},
                      model.nodes.size());
}

}  // namespace

void gauss_rule(int n, double* points, double* weights) {
  for (int i = 0; i < n; ++i) {
    // Newton's method on the Legendre polynomial from the usual estimate of its roots.
    double x = std::cos(std::numbers::pi * (n - i - 0.25) / (n + 0.5)), slope = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points[i] = std::abs(x) < 1e-15 ? 0.0 : x;
    weights[i] = 2 / ((1 - x * x) * slope * slope);
  }
}

ShellForces::ShellForces(const Model& model, State& state, Diagnostics& diagnostics)
    : elements_(cut(model)), laws_(model.parts.size()), properties_(model.parts.size()) {
  bool good = true;
  for (const PartIndex part : elements_.parts()) good = set_up_part(model, part, diagnostics) && good;
  if (!good) return;
  elements_.start(state);
  start_histories(model);
}

void ShellForces::start_histories(const Model& model) {
  elements_.for_each([&](Index shell, PartIndex part, double* own) {
    const Law& law = laws_[part];
    const int points = properties_[part]->points;
    const std::size_t per_point = shell_point_values(law.history());
    for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) {
      for (std::size_t k = 0; k < law.history(); ++k) own[(i * per_point + 5 + k) * block_lanes] = law.start[k];
    }
    own[(shell_history_size(points, law.history()) - 1) * block_lanes] = mean_thickness(model, shell);
  });
  const std::vector<std::uint8_t> edges = free_edges(model.shells);
  elements_.scale_steps([&](Index shell, PartIndex part) {
    const Law& law = laws_[part];
    const ShellSection& section = model.sections[model.parts[part].section].shell;
    const double thickness = mean_thickness(model, shell);
    const FreeBody body{law.density + section.mass_per_area / thickness, law.shear, law.longitudinal, section.shrf * law.shear};
    return free_shell_factor(model, shell, edges[shell], body, thickness);
  });
}

bool ShellForces::set_up_part(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  const std::string name = "part " + std::to_string(part.id);
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error(name + " has deformable shells of " + what + ", which this version does not compute", cure, keyword);
    good = false;
  };
  std::optional<Law> law = make_law(model, part, LawUse::shell, section.shell.shrf, diagnostics);
  if (!law) good = false;
  if (section.kind != ElementKind::shell) return false;  // the lumped masses have complained
  if (section.shell.elform != elform_belytschko_tsay && section.shell.elform != 0) {
    refuse("ELFORM = " + std::to_string(section.shell.elform) + " (section " + std::to_string(section.id) + ")",
           "use ELFORM = 2", "*SECTION_SHELL");
  }
  if (section.shell.nip > static_cast<int>(max_shell_points)) {
    refuse("NIP = " + std::to_string(section.shell.nip), "use at most " + std::to_string(max_shell_points) + " points",
           "*SECTION_SHELL");
  }
  if (model.control.shell_istupd != 0) {
    diagnostics.warning("ISTUPD = " + std::to_string(model.control.shell_istupd) + ": the thickness of " + name +
                            " stays what it is; this version does not change it with membrane strain",
                        {}, "*CONTROL_SHELL");
  }
  if (model.control.shell_bwc == 1) {
    diagnostics.warning("BWC = 1: " + name + " is computed without the stiffness of Belytschko, Wong and Chiang for warped shells",
                        {}, "*CONTROL_SHELL");
  }
  if (!good) return false;
  laws_[p] = std::move(*law);
  properties_[p] = std::make_shared<const ShellProperties>(properties_of(model, part, laws_[p]));
  elements_.set_kernel(p, {kernel_for(belytschko_tsay(), laws_[p]), properties_[p],
                           shell_history_size(properties_[p]->points, laws_[p].history()), laws_[p].can_fail,
                           laws_[p].deletion.step});
  return true;
}

void ShellForces::internal_forces(const Model& model, State& state) {
  elements_.internal_forces(model, state, [](const State&, Index) { return "has no area or a value that is not finite"; });
}

bool ShellForces::stress(Index shell, int point, double (&s)[5]) const {
  const double* own = elements_.values_of(shell);
  if (own == nullptr) return false;
  const std::size_t per_point = shell_point_values(laws_[elements_.part_of(shell)].history());
  for (std::size_t c = 0; c < 5; ++c) s[c] = own[(static_cast<std::size_t>(point) * per_point + c) * block_lanes];
  return true;
}

}  // namespace kardan

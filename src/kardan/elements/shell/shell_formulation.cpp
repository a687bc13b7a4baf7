#include "kardan/elements/shell/shell_formulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/tiles/tile_elements.hpp"

namespace kardan {

namespace {

/// Legendre polynomials of degree n and n - 1 at x.
struct Legendre {
  double now = 1, before = 0;
};
Legendre legendre(int n, double x) {
  Legendre p;
  for (int k = 1; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * p.now - (k - 1) * p.before) / k;
    p.before = p.now;
    p.now = next;
  }
  return p;
}

/// The r of Belytschko, Lin and Tsay's stiffness control (belytschko_tsay.hpp) per QM, QB, QW of IHQ 4 and 5. Their formulas are published, LS-DYNA's
/// measure for QM is not: it was read from repeated LS-DYNA runs of one crash, and tested on others (docs/theory/hourglass.md).
constexpr double stiffness_share = 1.0 / 64;

void set_hourglass(const Model& model, const Part& part, const Law& law, double transverse, ShellProperties& p) {
  const HourglassChoice h = hourglass_of(model, part);
  const double e = law.youngs_modulus;
  p.stiffness_hourglass = h.stiffness();
  if (p.stiffness_hourglass) {
    p.hourglass_membrane = stiffness_share * h.membrane * e / 8;
    p.hourglass_bending = stiffness_share * h.bending * e / 192;
    p.hourglass_warping = stiffness_share * h.warping * transverse / 12;
  } else {
    const double viscous = law.density * p.wave_speed / 4;
    p.hourglass_membrane = h.membrane * viscous;
    p.hourglass_bending = h.bending * viscous / 24;
    p.hourglass_warping = h.warping * viscous * (e > 0 ? transverse / e : 0.0) * 2 / 3;  // shells of *MAT_NULL have neither
  }
}

}  // namespace

bool find_formulation(const Section& section, const std::string& name, Diagnostics& diagnostics, ShellFormulation& formulation) {
  const int elform = section.shell.elform;
  formulation.fully_integrated = elform == 9 || elform == 16;
  formulation.triangles = elform == 4;
  formulation.membrane = elform == 5 || elform == 9;
  if (elform == 2 || formulation.fully_integrated || formulation.triangles || formulation.membrane) return true;
  diagnostics.error(name + " has deformable shells of ELFORM = " + std::to_string(elform) + " (section " + std::to_string(section.id) +
                        "), which this version does not compute",
                    "use ELFORM = 2 (Belytschko-Tsay), 16 (fully integrated), 4 (C0 triangle), or 5, 9 (membranes)", "*SECTION_SHELL");
  return false;
}

bool sorts_triangles(const Model& model, const ShellFormulation& formulation) {
  return formulation.triangles || formulation.fully_integrated || model.control.shell_esort == 1;
}

void gauss_rule(int n, double* points, double* weights) {
  for (int i = 0; i < n; ++i) {
    // Newton's method on the Legendre polynomial from the usual estimate of its roots.
    double x = std::cos(std::numbers::pi * (n - i - 0.25) / (n + 0.5)), slope = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre p = legendre(n, x);
      slope = n * (x * p.now - p.before) / (x * x - 1);
      const double step = p.now / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points[i] = std::abs(x) < 1e-15 ? 0.0 : x;
    weights[i] = 2 / ((1 - x * x) * slope * slope);
  }
}

void lobatto_rule(int n, double* points, double* weights) {
  const int m = n - 1;  // the inner points are the extrema of the Legendre polynomial of degree m
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * i / m);
    for (int iteration = 0; iteration < 100 && i > 0 && i < m; ++iteration) {
      const Legendre p = legendre(m, x);
      // (1 - x^2) P'' = 2 x P' - m (m + 1) P
      const double slope = m * (x * p.now - p.before) / (x * x - 1), curvature = (2 * x * slope - m * (m + 1) * p.now) / (1 - x * x);
      const double step = slope / curvature;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points[i] = std::abs(x) < 1e-15 ? 0.0 : x;
    const double value = legendre(m, points[i]).now;
    weights[i] = 2 / (m * n * value * value);
  }
}

ThicknessRule thickness_rule(const Model& model, const ShellSection& section) {
  ThicknessRule rule;
  if (section.rule != none) {
    const ShellRule& own = model.shell_rules[section.rule];
    double sum = 0;
    for (int i = 0; i < own.points; ++i) {
      const auto k = static_cast<std::size_t>(i);
      rule.points.push_back(own.equal ? (2.0 * i + 1) / own.points - 1 : own.s[k]);
      rule.weights.push_back(own.equal ? 1.0 : own.weight[k]);
      sum += rule.weights.back();
    }
    for (double& w : rule.weights) w *= 2 / sum;
    return rule;
  }
  const int n = section.nip > 0 ? section.nip : 2;
  rule.points.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  if (n > 10) {
    for (int i = 0; i < n; ++i) {
      rule.points[static_cast<std::size_t>(i)] = 2.0 * i / (n - 1) - 1;
      rule.weights[static_cast<std::size_t>(i)] = (i == 0 || i == n - 1 ? 1.0 : 2.0) / (n - 1);
    }
  } else if (model.control.shell_lobatto && n >= 3) {
    lobatto_rule(n, rule.points.data(), rule.weights.data());
  } else {
    gauss_rule(n, rule.points.data(), rule.weights.data());
  }
  return rule;
}

ShellProperties shell_properties(const Model& model, const Part& part, const Law& law, const ShellFormulation& formulation, bool triangles) {
  const ShellSection& section = model.sections[part.section].shell;
  const double e = law.youngs_modulus, nu = law.poissons_ratio;
  ShellProperties p;
  p.law = {law.constants.get(), law.update, law.history(), 0};
  const ThicknessRule rule = formulation.membrane ? ThicknessRule{{0.0}, {2.0}} : thickness_rule(model, section);
  p.points = static_cast<int>(rule.points.size());
  for (std::size_t i = 0; i < rule.points.size(); ++i) {
    p.zeta[i] = rule.points[i] - (formulation.membrane ? 0.0 : section.nloc);  // NLOC = 1: the nodes lie on the top surface
    p.weight[i] = rule.weights[i];
  }
  p.wave_speed = std::sqrt(e / (law.density * (1 - nu * nu)));
  p.failing_points = failing_points(law.deletion, p.points);
  p.side_lengths = model.control.time_step.isdo != 1;
  p.in_plane = formulation.fully_integrated && !triangles ? 4 : 1;
  p.cross_strain = -nu;
  p.thins = model.control.shell_istupd == 1 || model.control.shell_istupd == 3 || model.control.shell_istupd == 4;
  p.elastic_thinning = model.control.shell_istupd == 4 && e > 0 ? nu / e : 0.0;
  set_hourglass(model, part, law, formulation.membrane ? 0.0 : section.shrf * law.shear, p);
  if (formulation.membrane) p.hourglass_bending = p.hourglass_warping = 0;
  return p;
}

}  // namespace kardan

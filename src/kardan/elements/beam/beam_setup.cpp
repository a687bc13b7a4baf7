#include "kardan/elements/beam/beam_setup.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kardan/elements/shell/shell_forces.hpp"

namespace kardan {

namespace {

/// A rule on [-1, 1] with weights of sum 1.
struct LineRule {
  std::vector<double> points, weights;
};

LineRule line_rule(int rule) {
  if (rule == 4) return {{-1, 0, 1}, {1.0 / 6, 2.0 / 3, 1.0 / 6}};  // Lobatto
  const std::size_t n = rule == 5 ? 4 : static_cast<std::size_t>(rule);
  LineRule line{std::vector<double>(n), std::vector<double>(n)};
  gauss_rule(static_cast<int>(n), line.points.data(), line.weights.data());
  for (double& w : line.weights) w *= 0.5;
  return line;
}

/// Whether the section is the same in all directions across the axis.
bool symmetric(const BeamSection& s) {
  if (s.elform == beam_elform::truss) return true;
  const BeamMoments m = beam_moments(s);
  const bool round = std::abs(m.ss - m.tt) <= 1e-9 * std::max(m.ss, m.tt);
  return s.elform == beam_elform::belytschko_schwer ? round && s.shear_s == s.shear_t : round;
}

}  // namespace

void integration_points(const BeamSection& section, BeamProperties& p) {
  p.points = 0;
  const auto add = [&](double s, double t, double weight) {
    p.s[p.points] = s;
    p.t[p.points] = t;
    p.weight[p.points++] = weight;
  };
  if (section.rule == 1) return add(0, 0, 1);
  if (section.cst == 1) {
    const int count = section.rule == 2 ? 4 : section.rule == 5 ? 16 : 9;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      add(std::cos(angle), std::sin(angle), 1.0 / count);
    }
    return;
  }
  const LineRule line = line_rule(section.rule);
  for (std::size_t j = 0; j < line.points.size(); ++j) {
    for (std::size_t i = 0; i < line.points.size(); ++i) add(line.points[i], line.points[j], line.weights[i] * line.weights[j]);
  }
}

std::array<double, beam_history::constants> section_constants(const BeamSection& s, const Law& law, double length) {
  const double area = beam_area(s);
  if (s.elform == beam_elform::truss) return {area};
  const BeamMoments m = beam_moments(s);
  const double e = law.youngs_modulus, g = law.shear;
  if (s.elform == beam_elform::belytschko_schwer) {
    const auto phi = [&](double moment, double shear_area) {
      return shear_area > 0 ? 12 * e * moment / (g * shear_area * length * length) : 0.0;
    };
    const double torsion = s.j > 0 ? s.j : m.ss + m.tt;  // LS-DYNA's default
    const double phi_s = phi(m.ss, s.shear_s), phi_t = phi(m.tt, s.shear_t);
    return {e * area / length, g * torsion / length, e * m.ss / (length * (1 + phi_s)), phi_s, e * m.tt / (length * (1 + phi_t)), phi_t};
  }
  // The points of a tube lie on the circle that has the second moments of the section.
  const double ring = std::sqrt(2 * m.ss / area), width = std::sqrt(3 * m.tt / area), height = std::sqrt(3 * m.ss / area);
  return {s.cst == 1 ? ring : width, s.cst == 1 ? ring : height, area, m.ss, m.tt};
}

std::optional<Vec3> initial_axis(const Model& model, Index beam, const BeamSection& section) {
  const auto e = static_cast<std::size_t>(beam);
  const auto& n = model.beams.nodes[e];
  const Vec3 origin = model.nodes.x[static_cast<std::size_t>(n[0])];
  const Vec3 r = normalized(model.nodes.x[static_cast<std::size_t>(n[1])] - origin);
  Vec3 in_plane;
  if (const auto vector = model.beams.orientation.find(beam); vector != model.beams.orientation.end())
    in_plane = vector->second;
  else if (n[2] != none)
    in_plane = model.nodes.x[static_cast<std::size_t>(n[2])] - origin;
  const Vec3 across = in_plane - r * dot(r, in_plane);
  if (norm(across) > 1e-6 * norm(in_plane)) return normalized(across);
  if (!symmetric(section)) return std::nullopt;
  const Vec3 size{std::abs(r.x), std::abs(r.y), std::abs(r.z)};
  const Vec3 least = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0} : size.y <= size.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalized(least - r * dot(r, least));
}

}  // namespace kardan

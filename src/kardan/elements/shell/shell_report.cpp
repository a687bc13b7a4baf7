// What D3PLOT and ELOUT show of shells.
#include <algorithm>
#include <array>

#include "kardan/elements/geometry.hpp"
#include "kardan/elements/lumped_mass.hpp"
#include "kardan/elements/shell/shell_forces.hpp"

namespace kardan {

namespace {

/// Values of an element that lie block_lanes apart.
struct Values {
  const double* first;
  double operator[](std::size_t i) const { return first[i * block_lanes]; }
  Values from(std::size_t i) const { return {first + i * block_lanes}; }
};

/// One point: stresses xx, yy, xy, yz, zx in the element's axes.
struct LocalPoint {
  std::array<double, 5> stress{};
  double plastic_strain = 0;

  LocalPoint& operator+=(const LocalPoint& b) {
    for (std::size_t c = 0; c < 5; ++c) stress[c] += b.stress[c];
    plastic_strain += b.plastic_strain;
    return *this;
  }
  friend LocalPoint operator*(LocalPoint a, double f) {
    for (double& s : a.stress) s *= f;
    a.plastic_strain *= f;
    return a;
  }
};

/// Points through the thickness from the inside out, each the mean over the plane (one point stays what it is to the last bit).
std::vector<LocalPoint> points_of(const ShellProperties& p, const Law& law, const Values& own) {
  std::vector<LocalPoint> points(static_cast<std::size_t>(p.points));
  const std::size_t per_point = shell_point_values(law.history());
  const auto in_plane = static_cast<std::size_t>(p.in_plane);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t g = 0; g < in_plane; ++g) {
      const Values at = own.from((g * points.size() + i) * per_point);
      LocalPoint point{{at[0], at[1], at[2], at[3], at[4]}};
      if (law.plastic_strain != Law::npos) point.plastic_strain = at[5 + law.plastic_strain];
      points[i] += point;
    }
    if (in_plane > 1) points[i] = points[i] * (1.0 / static_cast<double>(in_plane));
  }
  return points;
}

StressVector local_vector(const std::array<double, 5>& s) { return {s[0], s[1], 0.0, s[2], s[3], s[4]}; }

/// The stress in global axes: Q s Q^T with the element's axes as columns of Q.
StressVector global_vector(const std::array<double, 5>& s, const Mat3& q) {
  const Mat3 full{{{{s[0], s[2], s[4]}, {s[2], s[1], s[3]}, {s[4], s[3], 0.0}}}};
  const Mat3 g = q * full * transpose(q);
  return {g[0].x, g[1].y, g[2].z, g[0].y, g[1].z, g[2].x};
}

/// D3PLOT's layer. MAXINT = 3: mid surface (of an even number of points the mean of the inner two), innermost, outermost; else the first MAXINT
/// points.
LocalPoint layer_of(const std::vector<LocalPoint>& points, std::size_t layer, std::size_t layers) {
  const std::size_t n = points.size();
  if (layers != 3) return layer < n ? points[layer] : LocalPoint{};
  if (layer == 1) return points.front();
  if (layer == 2) return points.back();
  LocalPoint mid = points[(n - 1) / 2];
  mid += points[n / 2];
  return mid * 0.5;
}

void set_resultants(const ShellProperties& p, const std::vector<LocalPoint>& points, double thickness, ShellResults& r, std::size_t e) {
  Vec3 bending, membrane;
  std::array<double, 2> shear{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& s = points[i].stress;
    const double w = 0.5 * thickness * p.weight[i], z = 0.5 * thickness * p.zeta[i];
    const Vec3 in_plane{s[0], s[1], s[2]};
    membrane += in_plane * w;
    bending += in_plane * (w * z);
    shear[0] += w * s[4];
    shear[1] += w * s[3];
  }
  r.bending[e] = bending;
  r.membrane[e] = membrane;
  r.shear[e] = shear;
}

void resize(ShellResults& r, const Model& model) {
  const std::size_t n = model.shells.size(), layers = static_cast<std::size_t>(r.layers);
  if (r.thickness.size() == n) return;
  r.stress.assign(n * layers, StressVector{});
  r.plastic_strain.assign(n * layers, 0.0);
  r.bending.assign(n, Vec3{});
  r.membrane.assign(n, Vec3{});
  r.shear.assign(n, {});
  r.internal_energy.assign(n, 0.0);
  r.thickness.resize(n);
  for (std::size_t e = 0; e < n; ++e) r.thickness[e] = mean_thickness(model, static_cast<Index>(e));
}

}  // namespace

void ShellForces::report(const Model& model, State& state) const {
  if (quads_.elements.empty() && triangles_.elements.empty()) return;
  resize(state.results.shell, model);
  report_group(model, state, quads_);
  report_group(model, state, triangles_);
  report_histories(model, state);
}

void ShellForces::report_group(const Model& model, State& state, const Group& group) const {
  ShellResults& r = state.results.shell;
  const auto layers = static_cast<std::size_t>(r.layers);
  group.elements.for_each([&](Index shell, PartIndex part, const double* values) {
    const auto e = static_cast<std::size_t>(shell);
    const Values own{values};
    const ShellProperties& p = *group.properties[part];
    const bool alive = group.elements.alive(shell) > 0;
    if (!r.alive.empty()) r.alive[e] = alive;
    std::vector<LocalPoint> points = points_of(p, laws_[part], own);
    if (!alive) {
      for (LocalPoint& point : points) point.stress = {};
    }
    const double thickness = own[shell_kept(p, laws_[part].history()) + kept_thickness];
    const Mat3 frame = shell_frame(gather_coordinates(state.nodes.x, model.shells.nodes[e]));
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const LocalPoint point = layer_of(points, layer, layers);
      r.stress[e * layers + layer] = alive ? global_vector(point.stress, frame) : StressVector{};
      r.plastic_strain[e * layers + layer] = point.plastic_strain;
    }
    set_resultants(p, points, thickness, r, e);
    const double volume = shell_area(gather_coordinates(model.nodes.x, model.shells.nodes[e])) * mean_thickness(model, shell);
    r.internal_energy[e] = group.elements.energy(shell) / volume;
    r.thickness[e] = thickness;
  });
}

void ShellForces::report_histories(const Model& model, State& state) const {
  auto& histories = state.results.shell.history;
  histories.resize(model.output.history_shells.size());
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const Index shell = model.output.history_shells[i];
    histories[i].clear();
    const Group& group = group_of(shell);
    const double* values = group.elements.values_of(shell);
    if (values == nullptr || !(group.elements.alive(shell) > 0)) continue;
    const PartIndex part = group.elements.part_of(shell);
    const Mat3 frame = shell_frame(gather_coordinates(state.nodes.x, model.shells.nodes[shell]));
    for (const LocalPoint& point : points_of(*group.properties[part], laws_[part], Values{values})) {
      histories[i].push_back({model.output.global_shell_axes ? global_vector(point.stress, frame) : local_vector(point.stress), point.plastic_strain});
    }
  }
}

}  // namespace kardan

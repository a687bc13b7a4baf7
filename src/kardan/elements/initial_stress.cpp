#include "kardan/elements/initial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace kardan {

namespace {

using Point = InitialStress::Point;

constexpr double same_place = 1e-6;  ///< of two points through the thickness

PointPreload mean_of(const std::vector<Point>& points, std::size_t first, std::size_t count) {
  PointPreload mean;
  for (std::size_t i = first; i < first + count; ++i) {
    for (std::size_t c = 0; c < 6; ++c) mean.stress[c] += points[i].stress[c] / static_cast<double>(count);
    mean.plastic_strain += points[i].plastic_strain / static_cast<double>(count);
  }
  return mean;
}

struct Layer {
  double t;
  PointPreload value;
};

/// The layers that are given, from the inside out, each at one point in the plane.
std::vector<Layer> layers_of(const InitialStress& given, int plane, int planes) {
  std::vector<Point> sorted = given.points;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) { return a.t < b.t - same_place; });
  const auto per_layer = static_cast<std::size_t>(given.planes);
  std::vector<Layer> layers;
  for (std::size_t first = 0; first + per_layer <= sorted.size(); first += per_layer) {
    const bool one_of_four = given.planes == 4 && planes == 4;
    const std::size_t begin = first + (one_of_four ? static_cast<std::size_t>(plane) : 0);
    layers.push_back({sorted[first].t, mean_of(sorted, begin, one_of_four ? 1 : per_layer)});
  }
  return layers;
}

}  // namespace

std::vector<std::pair<Index, const InitialStress*>> initial_stresses_of(const Model& model, ElementKind kind) {
  std::map<Index, const InitialStress*> last;
  for (const InitialStress& given : model.initial_stresses) {
    if (given.kind != kind) continue;
    for (const Index element : given.elements) last[element] = &given;
  }
  return {last.begin(), last.end()};
}

bool PreloadCheck::takes(const Model& model, PartIndex p, const Law& law, const InitialStress& given, Diagnostics& diagnostics) {
  const bool first = !told_[static_cast<std::size_t>(p)];
  const bool lost = given.histories && law.remembers;
  const std::string name = "part " + std::to_string(model.parts[static_cast<std::size_t>(p)].id);
  if (first && !law.preload) {
    diagnostics.error(name + " is given an initial stress; the stress of its material follows from the whole deformation",
                      "take the initial stress away, or use a material of stress rates", "*INITIAL_STRESS");
  } else if (first && lost) {
    diagnostics.error(name + " is given history variables; LS-DYNA's of its material (back stress, temperature, damage …) are not known to Kardan",
                      "set NHISV = 0: the histories then begin as those of a new material", "*INITIAL_STRESS");
  } else if (first && given.histories) {
    diagnostics.warning("history variables of " + name + " are left out: its material has no other than the plastic strain, EPS", {}, "*INITIAL_STRESS");
  }
  if (!law.preload || given.histories) told_[static_cast<std::size_t>(p)] = 1;
  return law.preload && !lost;
}

PointPreload shell_preload(const InitialStress& given, double t, int plane, int planes) {
  const std::vector<Layer> layers = layers_of(given, plane, planes);
  if (layers.size() == 1) return layers.front().value;
  std::size_t i = 0;
  while (i + 2 < layers.size() && t > layers[i + 1].t) ++i;
  const Layer &a = layers[i], &b = layers[i + 1];
  const double share = (t - a.t) / (b.t - a.t), inside = std::clamp(share, 0.0, 1.0);
  PointPreload point;
  for (std::size_t c = 0; c < 6; ++c) point.stress[c] = a.value.stress[c] + share * (b.value.stress[c] - a.value.stress[c]);
  point.plastic_strain = a.value.plastic_strain + inside * (b.value.plastic_strain - a.value.plastic_strain);
  return point;
}

PointPreload solid_preload(const InitialStress& given, std::size_t point, std::size_t points) {
  static constexpr std::array<std::size_t, 8> node_of{0, 1, 3, 2, 4, 5, 7, 6};  // by bits of r, s, t
  if (given.points.size() == points) return mean_of(given.points, points == 8 ? node_of[point] : point, 1);
  return mean_of(given.points, 0, given.points.size());
}

StressVector in_axes(const StressVector& s, const Mat3& axes) {
  const Mat3 full{{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}};
  const Mat3 own = transpose(axes) * full * axes;
  return {own[0].x, own[1].y, own[2].z, own[0].y, own[1].z, own[2].x};
}

void preload_history(const Law& law, double plastic_strain, double* values) {
  std::vector<double> history(law.history());
  for (std::size_t k = 0; k < history.size(); ++k) history[k] = values[k * block_lanes];
  law.preload(plastic_strain, history.data());
  for (std::size_t k = 0; k < history.size(); ++k) values[k * block_lanes] = history[k];
}

double elastic_energy(const Law& law, const StressVector& s, double shear_factor) {
  if (!(law.youngs_modulus > 0)) return 0;
  const double e = law.youngs_modulus, nu = law.poissons_ratio, trace = s[0] + s[1] + s[2];
  const double normal = ((1 + nu) * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) - nu * trace * trace) / (2 * e);
  const double transverse = shear_factor > 0 ? (s[4] * s[4] + s[5] * s[5]) / shear_factor : 0.0;
  return normal + (s[3] * s[3] + transverse) / (2 * law.shear);
}

}  // namespace kardan

#include "kardan/io/deck/build/measure.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <variant>

#include "kardan/model/beam_sections.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

bool complete(const auto& nodes, std::size_t needed) {
  return std::all_of(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(needed),
                     [](NodeIndex n) { return n != none; });
}

double shell_thickness(const Model& model, Index e) {
  const auto own = model.shells.thickness.find(e);
  if (own != model.shells.thickness.end()) {
    return 0.25 * (own->second[0] + own->second[1] + own->second[2] + own->second[3]);
  }
  const Index section = model.parts[at(model.shells.part[at(e)])].section;
  if (section == none) return 0;
  const auto& t = model.sections[at(section)].shell.thickness;
  return 0.25 * (t[0] + t[1] + t[2] + t[3]);
}

/// Calls f(part, mass, nodes, count) for each element that has mass.
template <class F>
void for_each_mass(const Model& model, F&& f) {
  const auto part_density = [&](PartIndex p) { return p == none ? 0.0 : density(model, model.parts[at(p)].material); };
  for (std::size_t e = 0; e < model.shells.size(); ++e) {
    const PartIndex p = model.shells.part[e];
    if (p == none || !complete(model.shells.nodes[e], 4)) continue;
    const Index section = model.parts[at(p)].section;
    const double per_area = section == none ? 0.0 : model.sections[at(section)].shell.mass_per_area;
    const auto i = static_cast<Index>(e);
    const auto& n = model.shells.nodes[e];
    f(p, shell_area(model, i) * (part_density(p) * shell_thickness(model, i) + per_area), n.data(),
      n[3] == n[2] ? 3 : 4);
  }
  for (std::size_t e = 0; e < model.solids.size(); ++e) {
    const PartIndex p = model.solids.part[e];
    if (p == none || !complete(model.solids.nodes[e], 8)) continue;
    const auto& n = model.solids.nodes[e];
    f(p, solid_volume(model, static_cast<Index>(e)) * part_density(p), n.data(), 8);
  }
  for (std::size_t e = 0; e < model.beams.size(); ++e) {
    const PartIndex p = model.beams.part[e];
    if (p == none || !complete(model.beams.nodes[e], 2)) continue;
    const Index section = model.parts[at(p)].section;
    if (section == none) continue;
    const auto i = static_cast<Index>(e);
    f(p, beam_volume(beam_section(model, i), beam_length(model, i)) * part_density(p), model.beams.nodes[e].data(), 2);
  }
}

}  // namespace

double shell_area(const Model& model, Index element) {
  const auto& n = model.shells.nodes[at(element)];
  const auto& x = model.nodes.x;
  return 0.5 * norm(cross(x[at(n[2])] - x[at(n[0])], x[at(n[3])] - x[at(n[1])]));
}

double solid_volume(const Model& model, Index element) {
  const auto& n = model.solids.nodes[at(element)];
  const auto& x = model.nodes.x;
  if (n[4] == n[3] && n[5] == n[3] && n[6] == n[3] && n[7] == n[3]) {  // tetrahedron: the "face" 1-2-3-4 is not flat
    const Vec3 o = x[at(n[0])];
    return dot(x[at(n[1])] - o, cross(x[at(n[2])] - o, x[at(n[3])] - o)) / 6;
  }
  // The surface as triangles, each quadrilateral cut both ways and averaged; divergence theorem about node 1.
  static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  double six_volumes = 0;
  for (const auto& face : faces) {
    std::array<Vec3, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) p[i] = x[at(n[face[i]])] - x[at(n[0])];
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) { return dot(p[a], cross(p[b], p[c])); };
    six_volumes += 0.5 * (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(0, 1, 3) + triangle(1, 2, 3));
  }
  return six_volumes / 6;
}

double beam_length(const Model& model, Index element) {
  const auto& n = model.beams.nodes[at(element)];
  return norm(model.nodes.x[at(n[1])] - model.nodes.x[at(n[0])]);
}

double density(const Model& model, Index material) {
  if (material == none) return 0;
  return std::visit(
      [](const auto& law) {
        if constexpr (requires { law.density; })
          return law.density;
        else
          return 0.0;
      },
      model.materials[at(material)].law);
}

std::vector<double> meshed_masses(const Model& model) {
  std::vector<double> mass(model.parts.size(), 0.0);
  for_each_mass(model, [&](PartIndex p, double m, const NodeIndex*, int) { mass[at(p)] += m; });
  for (const PointMass& point : model.masses) {
    if (point.part != none) mass[at(point.part)] += point.mass;
  }
  return mass;
}

std::string distribute_mass(Model& model, const std::vector<PartIndex>& parts, double added, double final_mass,
                            bool weighted) {
  const std::set<PartIndex> wanted(parts.begin(), parts.end());
  std::map<NodeIndex, double> weight;
  double total = 0, mass = 0;
  for_each_mass(model, [&](PartIndex p, double m, const NodeIndex* nodes, int count) {
    if (!wanted.contains(p)) return;
    mass += m;
    for (int i = 0; i < count; ++i) {
      const double w = weighted ? m / count : 1.0;
      weight[nodes[i]] += w;
      total += w;
    }
  });
  if (!parts.empty() && !(total > 0)) return "the part has no elements with mass that could carry the added mass";
  const double amount = final_mass != 0 ? final_mass - mass : added;
  if (amount < 0) return "the part is already heavier than FINMASS";
  const PartIndex counted = parts.size() == 1 ? parts.front() : none;
  for (const auto& [node, w] : weight) model.masses.push_back({0, node, amount * w / total, counted});
  return {};
}

}  // namespace kardan::deck

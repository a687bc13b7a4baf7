#include "kardan/io/report/model_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <variant>

#include "kardan/io/deck/build/measure.hpp"

namespace kardan {

namespace {

using Out = std::back_insert_iterator<std::string>;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

struct LawName {
  std::string operator()(const RigidMaterial&) const { return "rigid"; }
  std::string operator()(const ElasticMaterial&) const { return "elastic"; }
  std::string operator()(const PiecewisePlasticMaterial&) const { return "piecewise linear plastic"; }
  std::string operator()(const SpringMaterial& m) const {
    static constexpr std::array<const char*, 8> names{
        "elastic spring",   "viscous damper",           "elastoplastic spring", "nonlinear elastic spring",
        "nonlinear damper", "general nonlinear spring", "Maxwell spring",       "inelastic spring"};
    return names[static_cast<std::size_t>(m.law)];
  }
  std::string operator()(const FieldMaterial& m) const { return m.keyword; }
  std::string operator()(const UnsupportedMaterial& m) const { return m.keyword + " (not available)"; }
};

std::string material_name(const Model& model, const Part& part) {
  if (part.nodal_rigid_body != none) return "nodal rigid body";
  if (part.material == none) return "no material";
  return std::visit(LawName{}, model.materials[at(part.material)].law);
}

/// "name   count" for every count that is not 0.
template <std::size_t N>
void write_lines(const std::array<std::pair<const char*, std::size_t>, N>& counts, Out out) {
  for (const auto& [name, count] : counts) {
    if (count != 0) fmt::format_to(out, "{:<20} {}\n", name, count);
  }
}

void write_mesh(const Model& model, Out out) {
  fmt::format_to(out, "nodes                {}\n", model.nodes.size());
  write_lines<6>({{{"shells", model.shells.size()},
                   {"solids", model.solids.size()},
                   {"beams", model.beams.size()},
                   {"springs and dampers", model.discretes.size()},
                   {"point masses", model.masses.size()},
                   {"point inertias", model.inertias.size()}}},
                 out);
  if (model.nodes.size() == 0) return;
  constexpr double huge = std::numeric_limits<double>::infinity();
  Vec3 low{huge, huge, huge}, high{-huge, -huge, -huge};
  for (const Vec3& x : model.nodes.x) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
  fmt::format_to(out, "extent               x {:g} to {:g}, y {:g} to {:g}, z {:g} to {:g}\n", low.x, high.x, low.y,
                 high.y, low.z, high.z);
}

std::vector<std::size_t> elements_by_part(const Model& model) {
  std::vector<std::size_t> elements(model.parts.size(), 0);
  const auto count = [&](const auto& block) {
    for (const PartIndex p : block.part) {
      if (p != none) ++elements[at(p)];
    }
  };
  count(model.shells);
  count(model.solids);
  count(model.beams);
  count(model.discretes);
  return elements;
}

void write_parts(const Model& model, Out out) {
  if (model.parts.empty()) return;
  constexpr std::size_t most = 200;
  const std::vector<double> masses = deck::meshed_masses(model);
  const std::vector<std::size_t> elements = elements_by_part(model);
  double total = 0;
  fmt::format_to(out, "\nparts                {}\n", model.parts.size());
  fmt::format_to(out, "{:>10}  {:>9}  {:>12}  {:<26} {}\n", "number", "elements", "mass", "material", "title");
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const auto& given =
        part.nodal_rigid_body == none ? part.inertia : model.nodal_rigid_bodies[at(part.nodal_rigid_body)].inertia;
    const double mass = given ? given->mass : masses[p];
    total += mass;
    if (p < most) {
      fmt::format_to(out, "{:>10}  {:>9}  {:>12.5g}  {:<26} {}{}\n", part.id, elements[p], mass,
                     material_name(model, part), part.title, given ? "  [given inertia]" : "");
    }
  }
  if (model.parts.size() > most) fmt::format_to(out, "           … and {} more\n", model.parts.size() - most);
  for (const PointMass& m : model.masses) total += m.part == none ? m.mass : 0.0;
  for (const PointInertia& m : model.inertias) total += m.mass;
  fmt::format_to(out, "mass                 {:.6g} (mesh, point masses, given inertias)\n", total);
}

void write_bodies(const Model& model, Out out) {
  std::size_t rigid = 0, given = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    rigid += model.rigid_part(static_cast<PartIndex>(p)) ? 1 : 0;
    given += model.parts[p].inertia ? 1 : 0;
  }
  fmt::format_to(out, "\n");
  write_lines<8>({{{"rigid parts", rigid},
                   {"  with given inertia", given},
                   {"nodal rigid bodies", model.nodal_rigid_bodies.size()},
                   {"merges", model.merges.size()},
                   {"extra node groups", model.extra_nodes.size()},
                   {"joint stiffnesses", model.joint_stiffnesses.size()},
                   {"stoppers", model.stoppers.size()},
                   {"joints", model.joints.size()}}},
                 out);
  std::map<std::string, std::size_t> kinds;
  for (const Joint& joint : model.joints) ++kinds[to_string(joint.kind)];
  for (const auto& [kind, count] : kinds) fmt::format_to(out, "  {:<18} {}\n", kind, count);
}

void write_conditions(const Model& model, Out out) {
  fmt::format_to(out, "\n");
  write_lines<6>({{{"body loads", model.body_loads.size()},
                   {"point loads", model.point_loads.size()},
                   {"prescribed motions", model.prescribed_motions.size()},
                   {"supports", model.constraints.size()},
                   {"initial velocities", model.initial_velocities.size()},
                   {"curves", model.curves.size()}}},
                 out);
  fmt::format_to(out, "end time             {:g}\n", model.control.termination.end_time);
  std::string files;
  for (const auto& [file, request] : model.output.requests) {
    files += fmt::format("{}{} (every {:g})", files.empty() ? "" : ", ", to_string(file), request.dt);
  }
  fmt::format_to(out, "results              {}\n", files.empty() ? "none asked for" : files);
}

}  // namespace

std::string model_report(const Model& model) {
  std::string text;
  const Out out(text);
  fmt::format_to(out, "title                {}\n", model.title.empty() ? "(none)" : model.title);
  write_mesh(model, out);
  write_parts(model, out);
  write_bodies(model, out);
  write_conditions(model, out);
  if (!model.unsupported.empty()) {
    fmt::format_to(out, "\nKardan cannot run this model ({} reasons, see the messages)\n", model.unsupported.size());
  }
  return text;
}

}  // namespace kardan

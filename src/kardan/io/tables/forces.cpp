// JNTFORC, BNDOUT, SPCFORC, RWFORC, SWFORC, DEFORC and SECFORC.
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "kardan/io/tables/reporter.hpp"

namespace kardan {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

Folder joints_folder(const Model& model, const State& state, const BodyFrames& frames) {
  const std::size_t n = state.joints.size();
  const auto local_body = [&](std::size_t i) {
    const PartIndex p = model.joints[i].local_body;
    return p == none ? none : state.bodies.of_part[static_cast<std::size_t>(p)];
  };
  const auto oriented = [&](std::size_t i, const Vec3& v) {
    const BodyIndex b = local_body(i);
    return b == none ? v : transpose(frames.axes(state, b)) * v;
  };
  Folder f;
  f.path = "/jntforc/joints";
  IntegerColumn ids{"ids", {}}, local{"local", {}};
  for (std::size_t i = 0; i < n; ++i) {
    ids.values.push_back(model.joints[i].id);
    local.values.push_back(local_body(i) == none ? 0 : 1);
    if (model.joints[i].title.empty()) continue;
    f.legend_ids.push_back(model.joints[i].id);
    f.legend.push_back(model.joints[i].title);
  }
  f.metadata = {std::move(ids), std::move(local)};
  const auto& joints = state.joints;
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return oriented(i, joints[i].force); });
  f.add_vectors("x_moment", "y_moment", "z_moment", n, [&](std::size_t i) { return oriented(i, joints[i].moment); });
  f.add_scalars("resultant_force", n, [&](std::size_t i) { return norm(joints[i].force); });
  f.add_scalars("resultant_moment", n, [&](std::size_t i) { return norm(joints[i].moment); });
  f.add_scalars("energy", n, [&](std::size_t i) { return joints[i].energy; });
  f.add_scalars("separation", n, [&](std::size_t i) { return joints[i].separation; });
  f.add_scalars("angular_separation", n, [&](std::size_t i) { return joints[i].angular_separation * degrees; });
  f.integers = {{"failed", {}}};
  for (const JointReport& j : joints) f.integers[0].values.push_back(j.failed);
  return f;
}

/// Stiffnesses of `kinds` with the columns of three coordinates: position, rate, elastic, damping, total.
struct StiffnessLayout {
  const char* path;
  std::vector<JointStiffnessKind> kinds;
  double unit;                                      ///< factor from the report's coordinates and rates
  std::array<std::array<const char*, 5>, 3> names;  ///< empty = not written
};

Folder stiffness_folder(const Model& model, const State& state, const StiffnessLayout& layout) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < state.joint_stiffnesses.size(); ++i)
    for (const JointStiffnessKind kind : layout.kinds)
      if (model.joint_stiffnesses[i].kind == kind) chosen.push_back(i);
  Folder f;
  f.path = layout.path;
  IntegerColumn ids{"ids", {}};
  for (const std::size_t i : chosen) ids.values.push_back(model.joint_stiffnesses[i].id);
  f.metadata.push_back(std::move(ids));
  const std::size_t n = chosen.size();
  const auto report = [&](std::size_t i) -> const JointStiffnessReport& { return state.joint_stiffnesses[chosen[i]]; };
  const auto put = [&](const char* name, auto&& value) {
    if (*name != '\0') f.add_scalars(name, n, value);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    put(layout.names[c][0], [&](std::size_t i) { return report(i).coordinate[c] * layout.unit; });
    put(layout.names[c][1], [&](std::size_t i) { return report(i).rate[c] * layout.unit; });
  }
  for (std::size_t c = 0; c < 3; ++c) {
    put(layout.names[c][2], [&](std::size_t i) { return report(i).elastic[c]; });
    put(layout.names[c][3], [&](std::size_t i) { return report(i).damping[c]; });
    put(layout.names[c][4], [&](std::size_t i) { return report(i).total[c]; });
  }
  f.add_scalars("joint_energy", n, [&](std::size_t i) { return report(i).energy; });
  return f;
}

const std::vector<StiffnessLayout>& stiffness_layouts() {
  using K = JointStiffnessKind;
  static const std::vector<StiffnessLayout> all = {
      {"/jntforc/type0",
       {K::generalized},
       degrees,
       {{{"phi_degrees", "d(phi)_dt", "phi_moment_stiffness", "phi_moment_damping", "phi_moment_total"},
         {"theta_degrees", "d(theta)_dt", "theta_moment_stiffness", "theta_moment_damping", "theta_moment_total"},
         {"psi_degrees", "d(psi)_dt", "psi_moment_stiffness", "psi_moment_damping", "psi_moment_total"}}}},
      {"/jntforc/type1",
       {K::flexion_torsion},
       degrees,
       {{{"alpha_degrees", "d(alpha)_dt", "alpha_moment_stiffness", "alpha_moment_damping", "alpha_moment_total"},
         {"gamma_degrees", "d(gamma)_dt", "gamma_scale_factor", "", ""},
         {"beta_degrees", "d(beta)_dt", "beta_moment_stiffness", "beta_moment_damping", "beta_moment_total"}}}},
      {"/jntforc/type2",
       {K::translational, K::cylindrical},
       1.0,
       {{{"x_displacement", "d(dispx)_dt", "x_force_stiffness", "x_force_damping", "x_force_total"},
         {"y_displacement", "d(dispy)_dt", "y_force_stiffness", "y_force_damping", "y_force_total"},
         {"z_displacement", "d(dispz)_dt", "z_force_stiffness", "z_force_damping", "z_force_total"}}}}};
  return all;
}

std::vector<const ReactionReport*> reactions_of(const State& state, ReactionReport::Kind kind) {
  std::vector<const ReactionReport*> chosen;
  for (const ReactionReport& r : state.reactions)
    if (r.kind == kind) chosen.push_back(&r);
  return chosen;
}

Folder velocity_folder(const Model& model, const State& state, ReactionReport::Kind kind) {
  const bool bodies = kind == ReactionReport::Kind::motion_of_body;
  const std::vector<const ReactionReport*> chosen = reactions_of(state, kind);
  Folder f;
  f.path = bodies ? "/bndout/velocity/rigidbodies" : "/bndout/velocity/nodes";
  IntegerColumn ids{"ids", {}}, motions{"setid", {}};
  Vec3 total{};
  double work = 0;
  for (const ReactionReport* r : chosen) {
    ids.values.push_back(bodies ? state.bodies.info[static_cast<std::size_t>(r->body)].id
                                : model.nodes.id[static_cast<std::size_t>(r->node)]);
    motions.values.push_back(r->id);
    total += r->force;
    work += r->work;
  }
  f.metadata = {std::move(ids), std::move(motions)};
  f.integers = {{"cycle", {state.clock.cycle}}};
  const std::size_t n = chosen.size();
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return chosen[i]->force; });
  f.add_scalars("energy", n, [&](std::size_t i) { return chosen[i]->work; });
  if (bodies) f.add_vectors("xmoment", "ymoment", "zmoment", n, [&](std::size_t i) { return chosen[i]->moment; });
  if (n == 0) return f;
  f.add_vectors("x_total", "y_total", "z_total", 1, [&](std::size_t) { return total; });
  f.columns.push_back({"etotal", {work}});
  return f;
}

}  // namespace

std::vector<Folder> jntforc_folders(const Model& model, const State& state, const BodyFrames& frames) {
  std::vector<Folder> folders;
  folders.push_back(joints_folder(model, state, frames));
  for (const StiffnessLayout& layout : stiffness_layouts()) folders.push_back(stiffness_folder(model, state, layout));
  return folders;
}

std::vector<Folder> bndout_folders(const Model& model, const State& state) {
  return {velocity_folder(model, state, ReactionReport::Kind::motion_of_node),
          velocity_folder(model, state, ReactionReport::Kind::motion_of_body)};
}

Folder spcforc_folder(const Model& model, const State& state) {
  std::vector<const ReactionReport*> chosen = reactions_of(state, ReactionReport::Kind::single_point_constraint);
  std::erase_if(chosen, [](const ReactionReport* r) { return r->node == none; });
  Folder f;
  f.path = "/spcforc";
  IntegerColumn nodes{"force_ids", {}}, constraints{"spc_ids", {}};
  Vec3 total{};
  for (const ReactionReport* r : chosen) {
    nodes.values.push_back(model.nodes.id[static_cast<std::size_t>(r->node)]);
    constraints.values.push_back(r->id);
    total += r->force;
  }
  f.metadata = {nodes, {"moment_ids", nodes.values}, std::move(constraints)};
  const std::size_t n = chosen.size();
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return chosen[i]->force; });
  f.add_vectors("x_moment", "y_moment", "z_moment", n, [&](std::size_t i) { return chosen[i]->moment; });
  if (n == 0) return f;
  f.add_vectors("x_resultant", "y_resultant", "z_resultant", 1, [&](std::size_t) { return total; });
  return f;
}

namespace {

/// Forces by segment of the wall whose place in the list is `number`, from 1 on.
Folder wall_segments_folder(const WallReport& wall, std::size_t number) {
  const std::size_t n = wall.segment_force.size();
  Folder f;
  f.path = fmt::format("/rwforc/wall{:03d}", number);
  IntegerColumn ids{"ids", {}};
  Vec3 total;
  for (std::size_t k = 0; k < n; ++k) {
    ids.values.push_back(static_cast<std::int64_t>(k) + 1);
    total += wall.segment_force[k];
  }
  f.metadata = {std::move(ids)};
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t k) { return wall.segment_force[k]; });
  f.add_vectors("total_x", "total_y", "total_z", 1, [&](std::size_t) { return total; });
  return f;
}

}  // namespace

std::vector<Folder> rwforc_folders(const Model& model, const State& state) {
  const std::size_t n = state.walls.size();
  Folder f;
  f.path = "/rwforc/forces";
  IntegerColumn ids{"ids", {}}, walls{"setid", {}};
  for (std::size_t i = 0; i < n; ++i) {
    ids.values.push_back(state.walls[i].id);
    walls.values.push_back(static_cast<std::int64_t>(i) + 1);
    if (model.rigid_walls[i].title.empty()) continue;
    f.legend_ids.push_back(state.walls[i].id);
    f.legend.push_back(model.rigid_walls[i].title);
  }
  f.metadata = {std::move(ids), std::move(walls)};
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return state.walls[i].eased_force; });
  f.add_scalars("normal_force", n, [&](std::size_t i) { return state.walls[i].eased_normal_force; });
  f.add_scalars("energy", n, [&](std::size_t i) { return state.walls[i].energy; });
  std::vector<Folder> folders{std::move(f)};
  for (std::size_t i = 0; i < n; ++i)
    if (!state.walls[i].segment_force.empty()) folders.push_back(wall_segments_folder(state.walls[i], i + 1));
  return folders;
}

Folder swforc_folder(const State& state) {
  const std::vector<WeldReport>& welds = state.welds;
  const std::size_t n = welds.size();
  Folder f;
  f.path = "/swforc";
  f.text_metadata = {{"typenames", "constraint,weld,beam"}};  // types count from 1
  IntegerColumn ids{"ids", {}}, types{"types", {}}, failed{"failure", {}};
  for (const WeldReport& weld : welds) {
    ids.values.push_back(weld.id);
    types.values.push_back(static_cast<std::int64_t>(weld.kind) + 1);
    failed.values.push_back(weld.failed);
  }
  f.metadata = {std::move(ids), std::move(types)};
  f.integers = {std::move(failed)};
  f.add_scalars("axial", n, [&](std::size_t i) { return welds[i].axial; });
  f.add_scalars("shear", n, [&](std::size_t i) { return welds[i].shear; });
  f.add_scalars("failure_time", n, [&](std::size_t i) { return welds[i].failure_time; });
  f.add_scalars("length", n, [&](std::size_t i) { return welds[i].length; });
  f.add_scalars("resultant_moment", n, [&](std::size_t i) { return welds[i].moment; });
  f.add_scalars("torsion", n, [&](std::size_t i) { return welds[i].torsion; });
  return f;
}

Folder deforc_folder(const Model& model, const State& state) {
  const DiscreteElements& d = model.discretes;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < state.discretes.size(); ++i)
    if (i >= d.print.size() || d.print[i] == 0) chosen.push_back(i);
  Folder f;
  f.path = "/deforc";
  IntegerColumn ids{"ids", {}}, rotational{"irot", {}};
  for (const std::size_t i : chosen) {
    const Index section = model.parts[static_cast<std::size_t>(d.part[i])].section;
    ids.values.push_back(d.id[i]);
    rotational.values.push_back(section != none && model.sections[static_cast<std::size_t>(section)].discrete.dro == 1);
  }
  f.metadata = {std::move(ids), std::move(rotational)};
  const std::size_t n = chosen.size();
  const auto report = [&](std::size_t i) -> const DiscreteReport& { return state.discretes[chosen[i]]; };
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return report(i).global_force; });
  f.add_scalars("resultant_force", n, [&](std::size_t i) { return report(i).force; });
  f.add_scalars("displacement", n, [&](std::size_t i) { return report(i).elongation; });
  return f;
}

Folder secforc_folder(const Model& model, const State& state) {
  const std::vector<SectionReport>& sections = state.sections;
  const std::size_t n = sections.size();
  Folder f;
  f.path = "/secforc";
  IntegerColumn ids{"ids", {}};
  for (std::size_t i = 0; i < n; ++i) {
    const CrossSection& section = model.cross_sections[i];
    ids.values.push_back(section.id);
    if (section.title.empty()) continue;
    f.legend_ids.push_back(section.id);
    f.legend.push_back(section.title);
  }
  f.metadata.push_back(std::move(ids));
  f.add_vectors("x_force", "y_force", "z_force", n, [&](std::size_t i) { return sections[i].force; });
  f.add_scalars("total_force", n, [&](std::size_t i) { return norm(sections[i].force); });
  f.add_vectors("x_moment", "y_moment", "z_moment", n, [&](std::size_t i) { return sections[i].moment; });
  f.add_scalars("total_moment", n, [&](std::size_t i) { return norm(sections[i].moment); });
  f.add_vectors("x_centroid", "y_centroid", "z_centroid", n, [&](std::size_t i) { return sections[i].centroid; });
  return f;
}

}  // namespace kardan

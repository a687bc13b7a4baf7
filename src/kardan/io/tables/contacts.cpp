// RCFORC, SLEOUT, NCFORC. Names and folders are those that LSTC's binout translator reads.
#include <fmt/format.h>

#include <algorithm>

#include "kardan/io/tables/reporter.hpp"

namespace kardan {

namespace {

void add_title(Folder& f, const Contact& contact) {
  if (contact.title.empty()) return;
  f.legend_ids.push_back(contact.id);
  f.legend.push_back(contact.title);
}

/// A row of RCFORC: a side of a contact.
struct Row {
  std::size_t contact;
  int side;  ///< 0 tracked ("slave"), 1 reference ("master")
};

}  // namespace

Folder rcforc_folder(const Model& model, const State& state) {
  std::vector<Row> rows;
  Folder f;
  f.path = "/rcforc";
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (model.contacts[i].single) continue;  // the forces of a surface on itself sum up to nothing
    rows.push_back({i, 0});
    if (model.contacts[i].reference.kind != ContactSide::Kind::nothing) rows.push_back({i, 1});
    add_title(f, model.contacts[i]);
  }
  IntegerColumn ids{"ids", {}}, sides{"side", {}}, single{"single", {}};
  for (const Row& row : rows) {
    ids.values.push_back(model.contacts[row.contact].id);
    sides.values.push_back(row.side);
    single.values.push_back(model.contacts[row.contact].reference.kind == ContactSide::Kind::nothing);
  }
  f.metadata = {std::move(ids), std::move(sides), std::move(single)};
  const auto sign = [&](std::size_t i) { return rows[i].side == 0 ? 1.0 : -1.0; };
  const auto report = [&](std::size_t i) -> const ContactReport& { return state.contacts[rows[i].contact]; };
  f.add_vectors("x_force", "y_force", "z_force", rows.size(), [&](std::size_t i) { return report(i).force * sign(i); });
  f.add_vectors("x_moment", "y_moment", "z_moment", rows.size(), [&](std::size_t i) { return report(i).moment * sign(i); });
  return f;
}

Folder sleout_folder(const Model& model, const State& state) {
  Folder f;
  f.path = "/sleout";
  IntegerColumn ids{"ids", {}}, single{"single_sided", {}};
  std::vector<const ContactReport*> reports;
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (model.contacts[i].law == ContactLaw::transducer) continue;
    ids.values.push_back(model.contacts[i].id);
    single.values.push_back(model.contacts[i].single);
    reports.push_back(&state.contacts[i]);
    add_title(f, model.contacts[i]);
  }
  f.metadata = {std::move(ids), std::move(single)};
  f.integers = {{"cycle", {state.clock.cycle}}};
  const std::size_t n = reports.size();
  f.add_scalars("slave", n, [&](std::size_t i) { return reports[i]->tracked_energy; });
  f.add_scalars("master", n, [&](std::size_t i) { return reports[i]->reference_energy; });
  f.add_scalars("friction", n, [&](std::size_t i) { return reports[i]->friction_energy; });
  if (n == 0) return f;
  double total[3] = {};
  for (const ContactReport* r : reports) {
    total[0] += r->tracked_energy;
    total[1] += r->reference_energy;
    total[2] += r->friction_energy;
  }
  f.columns.push_back({"total_slave", {total[0]}});
  f.columns.push_back({"total_master", {total[1]}});
  f.columns.push_back({"total_energy", {total[0] + total[1]}});
  f.columns.push_back({"total_friction", {total[2]}});
  return f;
}

std::vector<Folder> ncforc_folders(const Model& model, const State& state) {
  std::vector<Folder> folders;
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    const ContactReport& report = state.contacts[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const std::vector<NodeIndex>& nodes = report.nodes[side];
      if (nodes.empty() || report.nodal_force[side].size() != nodes.size()) continue;
      Folder f;
      f.path = fmt::format("/ncforc/{}_{:08d}", side == 0 ? "slave" : "master", model.contacts[i].id);
      IntegerColumn ids{"ids", {}};
      for (const NodeIndex n : nodes) ids.values.push_back(model.nodes.id[static_cast<std::size_t>(n)]);
      f.metadata = {std::move(ids), {"interface", {model.contacts[i].id}}, {"side", {static_cast<std::int64_t>(side)}}};
      add_title(f, model.contacts[i]);
      const std::vector<Vec3>& force = report.nodal_force[side];
      const std::vector<double>& area = report.nodal_area[side];
      f.add_vectors("x_force", "y_force", "z_force", nodes.size(), [&](std::size_t k) { return force[k]; });
      f.add_scalars("pressure", nodes.size(), [&](std::size_t k) { return area[k] > 0 ? norm(force[k]) / area[k] : 0.0; });
      folders.push_back(std::move(f));
    }
  }
  return folders;
}

}  // namespace kardan

#include "kardan/elements/shell/shell_forces.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "kardan/elements/hourglass.hpp"
#include "kardan/elements/lumped_mass.hpp"
#include "kardan/elements/shell/shell_laws.hpp"

namespace kardan {

namespace {

constexpr int elform_belytschko_tsay = 2;

ShellProperties properties_of(const Model& model, const Part& part, std::vector<double>& table) {
  const ShellSection& section = model.sections[part.section].shell;
  const Material& material = model.materials[part.material];
  const auto [rho, e, nu] = bulk_properties(material);
  const double transverse = section.shrf * e / (2 * (1 + nu));  // k G
  ShellProperties p;
  p.law = shell_law(model, material, section.shrf, table);
  p.points = section.nip > 0 ? section.nip : 2;
  gauss_rule(p.points, p.zeta, p.weight);
  for (int i = 0; i < p.points; ++i) p.zeta[i] -= section.nloc;  // NLOC = 1: the nodes lie on the top surface
  p.wave_speed = std::sqrt(e / (rho * (1 - nu * nu)));
  p.side_lengths = model.control.time_step.isdo != 1;
  const HourglassChoice h = hourglass_of(model, part);
  p.stiffness_hourglass = h.stiffness();
  const double shear_ratio = transverse / e;  // k G / E
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

TileMesh cut(const Model& model) {
  const std::vector<Index> elements = deformable_shells(model);
  std::vector<NodeIndex> flat;
  flat.reserve(model.shells.size() * 4);
  for (const auto& nodes : model.shells.nodes) flat.insert(flat.end(), nodes.begin(), nodes.end());
  return cut_tiles({elements, model.shells.part, flat, 4, model.nodes.x});
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
    : mesh_(cut(model)),
      slots_(mesh_, model.nodes.size(), 6),
      kernels_(&belytschko_tsay()),
      properties_(model.parts.size()),
      tables_(model.parts.size()),
      start_(model.parts.size()),
      place_(model.shells.size(), none) {
  const std::size_t errors = diagnostics.error_count();
  PartIndex last = none;
  for (const Tile& tile : mesh_.tiles) {
    if (tile.part != last && computable(model, tile.part, diagnostics)) {
      properties_[tile.part] = properties_of(model, model.parts[tile.part], tables_[tile.part]);
      start_[tile.part] = point_start(properties_[tile.part].law);
    }
    last = tile.part;
  }
  if (diagnostics.error_count() != errors) return;
  std::size_t size = 0;
  for (const Tile& tile : mesh_.tiles) {
    history_begin_.push_back(size);
    size += tile.blocks * block_lanes * history_size(tile.part);
    tile_of_block_.resize(tile.first_block + tile.blocks, static_cast<Index>(history_begin_.size()) - 1);
  }
  history_.assign(size, 0.0);
  internal_.assign(mesh_.tiles.size(), 0.0);
  hourglass_.assign(mesh_.tiles.size(), 0.0);
  outcome_.resize(mesh_.tiles.size());
  for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
    const Tile& tile = mesh_.tiles[t];
    const std::size_t per_element = history_size(tile.part);
    const std::vector<double>& start = start_[tile.part];
    const std::size_t points = static_cast<std::size_t>(properties_[tile.part].points);
    for (std::size_t i = 0; i < tile.blocks * block_lanes; ++i) {
      const Index shell = mesh_.element[tile.first_block * block_lanes + i];
      if (i < tile.elements) place_[shell] = static_cast<Index>(tile.first_block * block_lanes + i);
      const std::size_t block = i / block_lanes, lane = i % block_lanes;
      double* own = history_.data() + history_begin_[t] + block * per_element * block_lanes + lane;
      for (std::size_t k = 0; k < points * start.size(); ++k) own[k * block_lanes] = start[k % start.size()];
      own[(per_element - 1) * block_lanes] = mean_thickness(model, shell);
    }
  }
  for (const NodeIndex n : slots_.nodes()) state.nodes.needed[n] = 1;
  state.registry.add({"shells.history", "mixed", "elements.internal_forces"}, history_);
  state.registry.add({"shells.internal_energy", "energy", "elements.internal_forces"}, internal_);
  state.registry.add({"shells.hourglass_energy", "energy", "elements.internal_forces"}, hourglass_);
}

bool ShellForces::computable(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  const std::string name = "part " + std::to_string(part.id);
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error(name + " has deformable shells of " + what + ", which this version does not compute", cure, keyword);
    good = false;
  };
  if (!check_shell_law(model, part, diagnostics)) good = false;
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
  return good;
}

void ShellForces::run_tile(std::size_t t, const State& state, Scratch& scratch) {
  const Tile& tile = mesh_.tiles[t];
  scratch.x.resize(std::max(scratch.x.size(), tile.nodes * 3));
  scratch.v.resize(std::max(scratch.v.size(), tile.nodes * 6));
  const NodeIndex* node = mesh_.node.data() + tile.first_node;
  for (std::size_t k = 0; k < tile.nodes; ++k) {
    const Vec3 &x = state.nodes.x[node[k]], &v = state.nodes.v[node[k]], &w = state.nodes.omega[node[k]];
    double* lx = scratch.x.data() + 3 * k;
    double* lv = scratch.v.data() + 6 * k;
    lx[0] = x.x, lx[1] = x.y, lx[2] = x.z;
    lv[0] = v.x, lv[1] = v.y, lv[2] = v.z, lv[3] = w.x, lv[4] = w.y, lv[5] = w.z;
  }
  ShellTileWork work;
  work.properties = &properties_[tile.part];
  work.connectivity = mesh_.connectivity.data() + tile.first_block * 4 * block_lanes;
  work.elements = tile.elements;
  work.x = scratch.x.data();
  work.v = scratch.v.data();
  work.dt = state.clock.dt_previous;
  work.history = history_.data() + history_begin_[t];
  work.force = slots_.slots(tile);
  work.nodes = tile.nodes;
  const ShellLaw& law = work.properties->law;
  (*kernels_)[law.index()](work, std::visit([](const auto& l) { return static_cast<const void*>(&l); }, law));
  internal_[t] += work.internal_increment;
  hourglass_[t] += work.hourglass_increment;
  outcome_[t] = {work.time_step, work.governing, work.broken};
}

void ShellForces::internal_forces(const Model& model, State& state) {
  if (mesh_.empty()) return;
  scratch_.resize(static_cast<std::size_t>(omp_get_max_threads()));
  const auto count = static_cast<std::ptrdiff_t>(mesh_.tiles.size());
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::ptrdiff_t t = 0; t < count; ++t) {
    run_tile(static_cast<std::size_t>(t), state, scratch_[static_cast<std::size_t>(omp_get_thread_num())]);
  }
  governing_ = {};
  for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
    const Tile& tile = mesh_.tiles[t];
    const Outcome& o = outcome_[t];
    if (o.broken != 0) report_broken(model, state, tile, o.broken - 1);
    if (o.time_step < governing_.time_step) {
      governing_.time_step = o.time_step;
      governing_.element = model.shells.id[mesh_.element[tile.first_block * block_lanes + o.governing]];
    }
  }
}

void ShellForces::report_broken(const Model& model, const State& state, const Tile& tile, std::size_t element) const {
  const Index shell = mesh_.element[tile.first_block * block_lanes + element];
  std::string text = "shell " + std::to_string(model.shells.id[shell]) + " of part " + std::to_string(model.parts[tile.part].id) +
                     " has no area or a value that is not finite at t = " + std::to_string(state.clock.time) + "; nodes";
  for (const NodeIndex n : model.shells.nodes[shell]) {
    const Vec3& x = state.nodes.x[n];
    text += " " + std::to_string(model.nodes.id[n]) + " (" + std::to_string(x.x) + ", " + std::to_string(x.y) + ", " +
            std::to_string(x.z) + ")";
  }
  throw RunError(text);
}

void ShellForces::add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
  for (std::size_t t = 0; t < internal_.size(); ++t) {
    internal[mesh_.tiles[t].part] += internal_[t];
    hourglass[mesh_.tiles[t].part] += hourglass_[t];
  }
}

bool ShellForces::stress(Index shell, int point, double (&s)[5]) const {
  const Index place = place_[shell];
  if (place == none) return false;
  const std::size_t block = static_cast<std::size_t>(place) / block_lanes, lane = static_cast<std::size_t>(place) % block_lanes;
  const auto t = static_cast<std::size_t>(tile_of_block_[block]);
  const Tile& tile = mesh_.tiles[t];
  const std::size_t per_element = history_size(tile.part), per_point = start_[tile.part].size();
  const double* history = history_.data() + history_begin_[t] + (block - tile.first_block) * per_element * block_lanes;
  for (std::size_t c = 0; c < 5; ++c) s[c] = history[(static_cast<std::size_t>(point) * per_point + c) * block_lanes + lane];
  return true;
}

}  // namespace kardan

#include "kardan/elements/solid/solid_forces.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "kardan/elements/geometry.hpp"
#include "kardan/elements/hourglass.hpp"

namespace kardan {

namespace {

constexpr int one_point = 1;

SolidProperties properties_of(const Model& model, const Part& part) {
  const auto& elastic = std::get<ElasticMaterial>(model.materials[part.material].law);
  SolidProperties p;
  p.law = Elastic::from(elastic.youngs_modulus, elastic.poissons_ratio);
  p.density = elastic.density;
  p.wave_speed = std::sqrt(p.law.longitudinal() / elastic.density);
  const HourglassChoice h = hourglass_of(model, part);
  p.q1 = h.q1;
  p.q2 = h.q2;
  p.stiffness_hourglass = h.stiffness();
  p.hourglass =
      p.stiffness_hourglass ? h.membrane * p.law.longitudinal() / 16 : h.membrane * p.density * p.wave_speed / 4;
  return p;
}

/// Nodes of a solid as the trilinear map needs them. A tetrahedron N1 N2 N3 N4 N4 N4 N4 N4 would be half of itself (its
/// face of four nodes is not flat); N1 N2 N3 N3 N4 N4 N4 N4 is all of it, with the constant gradients of the
/// tetrahedron.
std::array<NodeIndex, 8> mapped_nodes(const std::array<NodeIndex, 8>& nodes) {
  if (distinct_nodes(nodes) != 4) return nodes;
  std::array<NodeIndex, 4> corner{};
  std::size_t count = 0;
  for (const NodeIndex n : nodes) {
    const auto end = corner.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(corner.begin(), end, n) == end) corner[count++] = n;
  }
  return {corner[0], corner[1], corner[2], corner[2], corner[3], corner[3], corner[3], corner[3]};
}

TileMesh cut(const Model& model) {
  std::vector<Index> elements;
  std::vector<NodeIndex> flat;
  flat.reserve(model.solids.size() * 8);
  for (std::size_t e = 0; e < model.solids.size(); ++e) {
    const Part& part = model.parts[model.solids.part[e]];
    if (part.section != none && part.material != none && !model.rigid_part(model.solids.part[e])) {
      elements.push_back(static_cast<Index>(e));
    }
    const std::array<NodeIndex, 8> nodes = mapped_nodes(model.solids.nodes[e]);
    flat.insert(flat.end(), nodes.begin(), nodes.end());
  }
  return cut_tiles({elements, model.solids.part, flat, 8, model.nodes.x});
}

}  // namespace

SolidForces::SolidForces(const Model& model, State& state, Diagnostics& diagnostics)
    : mesh_(cut(model)),
      slots_(mesh_, model.nodes.size(), 3),
      kernel_(hexahedron_elastic()),
      properties_(model.parts.size()) {
  const std::size_t errors = diagnostics.error_count();
  PartIndex last = none;
  for (const Tile& tile : mesh_.tiles) {
    if (tile.part != last && computable(model, tile.part, diagnostics)) {
      properties_[tile.part] = properties_of(model, model.parts[tile.part]);
    }
    last = tile.part;
  }
  if (diagnostics.error_count() != errors || mesh_.empty()) return;
  start_history(model);
  internal_.assign(mesh_.tiles.size(), 0.0);
  hourglass_.assign(mesh_.tiles.size(), 0.0);
  outcome_.resize(mesh_.tiles.size());
  state.results.solid.stress.assign(model.solids.size(), StressVector{});
  for (const NodeIndex n : slots_.nodes()) state.nodes.needed[n] = 1;
  state.registry.add({"solids.history", "mixed", "elements.internal_forces"}, history_);
  state.registry.add({"solids.internal_energy", "energy", "elements.internal_forces"}, internal_);
  state.registry.add({"solids.hourglass_energy", "energy", "elements.internal_forces"}, hourglass_);
}

void SolidForces::start_history(const Model& model) {
  history_.assign(mesh_.element.size() * solid_history::count, 0.0);
  for (std::size_t i = 0; i < mesh_.element.size(); ++i) {
    const auto& nodes = model.solids.nodes[mesh_.element[i]];
    const double volume = solid_volume(gather_coordinates(model.nodes.x, nodes), nodes);
    double* own = history_.data() + i / block_lanes * solid_history::count * block_lanes + i % block_lanes;
    own[solid_history::volume * block_lanes] = volume;
    own[solid_history::size * block_lanes] = std::cbrt(volume);
  }
}

bool SolidForces::computable(const Model& model, PartIndex p, Diagnostics& diagnostics) {
  const Part& part = model.parts[p];
  const Section& section = model.sections[part.section];
  const Material& material = model.materials[part.material];
  bool good = true;
  const auto refuse = [&](const std::string& what, const std::string& cure, const char* keyword) {
    diagnostics.error("part " + std::to_string(part.id) + " has deformable solids of " + what +
                          ", which this version does not compute",
                      cure, keyword);
    good = false;
  };
  if (!std::holds_alternative<ElasticMaterial>(material.law)) {
    const auto* unsupported = std::get_if<UnsupportedMaterial>(&material.law);
    refuse("material " + std::to_string(material.id) + (unsupported ? " (" + unsupported->keyword + ")" : ""),
           "use *MAT_ELASTIC, or make the part rigid (*MAT_RIGID)", "*PART");
  } else if (const auto& e = std::get<ElasticMaterial>(material.law);
             !(e.density > 0 && e.youngs_modulus > 0 && e.poissons_ratio > -1 && e.poissons_ratio < 0.5)) {
    refuse("material " + std::to_string(material.id) + " with density " + std::to_string(e.density) +
               ", Young's modulus " + std::to_string(e.youngs_modulus) + " and Poisson's ratio " +
               std::to_string(e.poissons_ratio),
           "give RO > 0, E > 0 and -1 < PR < 0.5", "*MAT_ELASTIC");
  }
  if (section.kind != ElementKind::solid) return false;  // the lumped masses have complained
  if (section.solid.elform != one_point) {
    refuse("ELFORM = " + std::to_string(section.solid.elform) + " (section " + std::to_string(section.id) + ")",
           "use ELFORM = 1", "*SECTION_SOLID");
  }
  if (const int type = hourglass_of(model, part).type; type < 1 || type > 5) {
    refuse("hourglass control IHQ = " + std::to_string(type),
           "use IHQ = 1, 2 or 3 (viscous), 4 or 5 (stiffness), by *HOURGLASS", "*HOURGLASS");
  }
  return good;
}

void SolidForces::run_tile(std::size_t t, const State& state, Scratch& scratch) {
  const Tile& tile = mesh_.tiles[t];
  scratch.node.resize(std::max(scratch.node.size(), tile.nodes * solid_node_stride));
  const NodeIndex* node = mesh_.node.data() + tile.first_node;
  for (std::size_t k = 0; k < tile.nodes; ++k) {
    const Vec3 &x = state.nodes.x[node[k]], &v = state.nodes.v[node[k]];
    double* local = scratch.node.data() + solid_node_stride * k;
    local[0] = x.x, local[1] = x.y, local[2] = x.z;
    local[4] = v.x, local[5] = v.y, local[6] = v.z;
  }
  SolidTileWork work;
  work.properties = &properties_[tile.part];
  work.connectivity = mesh_.connectivity.data() + tile.first_block * 8 * block_lanes;
  work.elements = tile.elements;
  work.node = scratch.node.data();
  work.dt = state.clock.dt_previous;
  work.history = history_.data() + tile.first_block * block_lanes * solid_history::count;
  work.force = slots_.slots(tile);
  work.nodes = tile.nodes;
  kernel_(work);
  internal_[t] += work.internal_increment;
  hourglass_[t] += work.hourglass_increment;
  outcome_[t] = {work.time_step, work.governing, work.broken};
}

void SolidForces::internal_forces(const Model& model, State& state) {
  if (mesh_.empty()) return;
  scratch_.resize(static_cast<std::size_t>(omp_get_max_threads()));
  const auto count = static_cast<std::ptrdiff_t>(mesh_.tiles.size());
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::ptrdiff_t t = 0; t < count; ++t) {
    run_tile(static_cast<std::size_t>(t), state, scratch_[static_cast<std::size_t>(omp_get_thread_num())]);
  }
  governing_ = {};
  governing_.kind = ElementKind::solid;
  for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
    const Tile& tile = mesh_.tiles[t];
    const Outcome& o = outcome_[t];
    if (o.broken != 0) report_broken(model, state, tile, o.broken - 1);
    if (o.time_step < governing_.time_step) {
      governing_.time_step = o.time_step;
      governing_.element = model.solids.id[mesh_.element[tile.first_block * block_lanes + o.governing]];
    }
  }
}

void SolidForces::report_broken(const Model& model, const State& state, const Tile& tile, std::size_t element) const {
  const Index solid = mesh_.element[tile.first_block * block_lanes + element];
  const auto& nodes = model.solids.nodes[solid];
  const double volume = solid_volume(gather_coordinates(state.nodes.x, nodes), nodes);
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return std::string(text);
  };
  std::string text = "solid " + std::to_string(model.solids.id[solid]) + " of part " +
                     std::to_string(model.parts[tile.part].id) +
                     (volume <= 0 ? " has the negative volume " + number(volume) : " has a value that is not finite") +
                     " at t = " + number(state.clock.time) + "; nodes";
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(a), nodes[a]) !=
        nodes.begin() + static_cast<std::ptrdiff_t>(a)) {
      continue;
    }
    const Vec3& x = state.nodes.x[nodes[a]];
    text += " " + std::to_string(model.nodes.id[nodes[a]]) + " (" + number(x.x) + ", " + number(x.y) + ", " +
            number(x.z) + ")";
  }
  throw RunError(text);
}

void SolidForces::add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
  for (std::size_t t = 0; t < internal_.size(); ++t) {
    internal[mesh_.tiles[t].part] += internal_[t];
    hourglass[mesh_.tiles[t].part] += hourglass_[t];
  }
}

void SolidForces::report(SolidResults& results) const {
  for (const Tile& tile : mesh_.tiles) {
    for (std::size_t i = 0; i < tile.elements; ++i) {
      const std::size_t place = tile.first_block * block_lanes + i;
      const double* own =
          history_.data() + place / block_lanes * solid_history::count * block_lanes + place % block_lanes;
      StressVector& s = results.stress[mesh_.element[place]];
      for (std::size_t c = 0; c < s.size(); ++c) s[c] = own[(solid_history::stress + c) * block_lanes];
    }
  }
}

}  // namespace kardan

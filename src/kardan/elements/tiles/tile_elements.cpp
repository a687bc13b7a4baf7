#include "kardan/elements/tiles/tile_elements.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace kardan {

double failing_points(const ElementDeletion& deletion, int points) {
  if (deletion.points == 0) return points;
  const double count = deletion.points > 0 ? deletion.points : std::ceil(-deletion.points / 100 * points - 1e-9);
  return std::clamp(count, 1.0, static_cast<double>(points));
}

TileKernel kernel_for(const TileKernels& kernels, const Law& law) {
  if (law.inlined == InlinedLaw::elastic && kernels.elastic) return kernels.elastic;
  if (law.inlined == InlinedLaw::piecewise_plastic && kernels.piecewise_plastic) return kernels.piecewise_plastic;
  return kernels.called;
}

TileElements::TileElements(const TileElementsInput& input, std::size_t node_count)
    : input_(input), mesh_(cut_tiles(input.tiles)), slots_(mesh_, node_count, input.components) {
  input_.tiles.elements = {};
  input_.tiles.nodes = {};
  governing_.kind = input.kind;
}

std::vector<PartIndex> TileElements::parts() const {
  std::vector<PartIndex> parts;
  for (const Tile& tile : mesh_.tiles) {
    if (parts.empty() || parts.back() != tile.part) parts.push_back(tile.part);
  }
  return parts;
}

void TileElements::set_kernel(PartIndex part, PartKernel kernel) {
  kernels_.resize(std::max(kernels_.size(), static_cast<std::size_t>(part) + 1));
  kernels_[part] = std::move(kernel);
}

void TileElements::start(State& state) {
  if (empty()) return;
  std::size_t size = 0;
  bool deletable = false;
  for (const Tile& tile : mesh_.tiles) {
    history_begin_.push_back(size);
    size += tile.blocks * block_lanes * kernels_[tile.part].history_size;
    tile_of_block_.resize(tile.first_block + tile.blocks, static_cast<Index>(history_begin_.size()) - 1);
    deletable = deletable || kernels_[tile.part].can_fail;
  }
  history_.assign(size, 0.0);
  internal_.assign(mesh_.tiles.size(), 0.0);
  hourglass_.assign(mesh_.tiles.size(), 0.0);
  eroded_.assign(mesh_.tiles.size(), 0.0);
  deleted_.assign(mesh_.tiles.size(), 0);
  outcome_.resize(mesh_.tiles.size());
  place_.assign(input_.ids.size(), none);
  for (const Tile& tile : mesh_.tiles) {
    for (std::size_t i = tile.first_block * block_lanes; i < tile.first_block * block_lanes + tile.elements; ++i) {
      place_[mesh_.element[i]] = static_cast<Index>(i);
    }
  }
  for (const NodeIndex n : slots_.nodes()) state.nodes.needed[n] = 1;
  const std::string writer = "elements.internal_forces";
  state.registry.add({input_.name + ".history", "mixed", writer}, history_);
  state.registry.add({input_.name + ".internal_energy", "energy", writer}, internal_);
  state.registry.add({input_.name + ".hourglass_energy", "energy", writer}, hourglass_);
  if (deletable) {
    alive_.assign(mesh_.element.size(), 1.0);
    state.registry.add({input_.name + ".alive", "1", writer}, alive_);
    state.registry.keep({input_.name + ".eroded_energy", "energy", writer}, eroded_);
    state.registry.keep({input_.name + ".deleted", "1", writer}, deleted_);
    state.registry.keep_value({input_.name + ".erode_below", "time", "solver"}, erode_below_);
  }
  if (deletable || input_.energies) {
    energy_.assign(mesh_.element.size(), 0.0);
    state.registry.add({input_.name + ".element_energy", "energy", writer}, energy_);
  }
}

void TileElements::prepare_mass_scaling(State& state) {
  if (empty()) return;
  steps_.assign(mesh_.element.size(), 0.0);
  mass_factor_.assign(mesh_.element.size(), 1.0);
  step_factor_.resize(mesh_.tiles.size());
  for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) step_factor_[t].resize(mesh_.tiles[t].blocks * block_lanes, 1.0);
  side_factor_ = step_factor_;
  state.registry.add({input_.name + ".mass_factor", "1", "elements.scale_masses"}, mass_factor_);
  state.registry.after_restore([this] {
    for (std::size_t t = 0; t < mesh_.tiles.size(); ++t)
      for (std::size_t i = 0; i < mesh_.tiles[t].elements; ++i) take_mass_factor(t, i);
  });
}

void TileElements::take_mass_factor(std::size_t t, std::size_t i) {
  step_factor_[t][i] = side_factor_[t][i] * std::sqrt(mass_factor_[mesh_.tiles[t].first_block * block_lanes + i]);
}

TileElements::Place TileElements::find(Index element) const {
  const Index place = place_.empty() ? none : place_[element];
  if (place == none) return {};
  const auto tile = static_cast<std::size_t>(tile_of_block_[static_cast<std::size_t>(place) / block_lanes]);
  return {tile, static_cast<std::size_t>(place) - mesh_.tiles[tile].first_block * block_lanes, true};
}

const double* TileElements::values_of(Index element) const {
  const Place p = find(element);
  return p.here ? const_cast<TileElements*>(this)->values(p.tile, p.element) : nullptr;
}

double* TileElements::values_of(Index element) { return const_cast<double*>(std::as_const(*this).values_of(element)); }

void TileElements::add_energy(Index element, double energy) {
  const Place p = find(element);
  if (!p.here) return;
  internal_[p.tile] += energy;
  if (!energy_.empty()) energy_[static_cast<std::size_t>(place_[element])] += energy;
}

double TileElements::alive(Index element) const {
  return alive_.empty() || place_[element] == none ? 1.0 : alive_[static_cast<std::size_t>(place_[element])];
}

double TileElements::energy(Index element) const {
  return energy_.empty() || place_[element] == none ? 0.0 : energy_[static_cast<std::size_t>(place_[element])];
}

std::vector<NodeIndex> TileElements::nodes_of(Index element) const {
  const Place p = find(element);
  if (!p.here) return {};
  const Tile& tile = mesh_.tiles[p.tile];
  const std::size_t base = (tile.first_block + p.element / block_lanes) * mesh_.nodes_per_element * block_lanes;
  std::vector<NodeIndex> nodes(mesh_.nodes_per_element);
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    nodes[a] = mesh_.node[tile.first_node + mesh_.connectivity[base + a * block_lanes + p.element % block_lanes]];
  }
  return nodes;
}

void TileElements::watch(const std::vector<Index>& elements) {
  for (const Index element : elements) {
    const Place p = find(element);
    if (!p.here) continue;
    watched_begin_.resize(mesh_.tiles.size(), npos);
    if (watched_begin_[p.tile] != npos) continue;
    watched_begin_[p.tile] = watched_force_.size();
    const std::size_t size = mesh_.tiles[p.tile].blocks * block_lanes * mesh_.nodes_per_element * input_.components;
    watched_force_.resize(watched_force_.size() + size, 0.0);
  }
}

std::array<Vec3, 2> TileElements::force_on(Index element, std::size_t a) const {
  const Place p = find(element);
  const std::size_t c = input_.components, block = p.element / block_lanes;
  const double* own = watched_force_.data() + watched_begin_[p.tile] +
                      (block * mesh_.nodes_per_element + a) * c * block_lanes + p.element % block_lanes;
  const auto vector = [&](std::size_t first) {
    return Vec3{own[first * block_lanes], own[(first + 1) * block_lanes], own[(first + 2) * block_lanes]};
  };
  return {vector(0), c == 6 ? vector(3) : Vec3{}};
}

void TileElements::run_tile(std::size_t t, const State& state, Scratch& scratch) {
  const Tile& tile = mesh_.tiles[t];
  const bool turns = input_.components == 6;
  const std::size_t stride = node_stride(input_.components);
  scratch.node.resize(std::max(scratch.node.size(), tile.nodes * stride));
  scratch.sum.resize(std::max(scratch.sum.size(), tile.nodes * sum_stride(input_.components)), 0.0);
  const NodeIndex* node = mesh_.node.data() + tile.first_node;
  for (std::size_t k = 0; k < tile.nodes; ++k) {
    const Vec3 &x = state.nodes.x[node[k]], &v = state.nodes.v[node[k]];
    double* local = scratch.node.data() + stride * k;
    std::memcpy(local, &x, sizeof x);
    std::memcpy(local + 4, &v, sizeof v);
    if (!node_values_.empty()) local[3] = node_values_[tile.first_node + k];
    if (turns) std::memcpy(local + 8, &state.nodes.omega[node[k]], sizeof(Vec3));
  }
  const PartKernel& part = kernels_[tile.part];
  const std::size_t first = tile.first_block * block_lanes;
  TileWork work;
  work.properties = part.properties.get();
  work.connectivity = mesh_.connectivity.data() + first * mesh_.nodes_per_element;
  work.elements = tile.elements;
  work.node = scratch.node.data();
  work.sum = scratch.sum.data();
  work.nodes = tile.nodes;
  if (t + 1 < mesh_.tiles.size()) {
    const Tile& next = mesh_.tiles[t + 1];
    work.ahead = {mesh_.node.data() + next.first_node, next.nodes,
                  {state.nodes.x.data(), state.nodes.v.data(), turns ? state.nodes.omega.data() : nullptr}};
  }
  work.step = {state.clock.dt_previous, state.clock.time};
  work.history = history_.data() + history_begin_[t];
  if (part.can_fail) {
    work.smallest_step = part.smallest_step;
    work.erode_below = part.erodes ? erode_below_ : 0.0;
    work.alive = alive_.data() + first;
  }
  if (!energy_.empty()) work.energy = energy_.data() + first;
  if (!damping_.empty()) work.damping = damping_.data() + first;
  if (!steps_.empty()) work.steps = steps_.data() + first;
  if (!step_factor_.empty() && !step_factor_[t].empty()) work.step_factor = step_factor_[t].data();
  if (!watched_begin_.empty() && watched_begin_[t] != npos) work.element_force = watched_force_.data() + watched_begin_[t];
  work.force = slots_.slots(tile);
  work.past_caches = history_.size() > beyond_caches;
  part.kernel(work);
  internal_[t] += work.internal_increment;
  if (part.can_fail) count_deleted(t);
  hourglass_[t] += work.hourglass_increment;
  outcome_[t] = {work.time_step, work.governing, work.broken};
}

void TileElements::count_deleted(std::size_t t) {
  const Tile& tile = mesh_.tiles[t];
  const double* alive = alive_.data() + tile.first_block * block_lanes;
  const auto count = std::count(alive, alive + tile.elements, 0.0);
  if (count == deleted_[t]) return;
  deleted_[t] = count;
  const double* energy = energy_.data() + tile.first_block * block_lanes;
  eroded_[t] = 0;
  for (std::size_t i = 0; i < tile.elements; ++i) eroded_[t] += alive[i] > 0 ? 0.0 : energy[i];
}

void TileElements::internal_forces(const Model& model, State& state,
                                   const std::function<std::string(const State&, Index)>& fault) {
  if (empty()) return;
  scratch_.resize(static_cast<std::size_t>(omp_get_max_threads()));
  shares_.start(mesh_.tiles.size(), scratch_.size());
#pragma omp parallel if (mesh_.tiles.size() > 1)
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    shares_.run(thread, [&](std::size_t t) { run_tile(t, state, scratch_[thread]); });
  }
  governing_ = {};
  governing_.kind = input_.kind;
  for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
    const std::size_t first = mesh_.tiles[t].first_block * block_lanes;
    const Outcome& o = outcome_[t];
    if (o.broken != 0) {
      const Index element = mesh_.element[first + o.broken - 1];
      report_broken(model, state, element, fault(state, element));
    }
    if (o.time_step < governing_.time_step) {
      governing_.time_step = o.time_step;
      governing_.element = input_.ids[mesh_.element[first + o.governing]];
    }
  }
}

void TileElements::report_broken(const Model& model, const State& state, Index element, const std::string& fault) const {
  const Place p = find(element);
  const Tile& tile = mesh_.tiles[p.tile];
  std::string text = fmt::format("{} {} of part {} {} at t = {:g}; nodes", input_.element_name, input_.ids[element],
                                 model.parts[tile.part].id, fault, state.clock.time);
  std::vector<NodeIndex> nodes;
  for (const NodeIndex n : nodes_of(element)) {
    if (std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
  }
  for (const NodeIndex n : nodes) {
    const Vec3& x = state.nodes.x[n];
    text += fmt::format(" {} ({:.6g}, {:.6g}, {:.6g})", model.nodes.id[n], x.x, x.y, x.z);
  }
  throw RunError(text);
}

double TileElements::eroded_energy() const { return std::accumulate(eroded_.begin(), eroded_.end(), 0.0); }

std::int64_t TileElements::deleted() const { return std::accumulate(deleted_.begin(), deleted_.end(), std::int64_t{0}); }

void TileElements::add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
  for (std::size_t t = 0; t < internal_.size(); ++t) {
    internal[mesh_.tiles[t].part] += internal_[t] - eroded_[t];
    hourglass[mesh_.tiles[t].part] += hourglass_[t];
  }
}

}  // namespace kardan

#include "kardan/solver/node_mover.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "kardan/elements/element_system.hpp"

namespace kardan {

namespace {

constexpr std::size_t chunk_nodes = 256;   ///< forces, velocities and slots of a chunk: some 50 kB, and work for 2 us
constexpr std::size_t nodes_ahead = 48;    ///< whose vectors are asked for before their turn
/// Fewer chunks than this are moved by one thread: waking the others costs more than it saves.
constexpr std::size_t parallel_threshold = 32;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// v += force factor, unless that is not finite. In a cycle that is looked at `before` gets the velocity of before; else the force is
/// used up. @return |v|^2, not finite where v was left as it is.
inline double accelerate(Vec3& v, Vec3& force, double factor, Vec3* before) {
  const Vec3 after = v + force * factor;
  if (before) *before = v;
  const double square = dot(after, after);
  if (!std::isfinite(square)) return square;
  v = after;
  if (!before) force = {};
  return square;
}

/// Parts of the elements at each node, one entry an element, in lists by node.
class PartsOfNodes {
 public:
  PartsOfNodes(const Model& model, std::size_t nodes) : first_(nodes + 1, 0) {
    each(model, [&](std::size_t node, PartIndex) { ++first_[node + 1]; });
    for (std::size_t n = 0; n < nodes; ++n) first_[n + 1] += first_[n];
    parts_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each(model, [&](std::size_t node, PartIndex part) { parts_[next[node]++] = part; });
  }
  std::span<PartIndex> of(NodeIndex node) {
    return {parts_.data() + first_[at(node)], first_[at(node) + 1] - first_[at(node)]};
  }

 private:
  template <class F>
  static void each(const Model& model, F&& f) {
    const auto block = [&f](const auto& elements, std::size_t nodes_used) {
      for (std::size_t e = 0; e < elements.size(); ++e)
        for (std::size_t k = 0; k < nodes_used; ++k)
          if (const NodeIndex node = elements.nodes[e][k]; node != none) f(at(node), elements.part[e]);
    };
    block(model.shells, 4);
    block(model.solids, 8);
    block(model.beams, 2);
  }

  std::vector<std::uint32_t> first_;
  std::vector<PartIndex> parts_;
};

}  // namespace

/// f(chunk) for all chunks, independent of one another. Small models never enter a parallel region: that alone takes longer
/// than the step of a small mechanism.
template <class F>
void NodeMover::for_each_chunk(F&& f) {
  if (chunks_.size() <= parallel_threshold) {
    for (const Chunk& chunk : chunks_) f(chunk);
    return;
  }
  thread_shares_.start(chunks_.size(), static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel
  thread_shares_.run(static_cast<std::size_t>(omp_get_thread_num()), [&](std::size_t c) { f(chunks_[c]); });
}

NodeMover::NodeMover(const Model& model, State& state) {
  sort(model, state);
  for (const NodeIndex node : unattached_) state.nodes.v[at(node)] = state.nodes.omega[at(node)] = {};
}

void NodeMover::sort(const Model& model, const State& state) {
  const NodeState& nodes = state.nodes;
  free_.clear();
  unattached_.clear();
  inverse_mass_.clear();
  inverse_inertia_.clear();
  chunks_.clear();
  shared_.clear();
  shares_.clear();
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    if (i % chunk_nodes == 0) {
      const std::size_t end = std::min(i + chunk_nodes, nodes.x.size());
      chunks_.push_back({static_cast<NodeIndex>(i), static_cast<NodeIndex>(end), free_.size(), free_.size()});
    }
    if (nodes.body[i] != none) continue;
    if (nodes.mass[i] > 0) {
      free_.push_back(static_cast<NodeIndex>(i));
      inverse_mass_.push_back(1 / nodes.mass[i]);
      inverse_inertia_.push_back(nodes.inertia[i] > 0 ? 1 / nodes.inertia[i] : 0.0);
      chunks_.back().end_free = free_.size();
    } else {
      unattached_.push_back(static_cast<NodeIndex>(i));
    }
  }
  chunk_fastest_.assign(chunks_.size(), 0.0);
  find_parts(model, state);
}

void NodeMover::find_parts(const Model& model, const State& state) {
  part_.assign(free_.size(), none);
  if (free_.empty()) return;
  PartsOfNodes parts_of(model, state.nodes.x.size());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::span<PartIndex> parts = parts_of.of(free_[k]);
    if (parts.empty()) continue;
    std::sort(parts.begin(), parts.end());
    if (parts.front() == parts.back()) {
      part_[k] = parts.front();
      continue;
    }
    shared_.push_back({k, shares_.size()});
    for (auto i = parts.begin(); i != parts.end();) {
      const auto next = std::upper_bound(i, parts.end(), *i);
      shares_.push_back({*i, static_cast<double>(next - i) / static_cast<double>(parts.size())});
      i = next;
    }
  }
  shared_.push_back({free_.size(), shares_.size()});
}

void NodeMover::kick(const Model& model, State& state, const ElementSystem& elements, bool looked_at) {
  find_fastest([&](const Chunk& chunk) {
    elements.add_forces(state, chunk.begin, chunk.end);
    return kick_chunk(chunk, state, looked_at);
  });
  if (!std::isfinite(fastest_)) not_finite(model, state);
}

/// fastest_ from the largest squares of speeds that f(chunk) returns; infinite if one of them is not finite.
template <class F>
void NodeMover::find_fastest(F&& f) {
  for_each_chunk([&](const Chunk& chunk) { chunk_fastest_[static_cast<std::size_t>(&chunk - chunks_.data())] = f(chunk); });
  double square = 0;
  for (const double of_chunk : chunk_fastest_) square = std::max(square, of_chunk);
  fastest_ = std::sqrt(square);
}

/// @return largest square of a speed; infinite if a velocity would not be finite.
double NodeMover::kick_chunk(const Chunk& chunk, State& state, bool looked_at) const {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick();
  double largest = 0;
  bool good = true;
  for (std::size_t k = chunk.first_free; k < chunk.end_free; ++k) {
    const std::size_t i = at(free_[k]);
    if (const std::size_t soon = k + nodes_ahead; soon < free_.size()) {
      __builtin_prefetch(&nodes.v[at(free_[soon])], 1);
      if (inverse_inertia_[soon] != 0) __builtin_prefetch(&nodes.omega[at(free_[soon])], 1);
    }
    const double square = accelerate(nodes.v[i], nodes.force[i], kick * inverse_mass_[k], looked_at ? &nodes.v_now[i] : nullptr);
    good &= std::isfinite(square);
    largest = std::max(largest, square);
    if (inverse_inertia_[k] == 0) continue;
    good &= std::isfinite(
        accelerate(nodes.omega[i], nodes.moment[i], kick * inverse_inertia_[k], looked_at ? &nodes.omega_now[i] : nullptr));
  }
  return good ? largest : std::numeric_limits<double>::infinity();
}

void NodeMover::not_finite(const Model& model, const State& state) const {
  const NodeState& nodes = state.nodes;
  const double kick = state.clock.kick();
  NodeIndex first = none;
  std::size_t count = 0;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::size_t i = at(free_[k]);
    const Vec3 v = nodes.v[i] + nodes.force[i] * (kick * inverse_mass_[k]);
    const Vec3 omega = nodes.omega[i] + nodes.moment[i] * (kick * inverse_inertia_[k]);
    if (std::isfinite(dot(v, v) + dot(omega, omega))) continue;
    if (count++ == 0) first = free_[k];
  }
  KARDAN_ASSERT(first != none);
  const Vec3& x = nodes.x[at(first)];
  const Vec3& force = nodes.force[at(first)];
  throw RunError(fmt::format(
      "velocity of node {} at ({:g}, {:g}, {:g}) is not finite at t = {:g}, cycle {} (force {:g}, {:g}, {:g}; {} node{} in "
      "all)", model.nodes.id[at(first)], x.x, x.y, x.z, state.clock.time, state.clock.cycle, force.x, force.y, force.z,
      count, count == 1 ? "" : "s"));
}

void NodeMover::take_masses(const State& state, const std::vector<NodeIndex>& nodes) {
  for (const NodeIndex node : nodes) {
    const auto free = std::lower_bound(free_.begin(), free_.end(), node);
    if (free == free_.end() || *free != node) continue;
    const auto k = static_cast<std::size_t>(free - free_.begin());
    inverse_mass_[k] = 1 / state.nodes.mass[at(node)];
    inverse_inertia_[k] = state.nodes.inertia[at(node)] > 0 ? 1 / state.nodes.inertia[at(node)] : 0.0;
  }
}

void NodeMover::register_state(const Model& model, State& state) {
  state.registry.keep_value({"nodes.fastest", "length/time", "nodes.drift"}, fastest_);
  state.registry.after_restore([this, &model, &state] { sort(model, state); });
}

void NodeMover::settle(State& state) {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick(), share = state.clock.share_before();
  for_each_chunk([&](const Chunk& chunk) {
    for (std::size_t k = chunk.first_free; k < chunk.end_free; ++k) {
      const std::size_t i = at(free_[k]);
      const Vec3 change = nodes.v[i] - nodes.v_now[i], turn = nodes.omega[i] - nodes.omega_now[i];
      nodes.v_now[i] += change * share;
      nodes.a[i] = change / kick;
      nodes.omega_now[i] += turn * share;
      nodes.alpha[i] = turn / kick;
    }
  });
  for (NodeIndex node : unattached_) nodes.v_now[at(node)] = nodes.v[at(node)];
}

void NodeMover::settle_broken(State& state) const {
  NodeState& nodes = state.nodes;
  for (const NodeIndex node : free_) {
    nodes.v_now[at(node)] = nodes.v[at(node)];
    nodes.omega_now[at(node)] = nodes.omega[at(node)];
    nodes.a[at(node)] = nodes.alpha[at(node)] = {};
  }
}

void NodeMover::drift(State& state) {
  NodeState& nodes = state.nodes;
  const double dt = state.clock.dt;
  find_fastest([&](const Chunk& chunk) {
    double largest = 0;
    for (std::size_t k = chunk.first_free; k < chunk.end_free; ++k) {
      if (const std::size_t soon = k + nodes_ahead; soon < free_.size()) {
        __builtin_prefetch(&nodes.v[at(free_[soon])], 0);
        __builtin_prefetch(&nodes.x[at(free_[soon])], 1);
      }
      const Vec3 v = nodes.v[at(free_[k])];
      nodes.x[at(free_[k])] += v * dt;
      largest = std::max(largest, dot(v, v));
    }
    return largest;
  });
  for (NodeIndex node : unattached_) nodes.x[at(node)] += nodes.v[at(node)] * dt;
}

void NodeMover::account(State& state) const {
  const NodeState& nodes = state.nodes;
  EnergyLedger& energy = state.energy;
  energy.part_momentum.assign(energy.part_kinetic.size(), Vec3{});
  const auto add = [&](PartIndex part, double fraction, double kinetic, const Vec3& momentum) {
    energy.part_kinetic[at(part)] += fraction * kinetic;
    energy.part_momentum[at(part)] += momentum * fraction;
  };
  auto shared = shared_.begin();
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::size_t i = at(free_[k]);
    const double e = 0.5 * (nodes.mass[i] * dot(nodes.v_now[i], nodes.v_now[i]) +
                            nodes.inertia[i] * dot(nodes.omega_now[i], nodes.omega_now[i]));
    const Vec3 momentum = nodes.v_now[i] * nodes.mass[i];
    energy.kinetic += e;
    if (part_[k] != none) add(part_[k], 1.0, e, momentum);
    if (shared->free != k) continue;
    for (std::size_t s = shared->first_share; s < (shared + 1)->first_share; ++s)
      add(shares_[s].part, shares_[s].fraction, e, momentum);
    ++shared;
  }
}

}  // namespace kardan

#include "kardan/solver/node_mover.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <map>

namespace kardan {

namespace {

/// Fewer nodes than this are moved by one thread: waking the others costs more than it saves.
constexpr std::size_t parallel_threshold = 8192;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// f(k) for k < count, independent of one another. Small counts never enter a parallel region: that alone takes longer
/// than the step of a small mechanism.
template <class F>
void for_each_index(std::size_t count, F&& f) {
  if (count <= parallel_threshold) {
    for (std::size_t k = 0; k < count; ++k) f(k);
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < count; ++k) f(k);
}

template <class Block>
void count_parts(const Block& block, std::size_t nodes_used, std::vector<std::map<PartIndex, int>>& parts_of) {
  for (std::size_t e = 0; e < block.size(); ++e)
    for (std::size_t k = 0; k < nodes_used; ++k)
      if (const NodeIndex node = block.nodes[e][k]; node != none) ++parts_of[at(node)][block.part[e]];
}

}  // namespace

NodeMover::NodeMover(const Model& model, State& state) {
  NodeState& nodes = state.nodes;
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    if (nodes.body[i] != none) continue;
    if (nodes.mass[i] > 0) {
      free_.push_back(static_cast<NodeIndex>(i));
    } else {
      nodes.v[i] = nodes.omega[i] = {};
      unattached_.push_back(static_cast<NodeIndex>(i));
    }
  }
  v_before_.resize(free_.size());
  omega_before_.resize(free_.size());
  find_parts(model, state);
}

void NodeMover::find_parts(const Model& model, const State& state) {
  share_begin_.assign(free_.size() + 1, 0);
  if (free_.empty()) return;
  std::vector<std::map<PartIndex, int>> parts_of(state.nodes.x.size());
  count_parts(model.shells, 4, parts_of);
  count_parts(model.solids, 8, parts_of);
  count_parts(model.beams, 2, parts_of);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const auto& parts = parts_of[at(free_[k])];
    int elements = 0;
    for (const auto& [part, count] : parts) elements += count;
    for (const auto& [part, count] : parts) shares_.push_back({part, static_cast<double>(count) / elements});
    share_begin_[k + 1] = shares_.size();
  }
}

void NodeMover::kick(const Model& model, State& state) {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick();
  std::atomic<bool> bad{false};
  for_each_index(free_.size(), [&](std::size_t k) {
    const std::size_t i = at(free_[k]);
    v_before_[k] = nodes.v[i];
    omega_before_[k] = nodes.omega[i];
    nodes.v[i] += nodes.force[i] * (kick / nodes.mass[i]);
    if (nodes.inertia[i] > 0) nodes.omega[i] += nodes.moment[i] * (kick / nodes.inertia[i]);
    if (!std::isfinite(dot(nodes.v[i], nodes.v[i]) + dot(nodes.omega[i], nodes.omega[i])))
      bad.store(true, std::memory_order_relaxed);
  });
  if (bad) not_finite(model, state);
}

void NodeMover::not_finite(const Model& model, State& state) {
  NodeState& nodes = state.nodes;
  NodeIndex first = none;
  std::size_t count = 0;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::size_t i = at(free_[k]);
    if (!std::isfinite(dot(nodes.v[i], nodes.v[i]) + dot(nodes.omega[i], nodes.omega[i]))) {
      ++count;
      if (first == none) first = free_[k];
    }
    nodes.v[i] = v_before_[k];
    nodes.omega[i] = omega_before_[k];
  }
  const Vec3& x = nodes.x[at(first)];
  const Vec3& force = nodes.force[at(first)];
  throw RunError(fmt::format(
      "velocity of node {} at ({:g}, {:g}, {:g}) is not finite at t = {:g}, cycle {} (force {:g}, {:g}, {:g}; {} node{} in "
      "all)", model.nodes.id[at(first)], x.x, x.y, x.z, state.clock.time, state.clock.cycle, force.x, force.y, force.z,
      count, count == 1 ? "" : "s"));
}

void NodeMover::settle(State& state) const {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick(), share = state.clock.share_before();
  for_each_index(free_.size(), [&](std::size_t k) {
    const std::size_t i = at(free_[k]);
    const Vec3& v = v_before_[k];
    const Vec3& omega = omega_before_[k];
    nodes.v_now[i] = v + (nodes.v[i] - v) * share;
    nodes.a[i] = (nodes.v[i] - v) / kick;
    nodes.omega_now[i] = omega + (nodes.omega[i] - omega) * share;
    nodes.alpha[i] = (nodes.omega[i] - omega) / kick;
  });
  for (NodeIndex node : unattached_) nodes.v_now[at(node)] = nodes.v[at(node)];
}

void NodeMover::drift(State& state) const {
  NodeState& nodes = state.nodes;
  const double dt = state.clock.dt;
  for_each_index(free_.size(), [&](std::size_t k) { nodes.x[at(free_[k])] += nodes.v[at(free_[k])] * dt; });
  for (NodeIndex node : unattached_) nodes.x[at(node)] += nodes.v[at(node)] * dt;
}

void NodeMover::account(State& state) const {
  const NodeState& nodes = state.nodes;
  EnergyLedger& energy = state.energy;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const std::size_t i = at(free_[k]);
    const double e = 0.5 * (nodes.mass[i] * dot(nodes.v_now[i], nodes.v_now[i]) +
                            nodes.inertia[i] * dot(nodes.omega_now[i], nodes.omega_now[i]));
    energy.kinetic += e;
    for (std::size_t s = share_begin_[k]; s < share_begin_[k + 1]; ++s)
      energy.part_kinetic[at(shares_[s].part)] += shares_[s].fraction * e;
  }
}

}  // namespace kardan

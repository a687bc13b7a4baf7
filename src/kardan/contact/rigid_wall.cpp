#include "kardan/contact/rigid_wall.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace kardan {

namespace {

constexpr std::size_t chunk_nodes = 1024;
/// Fewer chunks than this are done by one thread: waking the others costs more than it saves.
constexpr std::ptrdiff_t parallel_threshold = 8;

double distance(const RigidWall& wall, const Vec3& x) { return dot(x - wall.point, wall.normal); }

std::string name_of(const RigidWall& wall) { return "rigid wall " + std::to_string(wall.id); }

}  // namespace

RigidWalls::RigidWalls(const Model& model, State& state, Diagnostics& diagnostics) {
  for (const RigidWall& wall : model.rigid_walls) {
    Wall own{wall, {}};
    std::vector<NodeIndex>& nodes = own.description.nodes;
    const auto rigid = std::erase_if(nodes, [&](NodeIndex n) { return state.nodes.body[static_cast<std::size_t>(n)] != none; });
    std::erase_if(nodes, [&](NodeIndex n) { return !(state.nodes.mass[static_cast<std::size_t>(n)] > 0); });
    const auto behind = std::count_if(nodes.begin(), nodes.end(), [&](NodeIndex n) {
      return distance(wall, state.nodes.x[static_cast<std::size_t>(n)]) < 0;
    });
    if (rigid > 0) {
      diagnostics.warning(name_of(wall) + " does not hold " + std::to_string(rigid) + " of its nodes, which belong to rigid bodies", {},
                          "*RIGIDWALL_PLANAR");
    }
    if (behind > 0) {
      diagnostics.warning(std::to_string(behind) + " nodes begin behind " + name_of(wall) + "; they are held at their depth",
                          "turn the wall's normal to the nodes, or move the wall", "*RIGIDWALL_PLANAR");
    }
    own.v_before.resize(nodes.size());
    walls_.push_back(std::move(own));
    WallReport report;
    report.id = wall.id;
    state.walls.push_back(report);
  }
  dissipated_.assign(walls_.size(), 0.0);
  dissipated_now_.assign(walls_.size(), 0.0);
  if (!empty()) state.registry.add({"walls.dissipated", "energy", "contact.hold"}, dissipated_);
}

void RigidWalls::before_kick(const State& state) {
  for (Wall& wall : walls_) {
    const auto count = static_cast<std::ptrdiff_t>(wall.v_before.size());
#pragma omp parallel for schedule(static) if (count > parallel_threshold * static_cast<std::ptrdiff_t>(chunk_nodes))
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      wall.v_before[k] = state.nodes.v[static_cast<std::size_t>(wall.description.nodes[k])];
    }
  }
}

RigidWalls::Sum RigidWalls::hold_chunk(const Wall& wall, std::size_t begin, std::size_t end, State& state) const {
  const RigidWall& w = wall.description;
  const double dt = state.clock.dt, kick = state.clock.kick();
  Sum sum;
  for (std::size_t k = begin; k < end; ++k) {
    const auto n = static_cast<std::size_t>(w.nodes[k]);
    Vec3& v = state.nodes.v[n];
    const double normal = dot(v, w.normal), allowed = -std::max(distance(w, state.nodes.x[n]), 0.0) / dt;
    if (normal >= allowed) continue;
    const double change = allowed - normal;
    Vec3 tangential = v - w.normal * normal;
    const double sliding = norm(tangential), stopped = w.friction >= 1 ? sliding : std::min(sliding, w.friction * change);
    if (stopped > 0) tangential *= 1 - stopped / sliding;
    const Vec3 held = w.normal * allowed + tangential, force = (held - v) * (state.nodes.mass[n] / kick);
    v = held;
    sum.force += force;
    sum.power_before += dot(force, wall.v_before[k]);
    sum.power_after += dot(force, held);
  }
  return sum;
}

void RigidWalls::hold(State& state) {
  const Clock& clock = state.clock;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Wall& wall = walls_[i];
    WallReport& report = state.walls[i];
    dissipated_now_[i] = dissipated_[i];
    report = {report.id, {}, 0, dissipated_[i]};
    if (clock.time < wall.description.birth || clock.time >= wall.description.death) continue;
    const std::size_t nodes = wall.description.nodes.size();
    const auto chunks = static_cast<std::ptrdiff_t>((nodes + chunk_nodes - 1) / chunk_nodes);
    sums_.assign(static_cast<std::size_t>(chunks), Sum{});
#pragma omp parallel for schedule(static) if (chunks > parallel_threshold)
    for (std::ptrdiff_t c = 0; c < chunks; ++c) {
      const std::size_t begin = static_cast<std::size_t>(c) * chunk_nodes;
      sums_[static_cast<std::size_t>(c)] = hold_chunk(wall, begin, std::min(begin + chunk_nodes, nodes), state);
    }
    Sum total;
    for (const Sum& s : sums_) {
      total.force += s.force;
      total.power_before += s.power_before;
      total.power_after += s.power_after;
    }
    report.force = -total.force;
    report.normal_force = dot(total.force, wall.description.normal);
    // The kick changes the kinetic energy by kick F.(v_{n-1/2} + v_{n+1/2})/2, and by dt_previous/2 F.(v_{n-1/2} + v_n)/2 up to t_n.
    const double power_now = total.power_before + clock.share_before() * (total.power_after - total.power_before);
    dissipated_now_[i] -= 0.25 * clock.dt_previous * (total.power_before + power_now);
    dissipated_[i] -= 0.5 * clock.kick() * (total.power_before + total.power_after);
    report.energy = dissipated_now_[i];
  }
}

void RigidWalls::account(State& state) const {
  for (const double energy : dissipated_now_) state.energy.stonewall += energy;
}

}  // namespace kardan

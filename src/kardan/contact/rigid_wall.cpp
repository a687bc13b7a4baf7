#include "kardan/contact/rigid_wall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "kardan/state/load_curve.hpp"

namespace kardan {

namespace {

constexpr const char* keyword = "*RIGIDWALL";
constexpr std::size_t chunk_nodes = 1024;
constexpr double arrival_cycles = 10;  ///< of the impulses of arriving nodes 1 in so many is handed out a cycle
/// Fewer chunks than this are done by one thread: waking the others costs more than it saves.
constexpr std::ptrdiff_t parallel_threshold = 8;
/// A list of near nodes is made to last for so many steps, and made anew when less than the smaller number may be left: what can happen
/// within one kick must not lead beyond it, because the velocities of before the kick are known of listed nodes only.
constexpr double steps_of_list = 32, steps_left = 4;
/// So few nodes are all looked at in every cycle.
constexpr std::size_t listed_from = 2048;

std::string name_of(const RigidWall& wall) { return fmt::format("rigid wall {}", wall.id); }

std::ptrdiff_t chunks_of(std::size_t count) { return static_cast<std::ptrdiff_t>((count + chunk_nodes - 1) / chunk_nodes); }

/// f(chunk, begin, end) for the chunks of `count` things, independent of one another.
template <class F>
void for_each_chunk(std::size_t count, F&& f) {
  const std::ptrdiff_t chunks = chunks_of(count);
#pragma omp parallel for schedule(static) if (chunks > parallel_threshold)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * chunk_nodes;
    f(static_cast<std::size_t>(c), begin, std::min(begin + chunk_nodes, count));
  }
}

template <class T>
void gather(std::vector<std::vector<T>>& parts, std::ptrdiff_t count, std::vector<T>& all) {
  all.clear();
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) all.insert(all.end(), parts[c].begin(), parts[c].end());
}

void warn_of_nodes_inside(const Model& model, const State& state, const RigidWall& wall, const WallShape& shape, Diagnostics& diagnostics) {
  std::vector<std::pair<double, NodeIndex>> inside;
  for (const NodeIndex n : wall.nodes) {
    const Vec3& x = state.nodes.x[n];
    const double depth = shape.depth(x).depth;
    if (depth > 0 && !(shape.has_edges() && shape.beyond_edges(x))) inside.emplace_back(-depth, n);
  }
  if (inside.empty()) return;
  std::sort(inside.begin(), inside.end());
  std::string deepest;
  for (std::size_t i = 0; i < std::min<std::size_t>(inside.size(), 5); ++i)
    deepest += fmt::format("{}{} by {:.4g}", i == 0 ? "" : ", ", model.nodes.id[inside[i].second], -inside[i].first);
  diagnostics.warning(fmt::format("{} nodes begin behind {}; they are held at their depth. The deepest: {}", inside.size(), name_of(wall), deepest),
                      "turn the wall's normal to the nodes, or move the wall", keyword);
}

void warn_of_bodies(const State& state, const RigidWall& wall, Diagnostics& diagnostics) {
  std::set<UserId> bodies;
  std::size_t count = 0;
  for (const NodeIndex n : wall.nodes) {
    if (state.nodes.body[n] == none) continue;
    ++count;
    bodies.insert(state.bodies.info[state.nodes.body[n]].id);
  }
  if (count == 0) return;
  std::string names;
  std::size_t named = 0;
  for (const UserId id : bodies)
    if (++named <= 10) names += fmt::format("{}{}", named == 1 ? "" : ", ", id);
  if (named > 10) names += fmt::format(" and {} more", named - 10);
  diagnostics.warning(fmt::format("{} does not hold {} of its nodes, which belong to rigid bodies ({} {}): RWPNAL is 0", name_of(wall), count,
                                  bodies.size() == 1 ? "part" : "parts", names),
                      "give RWPNAL on *CONTROL_CONTACT if they should meet it", keyword);
}

}  // namespace

RigidWalls::RigidWalls(const Model& model, State& state, Diagnostics& diagnostics) {
  walls_.reserve(model.rigid_walls.size());
  for (const RigidWall& wall : model.rigid_walls) {
    Wall& own = walls_.emplace_back(model, wall);
    share_nodes(model, state, own, diagnostics);
    const std::vector<NodeIndex>& nodes = own.description.nodes;
    own.marks.assign(nodes.size(), 0);
    if (wall.soft_cycles > 0) own.braked.assign(nodes.size(), 0);
    own.velocity = wall.normal * wall.velocity;
    WallReport report;
    report.id = wall.id;
    report.segment_force.resize(wall.segments.size());
    state.walls.push_back(report);
  }
  for (std::size_t i = 0; i < walls_.size(); ++i) register_state(state, i);
  Vec3 low = state.nodes.x.empty() ? Vec3{} : state.nodes.x[0], high = low;
  for (const Vec3& x : state.nodes.x)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  smallest_reach_ = 1e-3 * norm(high - low);
}

void RigidWalls::register_state(State& state, std::size_t i) {
  Wall& own = walls_[i];
  Registry& registry = state.registry;
  const auto info = [i](const char* name, const char* unit, const char* writer) { return ArrayInfo{fmt::format("walls.{}.{}", i, name), unit, writer}; };
  registry.add_value(info("displacement", "length", "contact.apply"), own.displacement);
  registry.add_value(info("velocity", "length/time", "contact.hold"), own.velocity);
  registry.add_value(info("loss", "energy", "contact.close_kick"), own.loss);
  registry.add_value(info("drive", "energy", "contact.close_kick"), own.drive);
  registry.add_value(info("arrived", "force*time", "contact.hold"), own.arrived);
  registry.add_value(info("arrived_normal", "force*time", "contact.hold"), own.arrived_normal);
  registry.add(info("marks", "1", "contact.hold"), own.marks);
  registry.add(info("braked", "1", "contact.hold"), own.braked);
  own.penalty.register_state(registry, fmt::format("walls.{}", i));
  registry.keep_value(info("born", "1", "contact.apply"), own.born);
  registry.keep_value(info("alive", "1", "contact.apply"), own.alive);
  registry.keep_value(info("friction_axis", "1", "contact.hold"), own.friction_axis);
  registry.keep_list(info("near", "1", "contact.before_kick"), own.near);
  registry.keep_value(info("skin", "length", "contact.before_kick"), own.skin);
  registry.keep_value(info("travelled", "length", "contact.apply"), own.travelled);
  registry.keep_value(info("loss_now", "energy", "contact.close_kick"), own.loss_now);
  registry.keep_value(info("drive_counted", "energy", "contact.close_kick"), own.drive_counted);
  registry.keep_value(info("reported_displacement", "length", "contact.hold"), state.walls[i].displacement);
  registry.keep_value(info("reported_velocity", "length/time", "contact.hold"), state.walls[i].velocity);
}

/// Which of the wall's nodes are held by the constraint method and which by springs.
void RigidWalls::share_nodes(const Model& model, const State& state, Wall& wall, Diagnostics& diagnostics) const {
  RigidWall& w = wall.description;
  const double penalty = model.control.contact.wall_penalty, scale = std::abs(penalty) * w.penalty_scale;
  if (penalty == 0) warn_of_bodies(state, w, diagnostics);
  std::erase_if(w.nodes, [&](NodeIndex n) { return state.nodes.body[n] == none ? !(state.nodes.mass[n] > 0) : penalty == 0; });
  if (w.birth <= 0) warn_of_nodes_inside(model, state, w, wall.shape, diagnostics);
  std::vector<NodeIndex> sprung;
  std::erase_if(w.nodes, [&](NodeIndex n) {
    const bool by_spring = penalty < 0 || state.nodes.body[n] != none;
    if (by_spring) sprung.push_back(n);
    return by_spring;
  });
  wall.penalty.initialise(state, sprung, scale);
  if (sprung.empty()) return;
  if (w.welds || w.orthotropic || w.soft_cycles > 0)
    diagnostics.error(fmt::format("{} nodes meet {} by penalty (RWPNAL), with which FRIC 2 and 3, _ORTHO and SOFT are not available", sprung.size(),
                                  name_of(w)), "exempt these nodes (NSIDEX), or leave out the option", keyword);
  if (!(scale > 0) || scale > WallPenalty::largest_scale)
    diagnostics.error(fmt::format("RWPNAL RWKSF = {:g} of {} would not be stable", scale, name_of(w)),
                      fmt::format("give a product up to {:g}; 1 is usual", WallPenalty::largest_scale), keyword);
}

/// The wall begins to exist: nodes that stand behind the surface's edges may stay there.
void RigidWalls::bear(const Model& model, const State& state, Wall& wall) const {
  const RigidWall& w = wall.description;
  wall.born = true;
  if (w.motion != none && w.motion_is_displacement)
    wall.displacement = w.motion_direction * load_curve_value(model, state.clock, w.motion, state.clock.time - w.birth);
  wall.penalty.bear(state, wall.shape, wall.displacement);
  if (!wall.shape.has_edges()) return;
  for (std::size_t k = 0; k < w.nodes.size(); ++k) {
    const Vec3 r = state.nodes.x[w.nodes[k]] - wall.displacement;
    if (wall.shape.depth(r).depth > 0 && wall.shape.beyond_edges(r)) wall.marks[k] |= Mark::behind;
  }
}

/// Lists the nodes that can reach the wall within `steps_of_list` steps.
void RigidWalls::list_near(const State& state, Wall& wall, double fastest) {
  const std::vector<NodeIndex>& nodes = wall.description.nodes;
  const auto chunks = chunks_of(nodes.size());
  chunk_near_.resize(std::max(chunk_near_.size(), static_cast<std::size_t>(chunks)));
  chunk_speed_.assign(static_cast<std::size_t>(chunks), 0.0);
  for_each_chunk(nodes.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      chunk_speed_[c] = std::max(chunk_speed_[c], dot(state.nodes.v[nodes[k]], state.nodes.v[nodes[k]]));
  });
  for (const double speed : chunk_speed_) fastest = std::max(fastest, std::sqrt(speed));
  const bool first = wall.skin < 0;
  const double reach = steps_of_list * state.clock.dt * (fastest + norm(wall.velocity));
  wall.skin = nodes.size() < listed_from ? std::numeric_limits<double>::infinity() : smallest_reach_ + reach;
  wall.travelled = 0;
  for_each_chunk(nodes.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    chunk_near_[c].clear();
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3 r = state.nodes.x[nodes[k]] - wall.displacement;
      std::uint8_t& mark = wall.marks[k];
      const bool edges = wall.shape.has_edges(), inside = edges && wall.shape.depth(r).depth > 0;
      // What was out of sight and is behind the surface now has gone round it.
      if (inside && !first && (mark & Mark::listed) == 0) mark |= Mark::behind;
      const bool near = wall.shape.clearance(r) <= wall.skin || (inside && (mark & Mark::behind) == 0);
      mark = static_cast<std::uint8_t>(near ? mark | Mark::listed : mark & ~Mark::listed);
      if (near) chunk_near_[c].push_back(static_cast<std::uint32_t>(k));
    }
  });
  gather(chunk_near_, chunks, wall.near);
}

void RigidWalls::apply(const Model& model, State& state, double fastest) {
  const Clock& clock = state.clock;
  for (Wall& wall : walls_) {
    const RigidWall& w = wall.description;
    if (wall.alive) {
      wall.displacement += wall.velocity * clock.dt_previous;
      wall.travelled += clock.dt_previous * (fastest + norm(wall.velocity));
    }
    wall.alive = clock.time >= w.birth && clock.time < w.death;
    wall.held.clear();
    wall.penalty.let_go();
    wall.velocity_before = wall.velocity;
    if (!wall.alive) continue;
    if (!wall.born) bear(model, state, wall);
    wall.penalty.apply(state, wall.shape, wall.displacement, w.friction);
    wall.penalty_power = wall.penalty.power(state, wall.velocity);
  }
}

void RigidWalls::before_kick(State& state, double fastest) {
  for (Wall& wall : walls_) {
    if (!wall.alive) continue;
    const std::vector<NodeIndex>& nodes = wall.description.nodes;
    if (margin(wall) < steps_left * state.clock.dt * (fastest + norm(wall.velocity)) + 0.5 * smallest_reach_) list_near(state, wall, fastest);
    wall.v_before.resize(wall.near.size());
    for_each_chunk(wall.near.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) wall.v_before[i] = state.nodes.v[nodes[wall.near[i]]];
    });
  }
}

Vec3 RigidWalls::driven_velocity(const Model& model, const State& state, const Wall& wall) const {
  const RigidWall& w = wall.description;
  const Clock& clock = state.clock;
  const auto value = [&](double time) { return load_curve_value(model, clock, w.motion, time - w.birth); };
  if (!w.motion_is_displacement) return w.motion_direction * value(clock.time + 0.5 * clock.dt);
  return (w.motion_direction * value(clock.time + clock.dt) - wall.displacement) / clock.dt;
}

double RigidWalls::braking_share(const Wall& wall, std::size_t k) {
  if (wall.braked.empty() || (wall.marks[k] & Mark::welded) != 0) return 1;
  return 1.0 / std::max(wall.description.soft_cycles - wall.braked[k], 1);
}

Vec3 RigidWalls::free_velocity(const State& state, const Wall& wall) {
  const RigidWall& w = wall.description;
  if (state.clock.relaxing) return {};
  const double before = dot(wall.velocity, w.normal);
  obstacles_.clear();
  for (const std::uint32_t k : wall.near) {
    const NodeIndex n = w.nodes[k];
    const Vec3 r = state.nodes.x[n] - wall.displacement;
    const double gap = -wall.shape.depth(r).depth;
    if ((wall.marks[k] & Mark::behind) != 0 && gap < 0) continue;
    if (wall.shape.resist(r, state.nodes.v[n] - wall.velocity, state.clock.dt).passes) continue;
    const bool fast = (wall.marks[k] & Mark::welded) != 0;
    obstacles_.push_back({state.nodes.mass[n] * braking_share(wall, k),
                          dot(state.nodes.v[n], w.normal) + (fast ? 0 : std::max(gap, 0.0) / state.clock.dt), fast});
  }
  double velocity = before;
  for (int iteration = 0; iteration < 60; ++iteration) {
    double mass = w.mass, momentum = w.mass * before - state.clock.kick() * dot(wall.penalty.force(), w.normal);
    for (const Obstacle& o : obstacles_) {
      if (!o.welded && o.threshold >= velocity) continue;
      mass += o.mass;
      momentum += o.mass * o.threshold;
    }
    const double next = momentum / mass;
    // After the first step the root is approached from above.
    if (next == velocity || (iteration > 0 && next > velocity)) break;
    velocity = next;
  }
  return w.normal * velocity;
}

/// What friction leaves of the velocity u against the wall, after the impulse `change` (per mass) along the normal.
Vec3 RigidWalls::rub(const Wall& wall, const Vec3& u, const Vec3& normal, double change) {
  const RigidWall& w = wall.description;
  const Vec3 along = normal * dot(u, normal);
  Vec3 tangential = u - along;
  if (w.orthotropic) {
    const std::array<Vec3, 2> axes{wall.friction_axis, cross(normal, wall.friction_axis)};
    Vec3 left;
    for (std::size_t i = 0; i < 2; ++i) {
      const double v = dot(tangential, axes[i]);
      const double mu = w.orthotropic->dynamic[i] +
                        (w.orthotropic->statical[i] - w.orthotropic->dynamic[i]) * std::exp(-w.orthotropic->decay[i] * std::abs(v));
      left += axes[i] * std::copysign(std::max(std::abs(v) - mu * change, 0.0), v);
    }
    return along + left;
  }
  const double sliding = norm(tangential), stopped = w.friction >= 1 ? sliding : std::min(sliding, w.friction * change);
  if (stopped > 0) tangential *= 1 - stopped / sliding;
  return along + tangential;
}

/// The share of a pressing force that stops an approach, which alone would take the force `stopping`. With SOFT the impact has its length already.
double RigidWalls::arriving_share(const Wall& wall, double stopping, double pressing) {
  if (!wall.braked.empty() || !(stopping > 0) || !(pressing > 0)) return 0;
  return std::min(stopping / pressing, 1.0);
}

void RigidWalls::hold_chunk(Wall& wall, std::size_t begin, std::size_t end, State& state, std::vector<Held>& held) const {
  const RigidWall& w = wall.description;
  const double dt = state.clock.dt, kick = state.clock.kick();
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t k = wall.near[i];
    const NodeIndex n = w.nodes[k];
    std::uint8_t& mark = wall.marks[k];
    const Vec3 r = state.nodes.x[n] - wall.displacement, u = state.nodes.v[n] - wall.velocity;
    if ((mark & Mark::behind) != 0) {
      if (wall.shape.depth(r).depth > 0) continue;
      mark = static_cast<std::uint8_t>(mark & ~Mark::behind);
    }
    WallShape::Resistance resistance = wall.shape.resist(r, u, dt);
    if (resistance.passes) mark = static_cast<std::uint8_t>((mark | Mark::behind) & ~Mark::welded);
    if ((mark & Mark::welded) != 0) resistance.change = -dot(u, resistance.normal);
    if (!(resistance.change > 0) && (mark & Mark::welded) == 0) {
      if (!wall.braked.empty()) wall.braked[k] = 0;
      continue;
    }
    const double change = resistance.change * braking_share(wall, k);
    if (!wall.braked.empty() && wall.braked[k] < w.soft_cycles) ++wall.braked[k];
    if (w.welds && dot(wall.v_before[i] - wall.velocity_before, resistance.normal) < -w.weld_velocity) mark |= Mark::welded;
    Vec3 after = rub(wall, u + resistance.normal * change, resistance.normal, change);
    if (wall.shape.concave()) {
      const WallShape::Resistance again = wall.shape.resist(r, after, dt);
      if (again.change > 0) after += again.normal * again.change;
    }
    const Vec3 force = (after - u) * (state.nodes.mass[n] / kick);
    state.nodes.v[n] = after + wall.velocity;
    const double pressing = dot(force, resistance.normal);
    const Vec3 u_before = wall.v_before[i] - wall.velocity_before;
    held.push_back({n, force, pressing, arriving_share(wall, state.nodes.mass[n] / kick * -dot(u_before, resistance.normal), pressing), dot(force, u_before)});
  }
}

void RigidWalls::hold(const Model& model, State& state, double fastest) {
  const Clock& clock = state.clock;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    Wall& wall = walls_[i];
    const RigidWall& w = wall.description;
    WallReport& report = state.walls[i];
    if (!wall.alive) {
      sum_forces(wall, clock.kick(), report);
      continue;
    }
    if (w.motion != none) wall.velocity = driven_velocity(model, state, wall);
    // A kick beyond what the list was made for. The velocities of before it are lost of nodes that were not listed.
    const double reach = fastest + norm(wall.velocity) + (w.mass > 0 ? fastest : 0.0);
    if (margin(wall) < clock.dt * reach) {
      list_near(state, wall, fastest);
      wall.v_before.clear();
      for (const std::uint32_t k : wall.near) wall.v_before.push_back(state.nodes.v[w.nodes[k]]);
    }
    if (w.mass > 0) wall.velocity = free_velocity(state, wall);
    if (const auto& o = w.orthotropic) {
      const Vec3 d = o->node1 == none ? o->direction : state.nodes.x[o->node2] - state.nodes.x[o->node1];
      const Vec3 a = d - w.normal * dot(d, w.normal);
      wall.friction_axis = norm(a) > 0 ? normalized(a) : wall.friction_axis;
    }
    const auto chunks = chunks_of(wall.near.size());
    chunk_held_.resize(std::max<std::size_t>(chunk_held_.size(), static_cast<std::size_t>(chunks)));
    for_each_chunk(wall.near.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
      chunk_held_[c].clear();
      hold_chunk(wall, begin, end, state, chunk_held_[c]);
    });
    gather(chunk_held_, chunks, wall.held);
    sum_forces(wall, clock.kick(), report);
    report.displacement = wall.displacement;
    report.velocity = wall.velocity_before + (wall.velocity - wall.velocity_before) * clock.share_before();
  }
}

void RigidWalls::sum_forces(Wall& wall, double kick, WallReport& report) {
  wall.force = wall.penalty.force();
  report.normal_force = 0;
  Vec3 arriving;
  double arriving_normal = 0;
  double power = wall.penalty.pushes().empty() ? 0.0 : wall.penalty_power;
  for (const WallPenalty::Push& p : wall.penalty.pushes()) report.normal_force += p.pressing;
  for (const Held& h : wall.held) {
    wall.force += h.force;
    report.normal_force += h.pressing;
    arriving += h.force * h.arriving;
    arriving_normal += h.pressing * h.arriving;
    power += h.power_before;
  }
  report.force = -wall.force;
  wall.arrived += arriving * kick;
  wall.arrived_normal += arriving_normal * kick;
  const Vec3 handed_out = wall.arrived * (1 / arrival_cycles);
  const double handed_out_normal = wall.arrived_normal * (1 / arrival_cycles);
  wall.arrived -= handed_out;
  wall.arrived_normal -= handed_out_normal;
  const double rate = kick > 0 ? 1 / kick : 0.0;
  report.eased_force = arriving - wall.force - handed_out * rate;
  report.eased_normal_force = report.normal_force - arriving_normal + handed_out_normal * rate;
  wall.loss.before(-power);
  wall.drive.before(dot(wall.force, wall.velocity_before));
}

void RigidWalls::close_kick(State& state) {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    Wall& wall = walls_[i];
    double power = wall.penalty.power(state, wall.velocity);
    for (const Held& h : wall.held) power += dot(h.force, state.nodes.v[h.node] - wall.velocity);
    wall.loss_now = state.walls[i].energy = wall.loss.after(-power, state.clock);
    const double work = wall.drive.after(dot(wall.force, wall.velocity), state.clock);
    if (wall.description.motion == none) continue;
    state.energy.external_work += work - wall.drive_counted;
    wall.drive_counted = work;
  }
}

void RigidWalls::account(State& state) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Wall& wall = walls_[i];
    WallReport& report = state.walls[i];
    state.energy.stonewall += wall.loss_now;
    if (wall.alive) state.energy.kinetic += 0.5 * wall.description.mass * dot(report.velocity, report.velocity);
    std::fill(report.segment_force.begin(), report.segment_force.end(), Vec3{});
    if (wall.segments.empty()) continue;
    const auto add = [&](const Vec3& place, const Vec3& force) {
      if (const Index segment = wall.segments.find(place); segment != none) report.segment_force[segment] -= force;
    };
    for (const Held& h : wall.held) add(state.nodes.x[h.node] - wall.displacement, h.force);
    for (const WallPenalty::Push& p : wall.penalty.pushes()) add(p.place, p.force);
  }
}

void RigidWalls::restart() {
  for (Wall& wall : walls_) {
    wall.loss = wall.drive = {};
    wall.loss_now = wall.drive_counted = wall.arrived_normal = 0;
    wall.arrived = {};
    wall.travelled = std::numeric_limits<double>::max();  // a new list
    wall.velocity = wall.description.normal * wall.description.velocity;
  }
}

}  // namespace kardan

#include "kardan/contact/edge_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "kardan/model/beam_sections.hpp"

namespace kardan {

namespace {

constexpr double margin_share = 0.25;  ///< of the edges' mean length
constexpr double same = 1e-9;          ///< distances closer than this part of it are one closest point
constexpr double explained_steps = 1.5;

bool share_node(const std::array<NodeIndex, 2>& a, const std::array<NodeIndex, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

std::vector<NodeIndex> nodes_of(const Surface& surface) {
  std::vector<NodeIndex> nodes;
  for (const SurfaceNode& n : surface.nodes()) nodes.push_back(n.node);
  return nodes;
}

}  // namespace

EdgeContact::EdgeContact(const Model& model, const Surface& surface) : meter_(nodes_of(surface)) {
  add_beams(model, surface);
  add_free_edges(model, surface);
  double length = 0;
  for (const Edge& e : edges_) length += norm(model.nodes.x[e.nodes[1]] - model.nodes.x[e.nodes[0]]);
  if (!edges_.empty()) margin_ = margin_share * length / static_cast<double>(edges_.size());
}

void EdgeContact::add_beams(const Model& model, const Surface& surface) {
  for (const Index beam : surface.beams()) {
    Edge e;
    e.nodes = {model.beams.nodes[beam][0], model.beams.nodes[beam][1]};
    const SurfaceNode &a = surface.nodes()[surface.place_of(e.nodes[0])], &b = surface.nodes()[surface.place_of(e.nodes[1])];
    e.stiffness = std::min(a.stiffness, b.stiffness);
    e.area = beam_area(beam_section(model, beam));
    e.radius = std::min({std::sqrt(e.area / std::numbers::pi), a.half_thickness, b.half_thickness});
    e.part = model.beams.part[beam];
    e.element = beam;
    e.kind = ElementKind::beam;
    edges_.push_back(e);
  }
}

void EdgeContact::add_free_edges(const Model& model, const Surface& surface) {
  std::map<std::pair<NodeIndex, NodeIndex>, std::pair<Index, int>> found;  // ordered: the edges' order is the model's
  const auto& segments = surface.segments();
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].kind != ElementKind::shell) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = segments[s].nodes[k], b = segments[s].nodes[(k + 1) & 3];
      if (a == b) continue;
      auto& entry = found.try_emplace(std::minmax(a, b), static_cast<Index>(s), 0).first->second;
      ++entry.second;
    }
  }
  for (const auto& [nodes, entry] : found) {
    if (entry.second != 1) continue;
    const Segment& s = segments[entry.first];
    Edge e;
    e.nodes = {nodes.first, nodes.second};
    e.radius = s.half_thickness;
    e.stiffness = s.stiffness;
    e.area = s.half_thickness * norm(model.nodes.x[nodes.second] - model.nodes.x[nodes.first]);
    e.part = s.part;
    e.element = s.element;
    edges_.push_back(e);
  }
}

/// Sweep along x: pairs whose boxes, inflated by radius and half the margin, overlap; ascending.
void EdgeContact::search(const State& state) {
  const std::vector<Vec3>& x = state.nodes.x;
  struct Extent {
    Vec3 low, high;
  };
  std::vector<Extent> box(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const double by = edges_[e].radius + 0.5 * margin_;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [low, high] = std::minmax(x[edges_[e].nodes[0]][a], x[edges_[e].nodes[1]][a]);
      box[e].low[a] = low - by;
      box[e].high[a] = high + by;
    }
  }
  std::vector<Index> order(edges_.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return box[a].low.x < box[b].low.x; });
  pairs_.clear();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Index a = order[i];
    for (std::size_t j = i + 1; j < order.size() && box[order[j]].low.x <= box[a].high.x; ++j) {
      const Index b = order[j];
      if (box[a].low.y > box[b].high.y || box[b].low.y > box[a].high.y || box[a].low.z > box[b].high.z || box[b].low.z > box[a].high.z) continue;
      if (edges_[a].dead || edges_[b].dead || share_node(edges_[a].nodes, edges_[b].nodes)) continue;
      const BodyIndex body = state.nodes.body[edges_[a].nodes[0]];
      if (body != none && body == state.nodes.body[edges_[a].nodes[1]] && body == state.nodes.body[edges_[b].nodes[0]] &&
          body == state.nodes.body[edges_[b].nodes[1]])
        continue;
      pairs_.push_back({std::min(a, b), std::max(a, b), 0});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) { return std::pair(a.first, a.second) < std::pair(b.first, b.second); });
  meter_.renew(x, state.nodes.v);
  renew_ = false;
}

EdgeContact::Place EdgeContact::look(const State& state, std::size_t pair) const {
  const auto &a = edges_[pairs_[pair].first].nodes, &b = edges_[pairs_[pair].second].nodes;
  const std::vector<Vec3>& x = state.nodes.x;
  const Vec3 d1 = x[a[1]] - x[a[0]], d2 = x[b[1]] - x[b[0]], r = x[a[0]] - x[b[0]];
  const double aa = dot(d1, d1), ee = dot(d2, d2), f = dot(d2, r), c = dot(d1, r), bb = dot(d1, d2);
  const double denominator = aa * ee - bb * bb;
  double s = denominator > 1e-12 * aa * ee ? std::clamp((bb * f - c * ee) / denominator, 0.0, 1.0) : 0.5;
  double t = (bb * s + f) / ee;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((bb * t - c) / aa, 0.0, 1.0);
  }
  Place p;
  p.pair = pair;
  p.s = s;
  p.t = t;
  p.u = r + d1 * s - d2 * t;
  p.distance = norm(p.u);
  return p;
}

/// Whether this pair is one that edges make: with a beam always, between shells only where both closest points are inside.
bool EdgeContact::meets(const Place& p) const {
  const Edge &a = edges_[pairs_[p.pair].first], &b = edges_[pairs_[p.pair].second];
  const bool inside = p.s > 0 && p.s < 1 && p.t > 0 && p.t < 1;
  return inside || (a.kind == ElementKind::beam && b.kind == ElementKind::beam) || (a.kind == ElementKind::beam ? p.s > 0 && p.s < 1 : false) ||
         (b.kind == ElementKind::beam ? p.t > 0 && p.t < 1 : false);
}

/// No other pair that shares an end holding a closest point is nearer, or as near and before it.
bool EdgeContact::is_minimum(const Place& p) const {
  const Pair& pair = pairs_[p.pair];
  const auto end = [&](const Edge& e, double at) { return at <= 0 ? e.nodes[0] : at >= 1 ? e.nodes[1] : none; };
  const NodeIndex ends[] = {end(edges_[pair.first], p.s), end(edges_[pair.second], p.t)};
  const double tolerance = same * (p.distance + margin_);
  for (const Place& q : places_) {
    if (q.pair == p.pair) continue;
    const Pair& other = pairs_[q.pair];
    const auto has = [](const Edge& e, NodeIndex n) { return n != none && (e.nodes[0] == n || e.nodes[1] == n); };
    const bool beside = (has(edges_[other.first], ends[0]) && other.second == pair.second) || (has(edges_[other.second], ends[1]) && other.first == pair.first) ||
                        (has(edges_[other.second], ends[0]) && other.first == pair.second) || (has(edges_[other.first], ends[1]) && other.second == pair.first);
    if (beside && (q.distance < p.distance - tolerance || (q.distance <= p.distance + tolerance && q.pair < p.pair))) return false;
  }
  return true;
}

/// The touch of the same edges, or of neighbours of theirs, in the last cycle.
const EdgeTouch* EdgeContact::recall(const Place& p) const {
  const Pair& pair = pairs_[p.pair];
  const EdgeTouch* near = nullptr;
  for (const EdgeTouch& m : before_) {
    if (m.first == pair.first && m.second == pair.second) return &m;
    const auto close = [&](Index a, Index b) { return a == b || share_node(edges_[a].nodes, edges_[b].nodes); };
    if (!near && close(m.first, pair.first) && close(m.second, pair.second)) near = &m;
  }
  return near;
}

EdgeTouch EdgeContact::decide(const State& state, const Place& p, bool birth) const {
  const Pair& pair = pairs_[p.pair];
  const auto &a = edges_[pair.first].nodes, &b = edges_[pair.second].nodes;
  const std::vector<Vec3>& v = state.nodes.v;
  EdgeTouch e;
  e.first = pair.first;
  e.second = pair.second;
  e.s = p.s;
  e.t = p.t;
  Touch& t = e.touch;
  const Vec3 relative = v[a[0]] * (1 - p.s) + v[a[1]] * p.s - v[b[0]] * (1 - p.t) - v[b[1]] * p.t;
  const double dt = birth ? 0.0 : state.clock.dt_previous;
  const EdgeTouch* memory = recall(p);
  const Vec3 before = memory ? memory->touch.direction : p.u - relative * dt;
  const bool beyond = dot(p.u, before) < 0;
  const double reach = edges_[pair.first].radius + edges_[pair.second].radius;
  t.direction = p.distance > same * margin_ ? p.u * ((beyond ? -1 : 1) / p.distance) : normalized(before);
  t.penetration = beyond ? reach + p.distance : reach - p.distance;
  t.share = t.penetration > 0 ? 1 : 0;
  const double known = memory ? std::max(0.0, memory->touch.penetration - memory->touch.offset) : 0.0;
  t.offset = std::max(memory ? std::min(memory->touch.offset, t.penetration) : 0.0, t.penetration - known - explained_steps * norm(relative) * dt);
  if (memory) {
    t.friction = memory->touch.friction;
    t.largest = memory->touch.largest;
  }
  return e;
}

TouchMotion EdgeContact::motion(const State& state, const EdgeTouch& e, const std::vector<double>& inverse_mass) const {
  const auto &a = edges_[e.first].nodes, &b = edges_[e.second].nodes;
  const NodeIndex node[] = {a[0], a[1], b[0], b[1]};
  const double weight[] = {1 - e.s, e.s, -(1 - e.t), -e.t};
  TouchMotion m;
  m.stiffness = edges_[e.second].stiffness;
  m.dt = state.clock.dt_previous;
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double inverse = inverse_mass[node[k]];
    m.velocity += state.nodes.v[node[k]] * weight[k];
    m.inverse_mass += std::abs(weight[k]) * inverse;
    largest = std::max(largest, inverse);
  }
  m.lightest = m.reduced = largest > 0 ? 1 / largest : 0.0;
  return m;
}

/// Minus the work of the forces over half of the last step.
double EdgeContact::work(const State& state) const {
  double sum = 0;
  for_each([&](const auto& a, const auto& wa, const auto& b, const auto& wb, const Vec3& force) {
    Vec3 relative;
    for (std::size_t k = 0; k < 2; ++k) relative += state.nodes.v[a[k]] * wa[k] - state.nodes.v[b[k]] * wb[k];
    sum -= 0.5 * state.clock.dt_previous * dot(force, relative);
  });
  return sum;
}

PassEnergy EdgeContact::end(const State& state) {
  PassEnergy energy;
  energy.nodes = work(state);
  touches_.clear();
  renew_ = true;
  meter_.advance(state.nodes.v, state.clock.dt_previous);
  return energy;
}

PassEnergy EdgeContact::evaluate(const State& state, bool birth, const PenaltyLaw& law, const std::vector<double>& inverse_mass) {
  meter_.advance(state.nodes.v, birth ? 0.0 : state.clock.dt_previous);
  if (renew_ || meter_.exceeds(0.5 * margin_, state.nodes.x)) search(state);
  PassEnergy energy;
  energy.nodes = work(state);
  std::swap(touches_, before_);
  touches_.clear();
  places_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    if (pair.wake > meter_.travel()) continue;
    const Place p = look(state, i);
    const double gap = p.distance - edges_[pair.first].radius - edges_[pair.second].radius;
    if (gap > 2 * meter_.last_travel()) {
      const bool held = std::any_of(before_.begin(), before_.end(), [&](const EdgeTouch& m) { return m.first == pair.first && m.second == pair.second; });
      if (!held) {
        pair.wake = meter_.travel() + 0.5 * gap;
        continue;
      }
    }
    places_.push_back(p);
  }
  for (const Place& p : places_) {
    if (!meets(p) || !is_minimum(p)) continue;
    EdgeTouch e = decide(state, p, birth);
    if (e.touch.share == 0) continue;
    SurfaceNode first;
    Segment second;
    first.part = edges_[e.first].part;
    first.stiffness = edges_[e.first].stiffness;
    first.area = edges_[e.first].area;
    second.part = edges_[e.second].part;
    second.area = edges_[e.second].area;
    energy.friction += law.apply(first, second, motion(state, e, inverse_mass), 1, e.touch);
    touches_.push_back(e);
  }
  energy.nodes += work(state);
  return energy;
}

void EdgeContact::register_state(Registry& registry, const std::string& name) {
  registry.add_list({name + ".edge_touches", "mixed", "contacts.apply"}, touches_);
  registry.keep({name + ".edges", "mixed", "contacts.drop_deleted"}, edges_);
  registry.keep_list({name + ".edge_pairs", "1, length", "contacts.apply"}, pairs_);
  registry.keep_value({name + ".edge_search_due", "1", "contacts.apply"}, renew_);
  meter_.register_state(registry, name + ".edge_meter");
}

void EdgeContact::drop_dead(const Alive& alive) {
  for (Edge& e : edges_) e.dead = e.dead || !alive(e.kind, e.element);
  renew_ = true;
}

}  // namespace kardan

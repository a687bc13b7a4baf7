#include "kardan/contact/tie_springs.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kardan/base/rotation.hpp"

namespace kardan {

namespace {

constexpr double share_of_springs = 0.4, share_of_turning = 0.2;  ///< alpha: largest eigenvalue times dt^2
constexpr double heavier = 10;  ///< times its rotary inertia is that of a node whose rotations springs hold
constexpr double grown = 1.05;                                    ///< of the step, before the stiffness follows
/// Fewer ties than this are done by one thread: waking the others costs more than it saves.
constexpr std::ptrdiff_t parallel_threshold = 2000;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

/// sum_j |b_sj| c_j/m_j of every spring: entries are collected for all springs, then summed.
class TieSprings::StiffnessBound {
 public:
  explicit StiffnessBound(const State& state) : state_(state) {
    for (auto* sums : {&linear_, &angular_}) sums->assign(state.nodes.x.size() + state.bodies.info.size(), 0.0);
  }
  /// f(linear, angular, node, share) for all entries of a spring: translations, and rotations where `turning`.
  template <class F>
  void each(const TiedPoint& p, bool turning, F&& f) const {
    const NodeState& nodes = state_.nodes;
    const double arm = norm(p.arm);
    Vec3 center;
    p.foot.each([&](std::size_t, std::size_t n) { center += nodes.x[n] / p.foot.corners; });
    Mat3 moment;
    p.foot.each([&](std::size_t, std::size_t n) {
      const Vec3 r = nodes.x[n] - center;
      moment += Mat3::identity() * dot(r, r) - outer(r, r);
    });
    const Vec3 axes = principal_axes(moment).values;
    const double smallest = std::min({axes.x, axes.y, axes.z});
    const bool nodal = p.foot.spin != Spin::fitted, fitted = p.foot.spin != Spin::nodal;
    f(!turning, at(p.node), 1.0);
    p.foot.each([&](std::size_t i, std::size_t n) {
      const double w = p.foot.weights[i], lever = fitted ? norm(nodes.x[n] - center) / smallest : 0.0, angle = turning ? 1.0 : arm;
      const double force = (turning ? 0.0 : w) + lever * angle;
      if (force > 0) f(true, n, force);
      if (nodal && w * angle > 0) f(false, n, w * angle);
    });
  }
  void collect(const TiedPoint& p, bool turning) {
    each(p, turning, [&](bool linear, std::size_t n, double share) { (linear ? linear_ : angular_)[place(n)] += share; });
  }
  double sum(const TiedPoint& p, bool turning) const {
    double total = 0;
    each(p, turning, [&](bool linear, std::size_t n, double share) {
      total += share * (linear ? linear_ : angular_)[place(n)] * inverse_mass(linear, n);
    });
    return total;
  }

 private:
  std::size_t place(std::size_t n) const {
    const BodyIndex b = state_.nodes.body[n];
    return b == none ? n : state_.nodes.x.size() + at(b);
  }
  double inverse_mass(bool linear, std::size_t n) const {
    const auto inverse = [](double m) { return m > 0 ? 1 / m : 0.0; };
    const BodyIndex b = state_.nodes.body[n];
    if (b == none) return inverse(linear ? state_.nodes.mass[n] : state_.nodes.inertia[n]);
    const BodyInfo& info = state_.bodies.info[at(b)];
    const Vec3 &j = info.principal_inertia, arm = state_.nodes.x[n] - state_.bodies.motion[at(b)].center;
    const double turning = inverse(std::min({j.x, j.y, j.z}));
    return linear ? inverse(info.mass) + dot(arm, arm) * turning : turning;
  }

  const State& state_;
  std::vector<double> linear_, angular_;  ///< c_j by node, then by body
};

TieSprings::TieSprings(const Model& model, State& state, std::vector<TiedPoint> points)
    : holds_(model.contacts.size()), tracked_(model.contacts.size()), reference_(model.contacts.size()), counted_(model.contacts.size()),
      power_(model.contacts.size()) {
  for (TiedPoint& p : points) {
    const Contact& contact = model.contacts[p.contact];
    const bool turns = contact.tie.rotations && (state.nodes.inertia[at(p.node)] > 0 || state.nodes.body[at(p.node)] != none);
    if (turns && state.nodes.body[at(p.node)] == none) state.nodes.inertia[at(p.node)] *= heavier;
    std::vector<std::uint8_t>& held = holds_[p.contact].held;
    if (held.empty()) held.assign(model.nodes.size(), 0);
    held[at(p.node)] = 1;
    state.nodes.needed[at(p.node)] = 1;
    p.foot.each([&](std::size_t, std::size_t n) { state.nodes.needed[n] = 1; });
    memory_.push_back({p.arm, p.normal, {}, 0, 0, 0, 0, 0});
    springs_.push_back({std::move(p), 0, 0, contact.law == ContactLaw::tiebreak, turns});
  }
  if (empty()) return;
  StiffnessBound forces(state), moments(state);
  for (const Spring& t : springs_) {
    forces.collect(t.point, false);
    if (t.rotations) moments.collect(t.point, true);
  }
  for (Spring& t : springs_) {
    const double sum = forces.sum(t.point, false), turning = t.rotations ? moments.sum(t.point, true) : 0.0;
    t.stiffness = sum > 0 ? share_of_springs / sum : 0;
    t.turning_stiffness = turning > 0 ? share_of_turning / turning : 0;
  }
  actions_.resize(springs_.size());
  state.registry.add({"ties.springs", "mixed", "contact.apply, contact.turn"}, memory_);
  state.registry.add({"ties.tracked_work", "energy", "contact.account"}, tracked_);
  state.registry.add({"ties.reference_work", "energy", "contact.account"}, reference_);
  state.registry.add({"ties.counted_work", "energy", "contact.account"}, counted_);
  state.registry.add_value({"ties.step", "time", "contact.apply"}, step_);
  for (std::size_t c = 0; c < holds_.size(); ++c) {
    if (holds_[c].held.empty()) continue;
    state.registry.keep({"ties." + std::to_string(c) + ".held", "1", "contact.apply"}, holds_[c].held);
    state.registry.keep_value({"ties." + std::to_string(c) + ".releases", "1", "contact.apply"}, holds_[c].releases);
  }
}

/// The stiffness falls with the square of the grown step, k' = k (dt/dt')^2: forces stay, stretches grow. A tie that is damaged keeps its
/// opening, which is its damage.
void TieSprings::follow_step(const State& state) {
  const double dt = state.clock.dt_previous;
  if (dt <= step_ * grown) return;
  const double longer = step_ > 0 ? (dt / step_) * (dt / step_) : 1.0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    Memory& m = memory_[i];
    if (m.damaged || m.released) continue;
    const TiedPoint& p = springs_[i].point;
    const Vec3 delta = state.nodes.x[at(p.node)] - p.foot.mean(state.nodes.x) - m.arm;
    m.arm -= delta * (longer - 1);
    m.turned *= longer;
  }
  step_ = dt;
}

/// Share of the spring's force that tension and shear still have: 1 until onset. `normal` = <delta_n>, `shear` = |delta_s|.
double TieSprings::remaining(const Contact& contact, double area, double stiffness, Memory& m, double normal, double shear) {
  const Tie& tie = contact.tie;
  const double opening = std::hypot(normal, shear);
  if (!m.damaged) {
    const double per = tie.option == 0 ? 1.0 : area;
    double sum = 0;
    if (tie.normal_limit > 0) sum += std::pow(stiffness * normal / (tie.normal_limit * per), tie.normal_exponent);
    if (tie.shear_limit > 0) sum += std::pow(stiffness * shear / (tie.shear_limit * per), tie.shear_exponent);
    if (sum < 1) return 1;
    m.damaged = 1;
    m.onset_opening = opening / std::sqrt(sum);  // within the step; the exponents of stresses are 2
    m.onset_force = stiffness * m.onset_opening;
  }
  m.opening = std::max(m.opening, opening);
  if (tie.option != 6 || m.opening >= tie.critical_distance || m.onset_opening >= tie.critical_distance) {
    m.released = 1;
    return 0;
  }
  return m.onset_force * (tie.critical_distance - m.opening) / ((tie.critical_distance - m.onset_opening) * m.opening * stiffness);
}

/// Forces of spring i at t_n.
void TieSprings::act(const Model& model, const State& state, std::size_t i) {
  const NodeState& nodes = state.nodes;
  const Spring& t = springs_[i];
  const TiedPoint& p = t.point;
  const Contact& contact = model.contacts[p.contact];
  Memory& m = memory_[i];
  actions_[i] = {};
  if (m.released || step_ == 0 || state.clock.time >= contact.death) return;
  const std::size_t s = at(p.node);
  const double k = t.stiffness / (step_ * step_);
  const Vec3 u = nodes.x[s] - p.foot.mean(nodes.x), delta = u - m.arm;
  const double normal = dot(delta, m.normal);
  const Vec3 shear = delta - m.normal * normal;
  const double left = t.breaks ? remaining(contact, p.area, k, m, std::max(normal, 0.0), norm(shear)) : 1.0;
  actions_[i].fails = m.released != 0;
  if (m.released) return;
  Action& a = actions_[i];
  a.holds = true;
  const Vec3 v_foot = p.foot.mean(nodes.v), w = SegmentFrame(p.foot, nodes, 0).angular_velocity(nodes);
  a.force = -((shear + m.normal * std::max(normal, 0.0)) * (k * left) + m.normal * (k * std::min(normal, 0.0)));
  if (contact.damping > 0)
    a.force -= (nodes.v[s] - v_foot - cross(w, u)) * (2 * contact.damping * k * left * step_ / std::sqrt(share_of_springs));
  a.moment = m.turned * (-t.turning_stiffness / (step_ * step_));
  a.at_foot = cross(u, a.force) + a.moment;
  a.power_node = dot(a.force, nodes.v[s]) + dot(a.moment, nodes.omega[s]);
  a.power_segment = -dot(a.force, v_foot) - dot(a.at_foot, w);
}

void TieSprings::let_go(std::size_t i) {
  const TiedPoint& p = springs_[i].point;
  memory_[i].released = 1;
  holds_[p.contact].held[at(p.node)] = 0;
  ++holds_[p.contact].releases;
}

void TieSprings::release(const std::function<bool(const TiedPoint&)>& ends) {
  for (std::size_t i = 0; i < springs_.size(); ++i)
    if (!memory_[i].released && ends(springs_[i].point)) let_go(i);
}

void TieSprings::apply(const Model& model, State& state) {
  follow_step(state);
  const auto count = static_cast<std::ptrdiff_t>(springs_.size());
#pragma omp parallel for schedule(static) if (count > parallel_threshold)
  for (std::ptrdiff_t i = 0; i < count; ++i) act(model, state, static_cast<std::size_t>(i));
  NodeState& nodes = state.nodes;
  std::fill(power_.begin(), power_.end(), Power{});
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Action& a = actions_[i];
    const TiedPoint& p = springs_[i].point;
    if (a.fails) {
      let_go(i);
      spdlog::info("contact {}: node {} lets go at t = {:.6g}", model.contacts[p.contact].id, model.nodes.id[at(p.node)], state.clock.time);
    }
    nodes.force[at(p.node)] += a.force;
    nodes.moment[at(p.node)] += a.moment;
    SegmentFrame(p.foot, nodes, 0).share(-a.force, -a.at_foot, [&](std::size_t n, const Vec3& f, const Vec3& moment) {
      nodes.force[n] += f;
      nodes.moment[n] += moment;
    });
    power_[p.contact].node += a.power_node;
    power_[p.contact].segment += a.power_segment;
  }
  for (std::size_t c = 0; c < power_.size(); ++c) {
    tracked_[c].before(power_[c].node);
    reference_[c].before(power_[c].segment);
  }
}

void TieSprings::account(State& state) {
  const NodeState& nodes = state.nodes;
  std::fill(power_.begin(), power_.end(), Power{});
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Action& a = actions_[i];
    const TiedPoint& p = springs_[i].point;
    const std::size_t s = at(p.node);
    power_[p.contact].node += dot(a.force, nodes.v[s]) + dot(a.moment, nodes.omega[s]);
    power_[p.contact].segment -= dot(a.force, p.foot.mean(nodes.v)) + dot(a.at_foot, SegmentFrame(p.foot, nodes, 0).angular_velocity(nodes));
  }
  for (std::size_t c = 0; c < power_.size(); ++c) {
    if (holds_[c].held.empty()) continue;
    const Power work{tracked_[c].after(power_[c].node, state.clock), reference_[c].after(power_[c].segment, state.clock)};
    state.contacts[c].tracked_energy -= work.node - counted_[c].node;
    state.contacts[c].reference_energy -= work.segment - counted_[c].segment;
    counted_[c] = work;
  }
}

void TieSprings::report(State& state) const {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Action& a = actions_[i];
    if (!a.holds) continue;
    ContactReport& report = state.contacts[springs_[i].point.contact];
    report.force += a.force;
    report.moment += cross(state.nodes.x[at(springs_[i].point.node)], a.force) + a.moment;
    add_nodal_forces(springs_[i].point, state.nodes, a.force, a.at_foot, report);
    ++report.touching;
  }
}

void TieSprings::turn(const State& state) {
  const NodeState& nodes = state.nodes;
  const double dt = state.clock.dt;
  const auto count = static_cast<std::ptrdiff_t>(springs_.size());
#pragma omp parallel for schedule(static) if (count > parallel_threshold)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Spring& t = springs_[static_cast<std::size_t>(i)];
    Memory& m = memory_[static_cast<std::size_t>(i)];
    if (m.released) continue;
    const Vec3 w = SegmentFrame(t.point.foot, nodes, -0.5 * dt).angular_velocity(nodes);
    const Mat3 rotation = to_matrix(hughes_winget(w * dt));
    m.arm = rotation * m.arm;
    m.normal = rotation * m.normal;
    if (t.rotations) m.turned = rotation * m.turned + (nodes.omega[at(t.point.node)] - w) * dt;
  }
}

void TieSprings::restart() {
  for (auto* meters : {&tracked_, &reference_}) std::fill(meters->begin(), meters->end(), WorkMeter{});
  std::fill(counted_.begin(), counted_.end(), Power{});
}

}  // namespace kardan

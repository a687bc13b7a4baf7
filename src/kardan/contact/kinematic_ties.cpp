#include "kardan/contact/kinematic_ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "kardan/base/rotation.hpp"

namespace kardan {

namespace {

constexpr std::size_t listed = 10;  ///< nodes named in a message

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// What else moves or holds nodes.
class OtherHolders {
 public:
  explicit OtherHolders(const Model& model) : dofs_(model.nodes.constrained), moved_(model.nodes.size(), 0) {
    for (const SinglePointConstraint& spc : model.constraints)
      for (const NodeIndex n : spc.nodes) dofs_[at(n)] |= spc.frame == none ? spc.dofs : static_cast<std::uint8_t>(spc.dofs | local_axes);
    const auto mark = [&](const std::vector<NodeIndex>& nodes) {
      for (const NodeIndex n : nodes) moved_[at(n)] = 1;
    };
    for (const PrescribedMotion& motion : model.prescribed_motions) mark(motion.nodes);
    for (const CommonMotion& set : model.common_motions) mark(set.nodes);
    for (const RigidGroup& group : model.rigid_groups) mark(group.nodes);
    for (const Interpolation& tie : model.interpolations) {
      mark(tie.nodes);
      mark({tie.dependent});
    }
    for (const LinearEquation& equation : model.linear_equations)
      for (const LinearEquation::Term& term : equation.terms) mark({term.node});
  }

  /// A support of a tied node does no harm where all corners that carry it have the same: a plane of symmetry.
  bool clash(const TiedPoint& p) const {
    const std::uint8_t own = dofs_[at(p.node)];
    bool same = !(own & local_axes);
    p.foot.each([&](std::size_t i, std::size_t n) { same &= p.foot.weights[i] == 0 || (own & ~dofs_[n]) == 0; });
    return moved_[at(p.node)] != 0 || (own != 0 && !same);
  }

 private:
  static constexpr std::uint8_t local_axes = 1u << 7;
  std::vector<std::uint8_t> dofs_, moved_;
};

/// Names of nodes by contact, for one message each.
class NodeLists {
 public:
  void add(const TiedPoint& p) { nodes_[p.contact].push_back(p.node); }
  /// say(text, keyword) with "contact 7: 2 nodes `what`: 11, 12"
  template <class F>
  void each(const Model& model, const std::string& what, F&& say) const {
    for (const auto& [contact, nodes] : nodes_) {
      std::string text = fmt::format("contact {}: {} {} {}", model.contacts[contact].id, nodes.size(), nodes.size() == 1 ? "node" : "nodes", what);
      for (std::size_t i = 0; i < std::min(nodes.size(), listed); ++i) text += fmt::format("{} {}", i == 0 ? ":" : ",", model.nodes.id[at(nodes[i])]);
      say(text + (nodes.size() > listed ? " …" : ""), model.contacts[contact].keyword);
    }
  }

 private:
  std::map<std::size_t, std::vector<NodeIndex>> nodes_;
};

}  // namespace

KinematicTies::KinematicTies(const Model& model, const State& state, const std::vector<TiedPoint>& points, Diagnostics& diagnostics) {
  NodeLists twice, rigid, held;
  std::vector<std::uint8_t> tied(model.nodes.size(), 0);
  const OtherHolders others(model);
  for (const TiedPoint& p : points) {
    bool of_body = state.nodes.body[at(p.node)] != none;
    p.foot.each([&](std::size_t, std::size_t n) { of_body |= state.nodes.body[n] != none; });
    if (of_body) rigid.add(p);
    else if (others.clash(p)) held.add(p);
    else if (tied[at(p.node)]) twice.add(p);
    else ties_.push_back({p, model.contacts[p.contact].tie.rotations, {}, {}, {}});
    tied[at(p.node)] = 1;
  }
  rigid.each(model, "to be tied without a spring belong to rigid bodies or lie on segments of them", [&](const std::string& text, const std::string& keyword) {
    diagnostics.error(text, "use the keyword with _OFFSET or _BEAM_OFFSET, which ties by springs, or make the nodes extra nodes of the body", keyword);
  });
  held.each(model, "to be tied are held by a support that their segments do not have, or moved by a prescribed motion or another constraint",
            [&](const std::string& text, const std::string& keyword) { diagnostics.error(text, "keep one of them, or tie by springs (_OFFSET)", keyword); });
  twice.each(model, "are tied by an earlier contact already and follow that", [&](const std::string& text, const std::string& keyword) {
    diagnostics.warning(text, "take them out of one of the contacts", keyword);
  });
  sort_chains(model, diagnostics);
}

/// Each tie behind those of the nodes of its segment.
void KinematicTies::sort_chains(const Model& model, Diagnostics& diagnostics) {
  std::vector<Index> tie_of(model.nodes.size(), none);
  for (std::size_t i = 0; i < ties_.size(); ++i) tie_of[at(ties_[i].point.node)] = static_cast<Index>(i);
  enum : std::uint8_t { fresh, open, done };
  std::vector<std::uint8_t> mark(ties_.size(), fresh);
  std::vector<Tie> sorted;
  NodeLists closed;
  const auto visit = [&](auto&& self, std::size_t i) -> void {
    mark[i] = open;
    ties_[i].point.foot.each([&](std::size_t, std::size_t n) {
      if (tie_of[n] == none) return;
      if (mark[at(tie_of[n])] == open) closed.add(ties_[i].point);
      else if (mark[at(tie_of[n])] == fresh) self(self, at(tie_of[n]));
    });
    mark[i] = done;
    sorted.push_back(ties_[i]);
  };
  for (std::size_t i = 0; i < ties_.size(); ++i)
    if (mark[i] == fresh) visit(visit, i);
  ties_ = std::move(sorted);
  closed.each(model, "are tied to segments whose nodes are tied, by way of others, to segments of theirs", [&](const std::string& text, const std::string& keyword) {
    diagnostics.error(text, "tie the surfaces in one direction only", keyword);
  });
}

void KinematicTies::take_masses(State& state) {
  for (Tie& t : ties_) {
    arms_.push_back(t.point.arm);
    if (t.point.arm == Vec3{} && !t.rotations) t.point.foot.spin = Spin::nodal;  // without moments, and the cheapest
  }
  loads_.resize(ties_.size());
  if (!empty()) {
    state.registry.add_list({"ties.arm", "length", "contact.place"}, arms_);
    state.registry.add_list({"ties.load", "mass, mass*length^2", "contact.pass_on_masses"}, loads_);
    state.registry.keep_list({"ties.points", "mixed", "contact.release"}, ties_);
    state.registry.add_value({"energy.eroded_kinetic", "energy", "contact.release"}, state.energy.eroded_kinetic);
  }
  pass_on_masses(state);
}

const std::vector<NodeIndex>& KinematicTies::pass_on_masses(State& state) {
  NodeState& nodes = state.nodes;
  changed_.clear();
  for (std::size_t i = ties_.size(); i-- > 0;) {
    const Tie& t = ties_[i];
    const std::size_t s = at(t.point.node);
    const double mass = nodes.mass[s], own = t.rotations ? nodes.inertia[s] : 0.0;
    if (mass == 0 && own == 0) continue;
    const double inertia = t.point.foot.spin == Spin::fitted ? 0.0 : own + mass * dot(arms_[i], arms_[i]);
    loads_[i].mass += mass;
    loads_[i].inertia += own;
    loads_[i].turning += inertia;
    t.point.foot.each([&](std::size_t k, std::size_t n) {
      const double w = t.point.foot.weights[k], m = nodes.mass[n] + w * mass, j = nodes.inertia[n] + w * inertia;
      if (m > 0) nodes.v[n] = (nodes.v[n] * nodes.mass[n] + nodes.v[s] * (w * mass)) / m;
      if (j > 0) nodes.omega[n] = (nodes.omega[n] * nodes.inertia[n] + nodes.omega[s] * (w * inertia)) / j;
      nodes.mass[n] = m;
      nodes.inertia[n] = j;
      if (w != 0) changed_.push_back(static_cast<NodeIndex>(n));
    });
    nodes.mass[s] = 0;
    if (t.rotations) nodes.inertia[s] = 0;
  }
  return changed_;
}

/// Takes part of what they got of tie `tie` from the corners, or from those that these have passed it on to. @return their kinetic energy of it
double KinematicTies::take_back(NodeState& nodes, std::size_t tie, double mass, double turning) {
  const SegmentPoint foot = ties_[tie].point.foot;
  double energy = 0;
  foot.each([&](std::size_t k, std::size_t n) {
    const double m = foot.weights[k] * mass, j = foot.weights[k] * turning;
    if (m == 0 && j == 0) return;
    const Index next = tie_of_[n];
    const bool turns_on = next != none && ties_[at(next)].rotations;
    if (next != none) {
      const std::size_t chain = at(next);
      const double own = turns_on ? j : 0.0;
      const double passed = ties_[chain].point.foot.spin == Spin::fitted ? 0.0 : own + m * dot(arms_[chain], arms_[chain]);
      loads_[chain].mass -= m;
      loads_[chain].inertia -= own;
      loads_[chain].turning -= passed;
      energy += take_back(nodes, chain, m, passed);
    } else {
      nodes.mass[n] -= m;
      energy += 0.5 * m * dot(nodes.v[n], nodes.v[n]);
    }
    if (turns_on) return;
    nodes.inertia[n] -= j;
    energy += 0.5 * j * dot(nodes.omega[n], nodes.omega[n]);
  });
  return energy;
}

bool KinematicTies::release(State& state, const std::function<bool(const TiedPoint&)>& ends) {
  std::vector<std::uint8_t> gone(ties_.size(), 0);
  for (std::size_t i = 0; i < ties_.size(); ++i) gone[i] = ends(ties_[i].point);
  if (std::find(gone.begin(), gone.end(), 1) == gone.end()) return false;
  NodeState& nodes = state.nodes;
  tie_of_.assign(nodes.x.size(), none);
  for (std::size_t i = 0; i < ties_.size(); ++i) tie_of_[at(ties_[i].point.node)] = static_cast<Index>(i);
  for (std::size_t i = ties_.size(); i-- > 0;) {  // ends of chains first
    if (!gone[i]) continue;
    const std::size_t s = at(ties_[i].point.node);
    const Load load = loads_[i];
    double lost = take_back(nodes, i, load.mass, load.turning);
    nodes.mass[s] = load.mass;
    nodes.v[s] = ties_[i].point.foot.mean(nodes.v);
    if (ties_[i].rotations) nodes.inertia[s] = load.inertia;
    lost -= 0.5 * (load.mass * dot(nodes.v[s], nodes.v[s]) + load.inertia * dot(nodes.omega[s], nodes.omega[s]));
    state.energy.eroded_kinetic += lost;
    tie_of_[s] = none;
  }
  const auto keep = [&gone](auto& list) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!gone[i]) list[kept++] = list[i];
    list.resize(kept);
  };
  keep(ties_);
  keep(arms_);
  keep(loads_);
  return true;
}

double KinematicTies::transfer(State& state) {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick();
  double square = 0;
  for (std::size_t i = ties_.size(); i-- > 0;) {
    Tie& t = ties_[i];
    const std::size_t s = at(t.point.node);
    t.v_before = nodes.v[s];
    t.omega_before = nodes.omega[s];
    if (!t.rotations && nodes.inertia[s] > 0) nodes.omega[s] += nodes.moment[s] * (kick / nodes.inertia[s]);
    const Vec3 moment = cross(arms_[i], nodes.force[s]) + (t.rotations ? nodes.moment[s] : Vec3{});
    SegmentFrame(t.point.foot, nodes, 0).share(nodes.force[s], moment, [&](std::size_t n, const Vec3& f, const Vec3& m) {
      if (nodes.mass[n] > 0) nodes.v[n] += f * (kick / nodes.mass[n]);
      else nodes.force[n] += f;  // tied itself: passed on when its turn comes
      if (nodes.mass[n] > 0 && nodes.inertia[n] > 0) nodes.omega[n] += m * (kick / nodes.inertia[n]);
      else nodes.moment[n] += m;
      square = std::max(square, dot(nodes.v[n], nodes.v[n]));
    });
  }
  return std::sqrt(square);
}

void KinematicTies::follow(State& state) {
  NodeState& nodes = state.nodes;
  const double half = 0.5 * state.clock.dt;
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    Tie& t = ties_[i];
    const std::size_t s = at(t.point.node);
    nodes.v[s] = t.point.foot.mean(nodes.v);
    if (!t.rotations && arms_[i] == Vec3{}) continue;
    t.angular_velocity = SegmentFrame(t.point.foot, nodes, half).angular_velocity(nodes);
    // The arm in the middle of Hughes and Winget's rotation: (arm at t_{n+1} - arm at t_n)/dt = W x middle.
    const Vec3 turn = t.angular_velocity * half, &d = arms_[i];
    nodes.v[s] += cross(t.angular_velocity, (d + cross(turn, d) + turn * dot(turn, d)) / (1 + dot(turn, turn)));
    if (t.rotations) nodes.omega[s] = t.angular_velocity;
  }
}

void KinematicTies::settle(State& state) const {
  NodeState& nodes = state.nodes;
  const double kick = state.clock.kick(), share = state.clock.share_before();
  for (const Tie& t : ties_) {
    const std::size_t s = at(t.point.node);
    const Vec3 change = nodes.v[s] - t.v_before, turn = nodes.omega[s] - t.omega_before;
    nodes.v_now[s] = t.v_before + change * share;
    nodes.a[s] = change / kick;
    nodes.omega_now[s] = t.omega_before + turn * share;
    nodes.alpha[s] = turn / kick;
  }
}

void KinematicTies::place(State& state) {
  NodeState& nodes = state.nodes;
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    const Tie& t = ties_[i];
    if (arms_[i] != Vec3{}) arms_[i] = to_matrix(hughes_winget(t.angular_velocity * state.clock.dt)) * arms_[i];
    nodes.x[at(t.point.node)] = t.point.foot.mean(nodes.x) + arms_[i];
  }
}

void KinematicTies::account(State& state) const {
  for (const Tie& t : ties_) {
    const std::size_t s = at(t.point.node);
    const Vec3& omega = state.nodes.omega_now[s];
    if (!t.rotations) state.energy.kinetic += 0.5 * state.nodes.inertia[s] * dot(omega, omega);
  }
}

void KinematicTies::report(State& state) const {
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    const Tie& t = ties_[i];
    ContactReport& contact = state.contacts[t.point.contact];
    const Vec3& f = state.nodes.force[at(t.point.node)];
    contact.force -= f;
    contact.moment -= cross(state.nodes.x[at(t.point.node)], f);
    add_nodal_forces(t.point, state.nodes, -f, -cross(arms_[i], f) - (t.rotations ? state.nodes.moment[at(t.point.node)] : Vec3{}), contact);
    ++contact.touching;
  }
}

}  // namespace kardan

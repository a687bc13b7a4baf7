// Tied contacts made by hand, and what their tests watch.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "contact/meshes.hpp"
#include "kardan/contact/tie_search.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::test {

inline const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};
inline const ElasticMaterial cork{7800, 210e9, 0.0, 0, 0};  ///< without lateral strain: waves in bars are one-dimensional

struct Ties : Meshes {
  Contact& tie(ContactSide tracked, std::vector<PartIndex> reference, Tie::Holding holding) {
    Contact c;
    c.id = static_cast<UserId>(model.contacts.size()) + 1;
    c.keyword = "*CONTACT_TIED_…";
    c.law = ContactLaw::tied;
    c.tracked = std::move(tracked);
    c.reference = side(std::move(reference));
    c.tie.holding = holding;
    return model.contacts.emplace_back(c);
  }
  static ContactSide side_of_nodes(std::vector<NodeIndex> nodes) {
    ContactSide s;
    s.kind = ContactSide::Kind::nodes;
    s.nodes = std::move(nodes);
    return s;
  }
  /// Nodes first <= n < end have the velocity v(x).
  void start(NodeIndex first, NodeIndex end, const std::function<Vec3(const Vec3&)>& v) {
    for (NodeIndex n = first; n < end; ++n) throw_from(n, n + 1, v(model.nodes.x[static_cast<std::size_t>(n)]));
  }
  /// All nodes turn about `axis` through `center`, and fly on.
  void spin(const Vec3& center, const Vec3& axis, const Vec3& flight) {
    start(0, node_count(), [&](const Vec3& x) { return flight + cross(axis, x - center); });
  }
  void drive(std::vector<NodeIndex> nodes, int dof, double velocity) {
    PrescribedMotion m;
    m.nodes = std::move(nodes);
    m.dof = dof;
    m.curve = curve({0, 1}, {velocity, velocity});
    model.prescribed_motions.push_back(m);
  }
  static std::vector<NodeIndex> range(NodeIndex first, NodeIndex end) {
    std::vector<NodeIndex> nodes;
    for (NodeIndex n = first; n < end; ++n) nodes.push_back(n);
    return nodes;
  }
};

/// Calls a function every cycle.
struct Each : Observer {
  explicit Each(std::function<void(const State&)> function) : f(std::move(function)) {}
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& state, const StepView&) override { f(state); }
  std::function<void(const State&)> f;
};

/// Momentum and angular momentum about the origin, of free nodes and bodies.
struct Momenta {
  Vec3 linear, angular;
  explicit Momenta(const State& s) {
    for (std::size_t n = 0; n < s.nodes.x.size(); ++n) {
      if (s.nodes.body[n] != none) continue;
      linear += s.nodes.v[n] * s.nodes.mass[n];
      angular += cross(s.nodes.x[n], s.nodes.v[n]) * s.nodes.mass[n] + s.nodes.omega[n] * s.nodes.inertia[n];
    }
    for (std::size_t b = 0; b < s.bodies.info.size(); ++b) {
      const BodyMotion& m = s.bodies.motion[b];
      linear += m.velocity * s.bodies.info[b].mass;
      angular += cross(m.center, m.velocity) * s.bodies.info[b].mass + m.angular_momentum;
    }
  }
};

/// Largest change of the momenta and of the total energy in a run, relative to their first values.
struct Balance {
  double linear = 0, angular = 0, energy = 0;
};
inline Balance balance_of(const Model& model, int threads = 1) {
  Diagnostics diagnostics;
  Solver solver(model, {.threads = threads}, diagnostics);
  Balance worst;
  std::vector<Momenta> first;
  Each each([&](const State& s) {
    const Momenta now(s);
    if (first.empty()) first.push_back(now);
    worst.linear = std::max(worst.linear, norm(now.linear - first[0].linear) / norm(first[0].linear));
    worst.angular = std::max(worst.angular, norm(now.angular - first[0].angular) / norm(first[0].angular));
    worst.energy = std::max(worst.energy, std::abs(s.energy.total() - s.energy.initial) / s.energy.initial);
  });
  solver.attach(each);
  solver.run();
  return worst;
}

}  // namespace kardan::test

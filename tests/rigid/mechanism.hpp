// A mechanism built by hand, and run with nothing but the rigid stage: for tests of the law of bodies and joints.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/rigid/rigid_system.hpp"
#include "kardan/state/state.hpp"

namespace kardan::test {

class Mechanism {
 public:
  /// A body with given mass properties (tensor about the centre, global axes) and velocities. @return its part index.
  PartIndex body(double mass, const Vec3& center, const Mat3& inertia, const Vec3& velocity = {},
                 const Vec3& omega = {}) {
    if (model.materials.empty()) {
      model.materials.push_back({1, "rigid", RigidMaterial{}});
      RigidMaterial ground;
      ground.cmo = 1;
      ground.con1 = ground.con2 = 7;
      model.materials.push_back({2, "ground", ground});
    }
    Part part;
    part.id = static_cast<UserId>(model.parts.size()) + 1;
    part.material = 0;
    GivenInertia g;
    g.center = center;
    g.mass = mass;
    g.inertia = inertia;
    g.velocity = velocity;
    g.angular_velocity = omega;
    part.inertia = g;
    model.parts.push_back(part);
    return static_cast<PartIndex>(model.parts.size()) - 1;
  }

  PartIndex ground(const Vec3& center = {}) {
    const PartIndex p = body(1.0, center, Mat3::identity());
    model.parts[static_cast<std::size_t>(p)].material = 1;
    return p;
  }

  NodeIndex node(PartIndex part, const Vec3& x) {
    const auto n = static_cast<NodeIndex>(model.nodes.id.size());
    model.nodes.id.push_back(n + 1);
    model.nodes.x.push_back(x);
    model.nodes.constrained.push_back(0);
    model.extra_nodes.push_back({part, {n}, 0});
    return n;
  }

  /// A joint whose points are given by coordinates, 1, 3, 5 on part a and 2, 4, 6 on part b.
  Joint& joint(JointKind kind, PartIndex a, PartIndex b, const std::vector<Vec3>& points) {
    Joint j;
    j.id = static_cast<UserId>(model.joints.size()) + 1;
    j.kind = kind;
    for (std::size_t i = 0; i < points.size(); ++i) j.nodes[i] = node(i % 2 == 0 ? a : b, points[i]);
    model.joints.push_back(j);
    return model.joints.back();
  }

  CurveIndex curve(std::vector<double> x, std::vector<double> y) {
    Curve c;
    c.id = static_cast<UserId>(model.curves.size()) + 1;
    c.x = std::move(x);
    c.y = std::move(y);
    model.curves.push_back(std::move(c));
    return static_cast<CurveIndex>(model.curves.size()) - 1;
  }

  Model model;
};

/// Runs a mechanism with a constant step; `load` may add to state.bodies.force and moment at t_n.
class Simulation {
 public:
  Simulation(const Model& the_model, double dt, JointHolding holding = JointHolding::exact) : model(the_model) {
    state.nodes.resize(model.nodes.size());
    state.nodes.x = model.nodes.x;
    system = std::make_unique<RigidSystem>(model, state, holding, diagnostics);
    if (!diagnostics.ok()) throw std::runtime_error(to_string(diagnostics.all().front()));
    system->set_initial_velocities(model, state, diagnostics);
    state.clock.dt = dt;
  }

  /// Kick at t_n: afterwards every report stands at t_n.
  void kick() {
    for (auto* v : {&state.bodies.force, &state.bodies.moment}) std::fill(v->begin(), v->end(), Vec3{});
    for (std::size_t b = 0; b < state.bodies.info.size(); ++b) state.bodies.force[b] = gravity * state.bodies.info[b].mass;
    if (load) load(state);
    system->kick(model, state);
  }
  void drift() {
    system->drift(model, state);
    ++state.clock.cycle;
    state.clock.dt_previous = state.clock.dt;
    state.clock.time = static_cast<double>(state.clock.cycle) * state.clock.dt;
  }
  /// Steps until t = time and kicks there.
  void to(double time) {
    const auto last = static_cast<std::int64_t>(std::llround(time / state.clock.dt));
    if (kicked_) { drift(); kicked_ = false; }
    while (state.clock.cycle < last) {
      kick();
      drift();
    }
    kick();
    kicked_ = true;
    state.energy.begin(model.parts.size());
    system->account_work(state);
    system->account(model, state);
    system->update_reports(model, state);
  }

  BodyIndex body(PartIndex p) const { return state.bodies.of_part[static_cast<std::size_t>(p)]; }
  const BodyMotion& motion(PartIndex p) const { return state.bodies.motion[static_cast<std::size_t>(body(p))]; }
  const BodyReport& report(PartIndex p) const { return state.bodies.report[static_cast<std::size_t>(body(p))]; }

  double kinetic_energy() const { return state.energy.kinetic; }
  Vec3 linear_momentum() const {
    Vec3 p;
    for (std::size_t b = 0; b < state.bodies.info.size(); ++b)
      p += state.bodies.motion[b].velocity * state.bodies.info[b].mass;
    return p;
  }
  Vec3 angular_momentum() const {
    Vec3 l;
    for (std::size_t b = 0; b < state.bodies.info.size(); ++b)
      l += state.bodies.motion[b].angular_momentum +
           cross(state.bodies.motion[b].center, state.bodies.motion[b].velocity * state.bodies.info[b].mass);
    return l;
  }

  const Model& model;
  State state;
  Diagnostics diagnostics;
  std::unique_ptr<RigidSystem> system;
  Vec3 gravity;
  std::function<void(State&)> load;

 private:
  bool kicked_ = false;
};

/// A tensor that is nobody's principal one: R diag(d) R^T for some rotation.
inline Mat3 skew_inertia(const Vec3& d) {
  const Mat3 r = to_matrix(normalized(Quat{0.8, 0.3, -0.4, 0.2}));
  return r * Mat3::diagonal(d) * transpose(r);
}

}  // namespace kardan::test

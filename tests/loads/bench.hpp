// A model of loose nodes and bodies, driven by a leapfrog of its own.
#pragma once

#include <algorithm>
#include <cmath>

#include "handmade_model.hpp"
#include "kardan/loads/load_system.hpp"

namespace kardan {

struct Bench : test::HandmadeModel {
  State state;
  Diagnostics diagnostics;

  void size_state(double mass = 2.0, double inertia = 0.5) {
    state.nodes.resize(model.nodes.size());
    state.nodes.x = model.nodes.x;
    state.nodes.mass.assign(model.nodes.size(), mass);
    state.nodes.inertia.assign(model.nodes.size(), inertia);
    state.bodies.of_part.assign(model.parts.size(), none);
  }
  BodyIndex body(double mass, const Vec3& inertia, const Vec3& center) {
    const auto b = static_cast<BodyIndex>(state.bodies.info.size());
    BodyInfo info;
    info.mass = mass;
    info.principal_inertia = inertia;
    state.bodies.info.push_back(info);
    BodyMotion motion;
    motion.center = center;
    state.bodies.motion.push_back(motion);
    state.bodies.force.emplace_back();
    state.bodies.moment.emplace_back();
    return b;
  }
  void clear_forces() {
    for (auto* f : {&state.nodes.force, &state.nodes.moment, &state.bodies.force, &state.bodies.moment}) {
      std::fill(f->begin(), f->end(), Vec3{});
    }
  }
  void step(LoadSystem& loads, double dt) {
    step(loads, dt, [](State&) {});
  }
  /// add_forces(state) puts other forces on the nodes.
  template <class F>
  void step(LoadSystem& loads, double dt, F&& add_forces) {
    state.clock.dt = dt;
    clear_forces();
    loads.apply(model, state);
    add_forces(state);
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      state.nodes.v[n] += state.nodes.force[n] * (state.clock.kick() / state.nodes.mass[n]);
      state.nodes.omega[n] += state.nodes.moment[n] * (state.clock.kick() / state.nodes.inertia[n]);
    }
    loads.damp(model, state);
    loads.constrain_velocities(model, state);
    loads.account(model, state);
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) state.nodes.x[n] += state.nodes.v[n] * dt;
    state.clock.time += dt;
    state.clock.dt_previous = dt;
    ++state.clock.cycle;
  }
  /// Of the translations.
  double kinetic_energy_after_kick() const {
    double energy = 0;
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      energy += 0.5 * state.nodes.mass[n] * dot(state.nodes.v[n], state.nodes.v[n]);
    }
    return energy;
  }
  Vec3 momentum() const {
    Vec3 sum;
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) sum += state.nodes.v[n] * state.nodes.mass[n];
    return sum;
  }
  /// About the origin.
  Vec3 angular_momentum() const {
    Vec3 sum;
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n)
      sum += cross(state.nodes.x[n], state.nodes.v[n]) * state.nodes.mass[n] + state.nodes.omega[n] * state.nodes.inertia[n];
    return sum;
  }
  /// Velocities without a pattern.
  void stir() {
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      const double s = static_cast<double>(n);
      state.nodes.v[n] = {std::sin(1 + 7 * s), std::cos(3 + s * s), std::sin(2 + 5 * s)};
      state.nodes.omega[n] = {std::cos(4 * s), std::sin(s * s), std::cos(1 + 3 * s)};
    }
  }
};

}  // namespace kardan

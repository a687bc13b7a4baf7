// Runs of models with contact, and what laws say of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/meshes.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::test {

inline Vec3 momentum(const State& s, NodeIndex first, NodeIndex end) {
  Vec3 p;
  for (NodeIndex n = first; n < end; ++n) p += s.nodes.v[n] * s.nodes.mass[n];
  return p;
}

/// Looks at every cycle: momenta, energies, forces of contact 0.
struct Watch : Observer {
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model& model, const State& state, const StepView&) override {
    Vec3 p, l;
    for (std::size_t n = 0; n < state.nodes.v.size(); ++n) {
      p += state.nodes.v_now[n] * state.nodes.mass[n];
      l += cross(state.nodes.x[n], state.nodes.v_now[n]) * state.nodes.mass[n] + state.nodes.omega_now[n] * state.nodes.inertia[n];
    }
    if (state.clock.cycle == 0) momentum = p, angular = l, energy = state.energy.total();
    scale = std::max(scale, [&] {
      double sum = 0;
      for (std::size_t n = 0; n < state.nodes.v.size(); ++n) sum += norm(state.nodes.v_now[n]) * state.nodes.mass[n];
      return sum;
    }());
    momentum_error = std::max(momentum_error, norm(p - momentum));
    angular_error = std::max(angular_error, norm(l - angular));
    energy_error = std::max(energy_error, std::abs(state.energy.total() - state.energy.initial - state.energy.external_work));
    for (const ContactReport& c : state.contacts) {
      largest_force = std::max(largest_force, norm(c.force));
      most_touches = std::max(most_touches, c.touching);
    }
    if (std::all_of(state.contacts.begin(), state.contacts.end(), [](const ContactReport& c) { return c.touching == 0; }))
      sliding_when_free = state.energy.sliding;
    if (each) each(model, state);
  }
  std::function<void(const Model&, const State&)> each;
  Vec3 momentum, angular;
  double energy = 0, scale = 0, momentum_error = 0, angular_error = 0, energy_error = 0, largest_force = 0;
  double sliding_when_free = 0;  ///< contact energy when nothing touched last
  std::int64_t most_touches = 0;
};

}  // namespace kardan::test

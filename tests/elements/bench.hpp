// A small model and a leapfrog of its own, for tests of elements.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "handmade_model.hpp"
#include "kardan/elements/element_system.hpp"

namespace kardan::test {

struct Bench : HandmadeModel {
  State state;
  Diagnostics diagnostics;
  std::unique_ptr<ElementSystem> elements;

  PartIndex part(Section section, Material material) { return HandmadeModel::part(std::move(section), std::move(material), 100); }
  PartIndex spring_part(const SpringMaterial& law, const DiscreteSection& discrete = {}) {
    Section section;
    section.kind = ElementKind::discrete;
    section.discrete = discrete;
    Material material;
    material.law = law;
    return part(section, material);
  }
  PartIndex shell_part(double thickness, double density, double e, double nu, int nip = 2, double shrf = 1.0) {
    Section section;
    section.kind = ElementKind::shell;
    section.shell.thickness = {thickness, thickness, thickness, thickness};
    section.shell.nip = nip;
    section.shell.shrf = shrf;
    Material material;
    material.law = ElasticMaterial{density, e, nu, 0, 0};
    return part(section, material);
  }
  PartIndex solid_part(double density, double e, double nu) {
    Section section;
    section.kind = ElementKind::solid;
    Material material;
    material.law = ElasticMaterial{density, e, nu, 0, 0};
    return part(section, material);
  }
  void spring(PartIndex p, NodeIndex a, NodeIndex b, Index orientation = none, double scale = 1, double offset = 0) {
    auto& d = model.discretes;
    d.id.push_back(500 + static_cast<UserId>(d.id.size()));
    d.part.push_back(p);
    d.nodes.push_back({a, b});
    d.orientation.push_back(orientation);
    d.scale.push_back(scale);
    d.print.push_back(0);
    d.offset.push_back(offset);
  }
  void shell(PartIndex p, std::array<NodeIndex, 4> nodes) {
    model.shells.id.push_back(1000 + static_cast<UserId>(model.shells.id.size()));
    model.shells.part.push_back(p);
    model.shells.nodes.push_back(nodes);
  }
  void solid(PartIndex p, std::array<NodeIndex, 8> nodes) {
    model.solids.id.push_back(2000 + static_cast<UserId>(model.solids.id.size()));
    model.solids.part.push_back(p);
    model.solids.nodes.push_back(nodes);
  }
  void mass(NodeIndex n, double m, double inertia = 0) {
    PointInertia p;
    p.node = n;
    p.mass = m;
    p.inertia = Mat3::identity() * inertia;
    model.inertias.push_back(p);
  }

  void start() {
    state.nodes.resize(model.nodes.size());
    state.nodes.x = model.nodes.x;
    state.bodies.of_part.assign(model.parts.size(), none);
    state.registry.add({"nodes.x", "length", "nodes.drift"}, state.nodes.x);
    state.registry.add({"nodes.v", "length/time", "nodes.kick"}, state.nodes.v);
    elements = std::make_unique<ElementSystem>(model, state, diagnostics);
  }
  void forces() {
    std::fill(state.nodes.force.begin(), state.nodes.force.end(), Vec3{});
    std::fill(state.nodes.moment.begin(), state.nodes.moment.end(), Vec3{});
    elements->internal_forces(model, state);
    elements->add_forces(state, 0, static_cast<NodeIndex>(model.nodes.size()));
  }
  /// Energies and results of elements at t_n.
  void look() {
    elements->account(model, state);
    elements->report(model, state);
  }
  /// One cycle; `hold` may change the kicked velocities, `load` the forces.
  template <class Load, class Hold>
  void step(double dt, Load load, Hold hold) {
    state.clock.dt = dt;
    forces();
    load();
    const double kick = state.clock.kick();
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      if (state.nodes.mass[n] > 0) state.nodes.v[n] += state.nodes.force[n] * (kick / state.nodes.mass[n]);
      if (state.nodes.inertia[n] > 0) state.nodes.omega[n] += state.nodes.moment[n] * (kick / state.nodes.inertia[n]);
    }
    hold();
    elements->account(model, state);
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) state.nodes.x[n] += state.nodes.v[n] * dt;
    state.clock.time += dt;
    state.clock.dt_previous = dt;
    ++state.clock.cycle;
  }
  void step(double dt) {
    step(dt, [] {}, [] {});
  }
};

/// nx x ny quadrilaterals over [0, lx] x [0, ly], moved by `warp`; every third split into triangles where `triangles`.
template <class Warp>
void mesh(Bench& b, PartIndex p, int nx, int ny, double lx, double ly, Warp warp, bool triangles = false) {
  const auto base = static_cast<NodeIndex>(b.model.nodes.size());
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) b.node(warp(Vec3{lx * i / nx, ly * j / ny, 0}));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const NodeIndex n = base + j * (nx + 1) + i, m = n + nx + 1;
      if (triangles && (i + j) % 3 == 0) {
        b.shell(p, {n, n + 1, m + 1, m + 1});
        b.shell(p, {n, m + 1, m, m});
      } else {
        b.shell(p, {n, n + 1, m + 1, m});
      }
    }
  }
}

}  // namespace kardan::test

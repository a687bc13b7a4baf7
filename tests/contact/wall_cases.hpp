// Free point masses before a rigid wall: what the laws of walls are tested with.
#pragma once

#include <algorithm>
#include <cmath>

#include "handmade_model.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::test {

struct Cloud : HandmadeModel {
  RigidWall wall;

  Cloud() {
    wall.id = 7;
    wall.normal = {0, 0, 1};
  }
  NodeIndex point(const Vec3& x, const Vec3& velocity, double mass = 1) {
    const NodeIndex n = node(x);
    model.masses.push_back({static_cast<UserId>(model.masses.size()) + 1, n, mass, none});
    InitialVelocity initial;
    initial.nodes.push_back(n);
    initial.velocity = velocity;
    model.initial_velocities.push_back(initial);
    wall.nodes.push_back(n);
    return n;
  }
  /// Constant acceleration -`a` along an axis (as *LOAD_BODY_X … has it).
  void gravity(int axis, double a) {
    BodyLoad load;
    load.axis = axis;
    load.curve = curve({0, 1e3}, {a, a});
    model.body_loads.push_back(load);
  }
};

/// Runs a cloud with a constant step and looks at every cycle.
struct WallRun : Observer {
  WallRun(Cloud& cloud, double end, double dt, int threads = 1) {
    cloud.model.rigid_walls.assign(1, cloud.wall);
    cloud.model.control.termination.end_time = end;
    Solver solver(cloud.model, {.dt = dt, .threads = threads}, diagnostics);
    solver.attach(*this);
    reason = solver.run();
    x = solver.state().nodes.x;
    v = solver.state().nodes.v_now;
    wall = solver.state().walls[0];
    stonewall = solver.state().energy.stonewall;
    external_work = solver.state().energy.external_work;
    hash = solver.state().registry.hash();
  }
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model&, const State& s, const StepView&) override {
    largest_energy = std::max({largest_energy, std::abs(s.energy.total()), std::abs(s.energy.external_work)});
    worst_energy = std::max(worst_energy, std::abs(s.energy.total() - s.energy.initial - s.energy.external_work));
    largest_force = std::max(largest_force, s.walls[0].normal_force);
  }
  /// Balance of energy, in parts of the largest energy seen.
  double energy_error() const { return worst_energy / largest_energy; }

  Diagnostics diagnostics;
  StopReason reason = StopReason::running;
  std::vector<Vec3> x, v;  ///< at the end
  WallReport wall;
  double worst_energy = 0, largest_energy = 0, largest_force = 0, stonewall = 0, external_work = 0;
  std::uint64_t hash = 0;
};

}  // namespace kardan::test

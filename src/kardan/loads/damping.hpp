// *DAMPING_GLOBAL, *DAMPING_PART_MASS(_SET), *DAMPING_RELATIVE: forces proportional to mass and velocity.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"
#include "kardan/state/work_meter.hpp"

namespace kardan {

class Damping {
 public:
  /// Finds the nodes and bodies that each damping acts on.
  Damping(const Model& model, State& state, Diagnostics& diagnostics);

  /// Remembers the velocities before the kick.
  void before_kick(const State& state);
  /// After the nodes' kick and before that of the bodies, whose resultants must be complete: takes the impulses of damping from the
  /// velocities of nodes, and adds the forces on bodies.
  void apply(const Model& model, State& state);
  /// After the kick: what was dissipated up to t_n into state.energy.system_damping.
  void account(State& state);
  /// The work begins anew.
  void restart() { meter_ = {}; }

 private:
  struct DampedNode {
    NodeIndex node = none;
    double share = 1;     ///< of the node's mass: its elements in damped parts / all of its elements
    Vec3 v_before, omega_before;
    Vec3 force, moment;   ///< of the last apply()
  };
  struct DampedBody {
    BodyIndex body = none;
    Vec3 force, moment;
  };
  struct Group {
    std::vector<DampedNode> nodes;
    std::vector<DampedBody> bodies;
  };

  void damp_nodes(State& state, Group& group, const Vec3& translation, const Vec3& rotation) const;
  void damp_bodies(State& state, Group& group, const Vec3& translation, const Vec3& rotation) const;
  void damp_relative(State& state, Group& group, double rate) const;
  double power_on_bodies(const State& state) const;

  std::vector<Group> groups_;  ///< by Model::dampings
  WorkMeter meter_;
};

}  // namespace kardan

// *LOAD_NODE_POINT/SET and *LOAD_RIGID_BODY.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class PointForces {
 public:
  /// Resolves the bodies of *LOAD_RIGID_BODY and marks the loaded nodes, and those that turn follower loads, as needed.
  PointForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Adds forces and moments at t_n; returns their power with the velocities before the kick.
  double apply(const Model& model, State& state);
  /// Power of the forces of the last apply() with the velocities that stand in the state now.
  double power(const State& state) const;

 private:
  struct Entry {
    Index load = none;         ///< into Model::point_loads
    NodeIndex node = none;     ///< or
    BodyIndex body = none;     ///< of the loaded node, or the loaded body itself
    bool moment = false;
  };
  std::vector<Entry> entries_;
  std::vector<Vec3> value_;    ///< force or moment of each load at t_n, global components
};

}  // namespace kardan

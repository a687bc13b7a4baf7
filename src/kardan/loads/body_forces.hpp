// *LOAD_BODY_X/Y/Z/RX/RY/RZ/VECTOR and _PARTS: base accelerations.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class BodyForces {
 public:
  BodyForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Adds the forces at t_n; returns their power with the velocities before the kick.
  double apply(const Model& model, State& state);
  /// Power of the forces of the last apply() with the velocities that stand in the state now.
  double power(const State& state) const;

 private:
  /// Loads that act on the same things.
  struct Group {
    std::vector<Index> loads;      ///< into Model::body_loads
    std::vector<NodeIndex> nodes;  ///< deformable nodes with mass
    std::vector<BodyIndex> bodies;
    Vec3 acceleration;             ///< of the base at t_n, sum of the translational loads
    struct Spin {
      Vec3 omega, center;
    };
    std::vector<Spin> spins;       ///< at t_n

    Vec3 force_per_mass(const Vec3& x) const;
  };
  std::vector<Group> groups_;
};

}  // namespace kardan

// *BOUNDARY_NON_REFLECTING: dashpots through which waves leave.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class NonReflecting {
 public:
  /// Takes density and wave speeds of each segment from the solid that it is a face of.
  NonReflecting(const Model& model, const State& state, Diagnostics& diagnostics);

  /// Remembers the velocities before the kick.
  void before_kick(const State& state);
  /// After the nodes' kick: takes the impulses of the dashpots from the velocities; returns their power with the velocities
  /// before the kick.
  double apply(State& state);
  /// Power of the forces of the last apply() with the velocities that stand in the state now.
  double power(const State& state) const;

 private:
  struct Face {
    std::array<std::size_t, 4> nodes{};        ///< into nodes_
    double normal_impedance = 0, shear_impedance = 0;  ///< rho c_p, rho c_s; 0 where the wave is reflected
  };
  std::vector<Face> faces_;
  std::vector<NodeIndex> nodes_;
  std::vector<Vec3> v_before_;  ///< by node
  std::vector<Mat3> damping_;   ///< by node
  std::vector<Vec3> force_;     ///< by node, of the last apply()
};

}  // namespace kardan

// *LOAD_SEGMENT(_SET) and *LOAD_SHELL_ELEMENT/_SET: pressure that follows its surface.
#pragma once

#include <array>
#include <cstdint>
#include <cstddef>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class PressureLoads {
 public:
  /// Marks the nodes of loaded segments as needed; refuses nodes that nothing carries.
  PressureLoads(const Model& model, State& state, Diagnostics& diagnostics);

  /// Adds the forces at t_n; returns their power with the velocities before the kick.
  double apply(const Model& model, State& state);
  /// Power of the forces of the last apply() with the velocities that stand in the state now.
  double power(const State& state) const;

 private:
  std::vector<NodeIndex> nodes_;                        ///< loaded nodes, each once
  std::vector<Vec3> force_;                             ///< by loaded node, at t_n
  std::vector<std::array<std::uint32_t, 4>> segments_;  ///< of all loads: places in nodes_
  std::vector<std::size_t> end_;                        ///< by load: of its segments
};

/// Integrals of N_a n dA over the bilinear surface through four points, a = 1 … 4: what a unit pressure along the normal of
/// 1, 2, 3, 4 (right-hand rule) puts on the nodes. Their sum is the vector area (x3 - x1) x (x4 - x2)/2; a third of it goes to
/// each node of a triangle, whose third node is repeated.
std::array<Vec3, 4> nodal_areas(const std::array<Vec3, 4>& x);

}  // namespace kardan

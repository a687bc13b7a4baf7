// Motion of the nodes that belong to no rigid body: the stage `nodes` of the step.
#pragma once

#include <cstddef>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class NodeMover {
 public:
  /// Sorts the nodes: free ones have mass and no body; nodes without mass and body stay where they are (orientation
  /// nodes, leftovers), unless a prescribed motion moves them. `state.nodes.mass` and `.body` must be final.
  NodeMover(const Model& model, State& state);

  /// Velocities of the free nodes to t_{n+1/2}: v += F/m kick, omega += M/I kick.
  /// @throws RunError naming a node whose velocity is no longer finite; all nodes then have their velocities of before.
  void kick(const Model& model, State& state);
  /// After the velocities were constrained: v_now, a, omega_now and alpha at t_n.
  void settle(State& state) const;
  /// Positions to t_{n+1}.
  void drift(State& state) const;
  /// Adds the kinetic energy of the free nodes at t_n to state.energy, in total and by part. Where parts share a node, its
  /// energy is divided by the number of elements of each part there. Summed in the order of the nodes.
  void account(State& state) const;

 private:
  void find_parts(const Model& model, const State& state);
  [[noreturn]] void not_finite(const Model& model, State& state);

  struct Share {
    PartIndex part;
    double fraction;
  };
  std::vector<NodeIndex> free_, unattached_;
  std::vector<Vec3> v_before_, omega_before_;  // by position in free_: velocities at t_{n-1/2}
  std::vector<std::size_t> share_begin_;       // by position in free_, into shares_
  std::vector<Share> shares_;
};

}  // namespace kardan

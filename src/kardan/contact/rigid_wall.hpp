// Rigid walls (*RIGIDWALL_PLANAR): a perfectly plastic impact by the constraint method.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, "Rigid walls": a node that would pass the wall loses the velocity that takes it there.
// With the plane (x - p).n = 0 and the distance g = (x_n - p).n of a node at t_n, its velocity v after the kick becomes
//   v.n <- max(v.n, -max(g, 0)/dt):
// it lands on the wall at t_{n+1} and stays until its forces pull it off (v.n > 0). A node that begins behind the wall is held where it
// is. The normal impulse is J = m (change of v.n) >= 0; friction takes from the tangential velocity v_t
//   min(|v_t|, mu J/m)  (Coulomb, 0 < mu < 1),  or all of it (mu = 1).
// The force of the impulse over the kick, J/kick, is the wall's reaction at t_n; minus its work is the stonewall energy.
//
// Nodes of rigid bodies are not held (LS-DYNA: RWPNAL = 0); rotations neither.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class RigidWalls {
 public:
  /// Sizes state.walls; warns of nodes behind their wall and of nodes of rigid bodies, which are not held. The bodies must stand in
  /// state.nodes.body, the lumped masses in state.nodes.mass.
  RigidWalls(const Model& model, State& state, Diagnostics& diagnostics);

  bool empty() const { return walls_.empty(); }
  /// Remembers the velocities of before the kick.
  void before_kick(const State& state);
  /// Right after the free nodes were kicked: holds them back, with reactions at t_n in state.walls.
  void hold(State& state);
  /// Stonewall energy up to t_n into state.energy.
  void account(State& state) const;

 private:
  struct Wall {
    RigidWall description;           ///< its nodes: the free ones with mass
    std::vector<Vec3> v_before;      ///< by node, of before the kick
  };
  /// What the wall does to the nodes of a chunk.
  struct Sum {
    Vec3 force;                      ///< on the nodes
    double power_before = 0, power_after = 0;
  };
  Sum hold_chunk(const Wall& wall, std::size_t begin, std::size_t end, State& state) const;

  std::vector<Wall> walls_;
  std::vector<double> dissipated_;      ///< by wall: in all kicks that are over
  std::vector<double> dissipated_now_;  ///< by wall: up to t_n
  std::vector<Sum> sums_;               ///< by chunk, work space
};

}  // namespace kardan

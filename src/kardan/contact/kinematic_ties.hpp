// Nodes that move with segments without a spring between (*CONTACT_TIED_… without suffix and _CONSTRAINED_OFFSET, *CONTACT_SPOTWELD).
//
// A tied node s has the velocity of the point of its segment (segment_point.hpp), v_s = sum w_i v_i + W x d, and where its rotations are tied
// too, omega_s = W; the arm d turns with W by Hughes and Winget's rotation (1980). Its mass and its forces go to the corners:
//   m_i += w_i m_s,     I_i += w_i (|d|^2 m_s + I_s) (shells, I_s where rotations are tied),     f_i, m_i from f_s, d x f_s [+ m_s] (share).
// Source: Hallquist, LS-DYNA Theory Manual, "Tied contact": the constraint method. The tied node has no mass of its own then, so that the
// momenta and the kinetic energy of the corners are those of the model: all three are conserved, and d'Alembert's principle is
// fulfilled with the powers of the forces. What lumping leaves out: the inertia of the arm in segments of solids.
//
// A tie that ends gives the node its mass and rotary inertia back, of the corners' lumped masses, which keep their velocities; the node leaves with
// sum w_i v_i (and W): momentum is kept, and the kinetic energy that the corners' different velocities and the arm had beyond that counts as
// eroded.
//
// Segments of tied nodes may have tied nodes: masses and forces are passed on from the ends of the chains, velocities from their beginnings.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/tie_search.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class KinematicTies {
 public:
  /// Of these points those that can be held: errors name nodes that belong to rigid bodies, that something else moves or holds, and
  /// chains that close; a node that two contacts tie follows the first. Bodies must stand in state.nodes.body.
  KinematicTies(const Model& model, const State& state, const std::vector<TiedPoint>& points, Diagnostics& diagnostics);

  bool empty() const { return ties_.empty(); }
  /// Gives masses and momenta of the tied nodes to the corners; registers the arms.
  void take_masses(State& state);
  /// Gives mass that was added to tied nodes to the corners, as above. @return corners whose mass has changed
  const std::vector<NodeIndex>& pass_on_masses(State& state);
  /// Ends those ties of which `ends` is true. @return whether there were any: the masses of free nodes have changed then, and which nodes are free
  bool release(State& state, const std::function<bool(const TiedPoint&)>& ends);
  /// After the kick of the free nodes, which leaves out nodes without mass: their forces become impulses of the corners.
  /// @return an upper bound of the corners' speeds now
  double transfer(State& state);
  /// After the velocities of the free nodes were constrained: those of the tied ones.
  void follow(State& state);
  /// In a cycle that is looked at: v_now, a, omega_now and alpha of the tied nodes.
  void settle(State& state) const;
  /// After the drift of the others: positions at t_{n+1}.
  void place(State& state);
  /// Kinetic energy of rotations that are not tied, into state.energy.
  void account(State& state) const;
  /// Forces on the tracked sides at t_n, into state.contacts; after transfer().
  void report(State& state) const;

 private:
  struct Tie {
    TiedPoint point;
    bool rotations = false;
    Vec3 angular_velocity;         ///< of the segment in the coming step
    Vec3 v_before, omega_before;   ///< of the node, before the kick
  };
  /// What the corners carry of a tied node.
  struct Load {
    double mass = 0, inertia = 0;  ///< the node's own; the inertia only where rotations are tied
    double turning = 0;            ///< what the rotary inertias of the corners got together
  };
  void sort_chains(const Model& model, Diagnostics& diagnostics);
  double take_back(NodeState& nodes, std::size_t tie, double mass, double turning);

  std::vector<Tie> ties_;          ///< a node behind the tied nodes of its segment
  std::vector<Vec3> arms_;         ///< by tie, at t_n
  std::vector<Load> loads_;        ///< by tie
  std::vector<Index> tie_of_;      ///< by node of the model, while ties are released
  std::vector<NodeIndex> changed_;
};

}  // namespace kardan

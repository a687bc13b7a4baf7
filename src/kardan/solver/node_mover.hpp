// Motion of the nodes that belong to no rigid body: the stage `nodes` of the step.
//
// Nodes are visited in chunks that fit a core's cache: a chunk's forces are summed, used and set back to zero before the next one's.
// In cycles that nobody looks at nothing else is written, because on large models the bytes are the cost.
#pragma once

#include <cstddef>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/parallel/shares.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ElementSystem;

class NodeMover {
 public:
  /// Sorts the nodes: free ones have mass and no body; nodes without mass and body stay where they are (orientation
  /// nodes, leftovers), unless a prescribed motion moves them. `state.nodes.mass` and `.body` must be final.
  NodeMover(const Model& model, State& state);
  /// Which nodes are free has changed, with their masses.
  void sort(const Model& model, const State& state);

  /// Adds the elements' forces to those of all nodes; then velocities of the free nodes to t_{n+1/2}: v += F/m kick,
  /// omega += M/I kick. In a cycle that is looked at the velocities of before are kept in v_now and omega_now for settle(), and
  /// forces and moments stay; otherwise those of the free nodes are zero afterwards, ready for the next cycle.
  /// @throws RunError naming a node whose velocity would no longer be finite; such nodes keep theirs of before.
  void kick(const Model& model, State& state, const ElementSystem& elements, bool looked_at);
  /// Takes over masses and rotary inertias of nodes that have changed.
  void take_masses(const State& state, const std::vector<NodeIndex>& nodes);
  /// What the next cycle reads; nodes are sorted anew after a restore.
  void register_state(const Model& model, State& state);
  /// In a cycle that is looked at, after the velocities were constrained: v_now, a, omega_now and alpha at t_n.
  void settle(State& state);
  /// After a cycle that broke: v_now and omega_now are the last velocities known, a and alpha zero.
  void settle_broken(State& state) const;
  /// Positions to t_{n+1}.
  void drift(State& state);
  /// Largest speed of a free node after the last kick() or drift(), whichever was later.
  double fastest() const { return fastest_; }
  /// After settle(): adds the kinetic energy and the momentum of the free nodes at t_n to state.energy, in total and by part. Where parts
  /// share a node, its own are divided by the number of elements of each part there. Summed in the order of the nodes.
  void account(State& state) const;

 private:
  /// Nodes of the model that are visited together, and the free ones among them.
  struct Chunk {
    NodeIndex begin = 0, end = 0;
    std::size_t first_free = 0, end_free = 0;
  };
  struct Share {
    PartIndex part;
    double fraction;
  };
  /// Shares of a free node (by position in free_) that several parts have a hand in.
  struct SharedNode {
    std::size_t free = 0, first_share = 0;
  };

  template <class F>
  void for_each_chunk(F&& f);
  template <class F>
  void find_fastest(F&& f);
  void find_parts(const Model& model, const State& state);
  double kick_chunk(const Chunk& chunk, State& state, bool looked_at) const;
  [[noreturn]] void not_finite(const Model& model, const State& state) const;

  std::vector<NodeIndex> free_, unattached_;                // ascending
  std::vector<double> inverse_mass_, inverse_inertia_;      // by position in free_; 0 where there is no inertia
  std::vector<Chunk> chunks_;
  Shares thread_shares_;                                    // of chunks_
  std::vector<double> chunk_fastest_;                       // squares of speeds
  double fastest_ = 0;
  std::vector<PartIndex> part_;                             // by position in free_; none: no part, or several
  std::vector<SharedNode> shared_;                          // ascending, and the end
  std::vector<Share> shares_;
};

}  // namespace kardan

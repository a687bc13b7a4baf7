// Mass scaling (DT2MS of *CONTROL_TIMESTEP).
//
// Source: Hallquist, LS-DYNA Keyword User's Manual Vol. I, *CONTROL_TIMESTEP. DT2MS < 0: elements whose stable step is below |DT2MS|
// get as much mass as makes it |DT2MS|; DT2MS > 0: so do all, and those above lose mass. The step goes with the square root of the
// mass: the factor is (|DT2MS|/step)^2. The run's step is TSSFAC |DT2MS|. It is done in every cycle, or in the first one only (MS1ST).
//
// The mass goes to the element's nodes in the shares of its own mass, with the rotary inertia of shells and beams; nodes of rigid bodies get
// none. Springs and discrete beams are not scaled.
// Mass that is added while its node moves comes with the node's velocity: its kinetic energy counts as external work.
#pragma once

#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class TileElements;

class MassScaling {
 public:
  /// Totals of state.added_mass, from the lumped masses.
  void start(const Model& model, State& state);
  bool active(const Model& model, const State& state) const;
  /// Scales the masses of the elements, whose steps are those at t_n.
  void scale(const Model& model, State& state, TileElements& elements);
  /// Nodes whose mass changed since the last clear().
  const std::vector<NodeIndex>& changed() const { return changed_; }
  void clear() { changed_.clear(); }

 private:
  void add(State& state, NodeIndex node, double mass, double inertia);

  std::vector<NodeIndex> changed_;
};

}  // namespace kardan

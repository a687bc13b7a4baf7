// What elements without a mass of their own (springs, discrete beams) need of the nodes and bodies at their ends.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/elements/governing.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Nodes that need no mass of their own: of rigid bodies, or held in all translations. By node, 1 or 0.
std::vector<std::uint8_t> carried_nodes(const Model& model);

/// A bound on the largest eigenvalue of M^-1 K: an element's own one, between the masses of its two ends, is at most
/// k (w1 + w2), w the inverse masses of the ends; where several elements end at one node or body, each has only the share of the mass
/// that its eigenvalue has of their sum, and the largest sum bounds the eigenvalues of the model. It is exact for a single
/// element, the formula 2 sqrt(m1 m2/(k (m1 + m2))) of LS-DYNA. Likewise for damping. A step of lagged damping is stable for
/// K dt^2/4 + C dt/2 <= 1. LS-DYNA does not limit the step by springs between rigid bodies; without a limit a stiff one would blow up.
class StepBound {
 public:
  explicit StepBound(std::size_t node_count) : load_of_node_(node_count, none) {}

  /// Set-up: a node at which an element ends.
  void use(NodeIndex node);
  /// Each cycle: begin(), add() of every element's own eigenvalues at each end, then governing().
  void begin(const State& state);
  void add(const State& state, NodeIndex node, double stiffness, double damping, Index element);
  /// The smallest step and the index of the element with the largest share in it, none if nothing limits the step.
  struct Smallest {
    double time_step;
    Index element;
  };
  Smallest smallest() const;

 private:
  struct Load {
    double stiffness = 0, damping = 0, largest = 0;
    Index element = none;  ///< with the largest share
  };
  std::vector<std::int32_t> load_of_node_;  ///< into node_load_, none where no element ends
  std::vector<Load> node_load_, body_load_;
};

/// Largest inverse mass of a node for a force in any direction, or of its body at that point; and of its rotary inertia for a moment.
struct InverseMass {
  double translation = 0, rotation = 0;
};
InverseMass largest_inverse_mass(const State& state, NodeIndex node);

}  // namespace kardan

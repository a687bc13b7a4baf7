// The nodes of a set move as one mass under the sum of their forces: along each tied axis
//   v = sum m_i v_i / sum m_i,
// the velocity nearest to those of the nodes in the norm of the kinetic energy; momentum is kept. Source: Hallquist, LS-DYNA Theory
// Manual, Constraints and joints: shared degrees of freedom.
#include "kardan/loads/common_motions.hpp"

#include <string>

namespace kardan {

CommonMotions::CommonMotions(const Model& model, const State& state, TakenDofs& taken, Diagnostics& diagnostics) {
  for (const CommonMotion& set : model.common_motions) {
    for (const NodeIndex n : set.nodes)
      taken.take(model, state, n, set.dofs, "constrained node set " + std::to_string(set.id), "*CONSTRAINED_NODE_SET", diagnostics);
  }
}

void CommonMotions::impose(const Model& model, State& state) const {
  NodeState& nodes = state.nodes;
  for (const CommonMotion& set : model.common_motions) {
    if (state.clock.time >= set.death) continue;
    Vec3 momentum;
    double mass = 0;
    for (const NodeIndex n : set.nodes) {
      momentum += nodes.v[n] * nodes.mass[n];
      mass += nodes.mass[n];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(set.dofs & (1u << axis))) continue;
      for (const NodeIndex n : set.nodes) nodes.v[n][axis] = momentum[axis] / mass;
    }
  }
}

}  // namespace kardan

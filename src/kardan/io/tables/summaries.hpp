// Masses, momenta and energies of parts and of the whole model at t_n.
#pragma once

#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

struct PartSummary {
  double internal = 0, kinetic = 0, hourglass = 0;
  double mass = 0;  ///< of a merged rigid body: all of it with the lead part, none with the others
  Vec3 momentum;
  Vec3 velocity;  ///< of the rigid body; of a deformable part: momentum / mass
};

/// One entry a part of the model. Deformable parts have mass and momentum where State::energy has them.
std::vector<PartSummary> part_summaries(const Model& model, const State& state);

/// Total momentum / total mass: mass of bodies and of nodes outside bodies. Zero for a model without mass.
Vec3 global_velocity(const State& state);

/// The part is meshed or at least a *PART of the deck; false for those that stand for a nodal rigid body.
inline bool listed(const Part& part) {
  return part.nodal_rigid_body == none;
}

}  // namespace kardan

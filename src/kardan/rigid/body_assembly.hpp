// From the deck's rigid parts, nodal rigid bodies, merges and extra nodes to bodies with mass, centre, inertia and nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Mass, centre and inertia tensor about the centre, global components.
struct MassProperties {
  double mass = 0;
  Vec3 center;
  Mat3 inertia{};

  /// Adds a piece (parallel-axis theorem).
  void add(const MassProperties& piece);
};

/// The nodes of all bodies in compressed rows: body b has entries first[b] … first[b + 1].
struct BodyNodes {
  std::vector<std::size_t> first;
  std::vector<NodeIndex> node;
  std::vector<Vec3> arm;  ///< from the centre, principal axes
};

/// Fixed degrees of freedom of a body: Dof bits in the global axes, and in the axes of one frame.
struct BodyFixity {
  std::uint8_t global = 0;
  std::uint8_t local = 0;
  Index frame = none;
};

/// A fixity that acts from birth to death (*BOUNDARY_SPC_…_BIRTH_DEATH on a node of a body).
struct TimedFixity {
  BodyIndex body = none;
  BodyFixity fixity;
  double birth = 0, death = 1e20;
};

struct BodyAssembly {
  BodyNodes nodes;
  std::vector<BodyFixity> fixity;        ///< by body
  std::vector<TimedFixity> timed_fixity;
  std::vector<std::uint8_t> given_velocity;  ///< by body: initial velocity from *PART_INERTIA / _INERTIA
  std::vector<Vec3> initial_velocity, initial_omega;
};

/// Makes the bodies: fills state.bodies (info, of_part, motion at rest) and state.nodes.body; errors and notices go to
/// `diagnostics`. Masses of nodes are read from state.nodes.mass (eqs. 3 and 6: a body without given inertia is the sum of
/// its lumped nodal masses).
BodyAssembly assemble_bodies(const Model& model, State& state, Diagnostics& diagnostics);

}  // namespace kardan

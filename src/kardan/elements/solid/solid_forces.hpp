// Deformable solids: which formulation and law computes a part, and what its elements start from.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/tiles/tile_elements.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class SolidForces {
 public:
  /// Cuts the tiles of all solids that are not rigid; complains about formulations, hourglass controls and materials
  /// that are not computed.
  SolidForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Stresses to t_n and forces onto the nodes. @throws RunError naming a solid without volume or with a value that is
  /// not finite.
  void internal_forces(const Model& model, State& state);
  /// Adds the forces of the cycle to the nodes begin <= n < end.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const { elements_.add_forces(state, begin, end); }
  TileElements& elements() { return elements_; }
  const Governing& governing() const { return elements_.governing(); }
  const TileElements& elements() const { return elements_; }
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
    elements_.add_energies(internal, hourglass);
  }
  /// Writes the stresses and plastic strains at t_n, global axes; rigid solids keep zeros. Does nothing without deformable solids.
  void report(SolidResults& results) const;

 private:
  bool set_up_part(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void start_histories(const Model& model);

  TileElements elements_;
  std::vector<Law> laws_;  ///< by part of the model
};

}  // namespace kardan

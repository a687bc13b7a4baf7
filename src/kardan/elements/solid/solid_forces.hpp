// Deformable solids: tiles, their histories and properties, and the loop over tiles.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/governing.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "kardan/model/model.hpp"
#include "kardan/parallel/tile.hpp"
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
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const {
    slots_.add_to(state.nodes.force, state.nodes.moment, begin, end);
  }
  const Governing& governing() const { return governing_; }
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const;
  /// Writes the stresses at t_n, global axes; rigid solids keep zeros. Does nothing without deformable solids.
  void report(SolidResults& results) const;

 private:
  struct Scratch {
    std::vector<double> node;
  };
  /// What a tile reports of a cycle.
  struct Outcome {
    double time_step = 0;
    std::size_t governing = 0, broken = 0;
  };

  bool computable(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void start_history(const Model& model);
  void run_tile(std::size_t tile, const State& state, Scratch& scratch);
  [[noreturn]] void report_broken(const Model& model, const State& state, const Tile& tile, std::size_t element) const;

  TileMesh mesh_;
  SlotSum slots_;
  SolidKernel kernel_;
  std::vector<SolidProperties> properties_;   ///< by part of the model
  std::vector<double> history_;               ///< blocks of all tiles
  std::vector<double> internal_, hourglass_;  ///< energies, by tile
  std::vector<Outcome> outcome_;              ///< by tile
  std::vector<Scratch> scratch_;              ///< by thread
  Governing governing_;
};

}  // namespace kardan

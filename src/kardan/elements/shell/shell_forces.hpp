// Deformable shells: tiles, their histories and properties, and the loop over tiles.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/governing.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/model/model.hpp"
#include "kardan/parallel/tile.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ShellForces {
 public:
  /// Cuts the tiles of all shells that are not rigid; complains about formulations and materials that are not computed.
  ShellForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Stresses to t_n and forces onto the nodes. @throws RunError naming a shell without area or with a value that is not finite.
  void internal_forces(const Model& model, State& state);
  /// Adds the forces of the cycle to the nodes begin <= n < end.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const {
    slots_.add_to(state.nodes.force, state.nodes.moment, begin, end);
  }
  const Governing& governing() const { return governing_; }
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const;

  /// Stresses xx, yy, xy, yz, zx at t_n of a shell's point through the thickness (0 = first), in the element's axes.
  /// @return false if the shell is not deformable.
  bool stress(Index shell, int point, double (&s)[5]) const;

 private:
  struct Scratch {
    std::vector<double> x, v;
  };
  /// What a tile reports of a cycle.
  struct Outcome {
    double time_step = 0;
    std::size_t governing = 0, broken = 0;
  };

  /// Values that an element of the part keeps.
  std::size_t history_size(PartIndex part) const { return shell_history_size(properties_[part].points, start_[part].size()); }
  bool computable(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void run_tile(std::size_t tile, const State& state, Scratch& scratch);
  [[noreturn]] void report_broken(const Model& model, const State& state, const Tile& tile, std::size_t element) const;

  TileMesh mesh_;
  SlotSum slots_;
  const ShellKernels<ShellLaw>* kernels_;
  std::vector<ShellProperties> properties_;         ///< by part of the model
  std::vector<std::vector<double>> tables_;         ///< by part: what its law points into
  std::vector<std::vector<double>> start_;          ///< by part: values of a point at the start
  std::vector<double> history_;                     ///< blocks of all tiles
  std::vector<std::size_t> history_begin_;          ///< by tile
  std::vector<double> internal_, hourglass_;        ///< energies, by tile
  std::vector<Outcome> outcome_;                    ///< by tile
  std::vector<Scratch> scratch_;                    ///< by thread
  std::vector<Index> place_;                        ///< by shell of the model: block * lanes + lane, or none
  std::vector<Index> tile_of_block_;
  Governing governing_;
};

/// Points and weights of the Gauss-Legendre rule on [-1, 1], ascending; exact to degree 2 n - 1.
void gauss_rule(int n, double* points, double* weights);

}  // namespace kardan

// Deformable shells: which formulation and law computes a part, and what its elements start from.
#pragma once

#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/elements/tiles/tile_elements.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ShellForces {
 public:
  /// Cuts the tiles of all shells that are not rigid; complains about formulations and materials that are not computed.
  ShellForces(const Model& model, State& state, Diagnostics& diagnostics);

  /// Stresses to t_n and forces onto the nodes. @throws RunError naming a shell without area or with a value that is not finite.
  void internal_forces(const Model& model, State& state);
  /// Adds the forces of the cycle to the nodes begin <= n < end.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const { elements_.add_forces(state, begin, end); }
  TileElements& elements() { return elements_; }
  const Governing& governing() const { return elements_.governing(); }
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const {
    elements_.add_energies(internal, hourglass);
  }

  /// Stresses xx, yy, xy, yz, zx at t_n of a shell's point through the thickness (0 = first), in the element's axes.
  /// @return false if the shell is not deformable.
  bool stress(Index shell, int point, double (&s)[5]) const;

 private:
  bool set_up_part(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void start_histories(const Model& model);

  TileElements elements_;
  std::vector<Law> laws_;                                             ///< by part of the model
  std::vector<std::shared_ptr<const ShellProperties>> properties_;    ///< likewise
};

/// Points and weights of the Gauss-Legendre rule on [-1, 1], ascending; exact to degree 2 n - 1.
void gauss_rule(int n, double* points, double* weights);

}  // namespace kardan

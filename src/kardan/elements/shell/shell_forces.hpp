// Deformable shells: which formulation and law computes a part, and what its elements start from.
#pragma once

#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/shell/shell_formulation.hpp"
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
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const;
  /// The elements by group of kernels, for SECFORC.
  std::vector<TileElements*> elements() { return {&quads_.elements, &triangles_.elements}; }
  const Governing& governing() const;
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const;
  /// Shells deleted so far, and the internal energy they took with them.
  std::int64_t deleted() const { return quads_.elements.deleted() + triangles_.elements.deleted(); }
  double eroded_energy() const { return quads_.elements.eroded_energy() + triangles_.elements.eroded_energy(); }

  /// Fills state.results.shell with what D3PLOT and ELOUT show at t_n.
  void report(const Model& model, State& state) const;

  /// Stresses xx, yy, xy, yz, zx at t_n of a shell's point through the thickness (0 = first), in the element's axes; the mean over the
  /// plane. @return false if the shell is not deformable.
  bool stress(Index shell, int point, double (&s)[5]) const;

 private:
  /// Elements of one kind of kernel; a part may have some of both.
  struct Group {
    TileElements elements;
    std::vector<std::shared_ptr<const ShellProperties>> properties;  ///< by part of the model
  };

  bool make_part(const Model& model, PartIndex part, Diagnostics& diagnostics);
  void set_kernel(const Model& model, PartIndex part, Group& group);
  void start(const Model& model, State& state, Group& group);
  void preload(const Model& model, Diagnostics& diagnostics);
  void preload_shell(const Model& model, const InitialStress& given, Index shell, Group& group);
  const Group& group_of(Index shell) const { return quads_.elements.values_of(shell) ? quads_ : triangles_; }
  void report_group(const Model& model, State& state, const Group& group) const;
  void report_histories(const Model& model, State& state) const;

  std::vector<ShellFormulation> formulations_;  ///< by part of the model
  std::vector<Law> laws_;                       ///< likewise
  Group quads_, triangles_;                     ///< quadrilaterals, and triangles that are computed as such; C0 triangles
};

}  // namespace kardan

// Deformable solids: which formulation and law computes a part, and what its elements start from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/solid/nodal_volumes.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "kardan/elements/solid/solid_shape.hpp"
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
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const;
  Governing governing() const;
  /// Solids deleted so far, and the internal energy they took with them.
  std::int64_t deleted() const;
  double eroded_energy() const;
  /// Adds the energies at t_n, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const;
  /// Writes the stresses and plastic strains at t_n, means over the points, global axes; rigid solids keep zeros. Does nothing without
  /// deformable solids.
  void report(SolidResults& results) const;
  /// By shape.
  std::vector<TileElements*> elements();

 private:
  /// Elements of one shape.
  struct Shape {
    TileElements elements;
    std::vector<const SolidFormulation*> formulation;  ///< by part of the model
  };
  bool set_up_part(const Model& model, SolidShape shape, PartIndex part, Diagnostics& diagnostics);
  /// The formulation of a shape in a part with this ELFORM; null where there is none.
  static const SolidFormulation* formulation_of(SolidShape shape, int elform, int esort);
  void start_histories(const Model& model, Shape& shape);
  void preload(const Model& model, Diagnostics& diagnostics);
  void preload_solid(const Model& model, const InitialStress& given, Index solid, Shape& shape, Diagnostics& diagnostics);

  std::array<Shape, solid_shapes.size()> shapes_;             ///< by SolidShape
  std::vector<Law> laws_;                   ///< by part of the model
  std::vector<std::uint8_t> nodal_pressure_; ///< likewise: tetrahedra ELFORM 13
  NodalVolumes nodal_volumes_;
};

}  // namespace kardan

// Forces through cross sections (*DATABASE_CROSS_SECTION, SECFORC).
#pragma once

#include <array>
#include <vector>

#include "kardan/elements/tiles/tile_elements.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Sums what the nodes of each section exert on the section's elements. With the elements on one side of a cut and the nodes on it, or
/// beyond it, this is the traction of the other side: in tension it points away from the elements.
class SectionForces {
 public:
  /// @param tiled the groups of shells, solids and beams, in the order of ElementKind
  SectionForces(const Model& model, const std::array<std::vector<TileElements*>, 3>& tiled);
  /// Writes state.sections at t_n.
  void report(const Model& model, State& state) const;

 private:
  /// A node of an element that lies on the section.
  struct Corner {
    const TileElements* group = nullptr;
    Index element = none;
    std::size_t a = 0;
    NodeIndex node = none;
  };
  std::vector<std::vector<Corner>> corners_;  ///< by section
};

}  // namespace kardan

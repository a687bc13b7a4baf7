// Order and counts of what stands in a d3plot: made once from the model, used by every section.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kardan/model/model.hpp"

namespace kardan {

/// Readers expect ascending user ids everywhere; entries are indices into the model's arrays in that order.
struct D3plotLayout {
  std::vector<Index> nodes, solids, shells, parts;
  struct Line {
    bool discrete = false;  ///< a spring or damper between two nodes, shown as a beam (BEAM = 0 of EXTENT_BINARY)
    Index element = none;   ///< into the model's beams or discretes
  };
  std::vector<Line> lines;
  std::vector<std::int32_t> node_number;  ///< 1-based position of each node of the model
  std::vector<std::int32_t> part_number;  ///< 1-based position of each part; 0: not in the file (nodal rigid bodies)
  std::int64_t solid_parts = 0, shell_parts = 0,
               line_parts = 0;            ///< NUMMAT8, NUMMAT4, NUMMAT2; they add up to all parts
  std::vector<std::uint8_t> rigid_shell;  ///< by entry of `shells`
  std::int64_t rigid_shells = 0;
  std::int64_t walls = 0;

  explicit D3plotLayout(const Model& model);
};

/// What depends on how the file is to be written.
struct D3plotWords {
  int layers = 3;               ///< MAXINT
  bool material_types = false;  ///< NDIM = 5: material type section, rigid shells left out of the states
  bool deletion = false;        ///< MDLOPT = 2: a word for each element, 0 = deleted

  std::int64_t shell_words_given = 0;  ///< NV2D of a file without stresses; 0 = of one with them

  static constexpr std::int64_t solid_words = 7, line_words = 6;
  std::int64_t shell_words() const { return shell_words_given > 0 ? shell_words_given : 7 * layers + 8 + 4; }
};

}  // namespace kardan

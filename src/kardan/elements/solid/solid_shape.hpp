// Which shape a solid has: eight nodes of *ELEMENT_SOLID, some of them repeated, are a hexahedron, a pentahedron or a tetrahedron.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kardan/base/index.hpp"

namespace kardan {

enum class SolidShape : std::uint8_t { hexahedron, tetrahedron, pentahedron };

/// The four nodes of a tetrahedron in the order of their first mention, if there are no more.
std::optional<std::array<NodeIndex, 4>> tetrahedron_nodes(const std::array<NodeIndex, 8>& nodes);
/// The six nodes of a pentahedron, triangle by triangle: a hexahedron of which two edges of one face, parallel to each other, have no
/// length, and whose other nodes are distinct. Numbered so that the volume has the sign of the hexahedron's.
std::optional<std::array<NodeIndex, 6>> pentahedron_nodes(const std::array<NodeIndex, 8>& nodes);

}  // namespace kardan

// Which shape a solid has: eight nodes of *ELEMENT_SOLID, some of them repeated, are a hexahedron, a pentahedron or a tetrahedron; and
// what follows from it for the nodes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/model/element_shape.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// The quadratic hexahedron is set apart because its nodes turn.
enum class SolidShape : std::uint8_t { hexahedron, tetrahedron, pentahedron, quadratic };
inline constexpr std::array<SolidShape, 4> solid_shapes{SolidShape::hexahedron, SolidShape::tetrahedron, SolidShape::pentahedron,
                                                        SolidShape::quadratic};

/// ELFORM of *SECTION_SOLID.
namespace solid_elform {
inline constexpr int one_point = 1, selective = 2, slender = -1, slender_exact = -2, quadratic = 3, tetrahedra = 10, nodal_tetrahedra = 13, pentahedra = 15;
}  // namespace solid_elform

/// Shape of a solid: four-node elements are tetrahedra whatever the formulation (the trilinear map would fill only half of them, and the
/// gradients of ELFORM 1 and 2 are the same there); pentahedra stay hexahedra with repeated nodes unless they are to be sorted.
SolidShape shape_of(const Model& model, std::size_t solid);
/// Square of the longest edge of a hexahedron [length^2].
double longest_edge_square(const ElementCoordinates<8>& x);
/// Rotary inertia that a solid gives to each of its nodes, whose share of its mass is `mass`, about every axis: m l^2/8 for quadratic
/// hexahedra, l the longest edge; none for all others. So the rotations take only a quarter off the stable step (quadratic_hexahedron.hpp); the inertia
/// vanishes under refinement as that of the shells, m A/8, does.
double solid_inertia(const Model& model, std::size_t solid, double mass);

/// The four nodes of a tetrahedron in the order of their first mention, if there are no more.
std::optional<std::array<NodeIndex, 4>> tetrahedron_nodes(const std::array<NodeIndex, 8>& nodes);
/// The six nodes of a pentahedron, triangle by triangle: a hexahedron of which two edges of one face, parallel to each other, have no
/// length, and whose other nodes are distinct. Numbered so that the volume has the sign of the hexahedron's.
std::optional<std::array<NodeIndex, 6>> pentahedron_nodes(const std::array<NodeIndex, 8>& nodes);

}  // namespace kardan

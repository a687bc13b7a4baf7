// What the solid kernels are given: plain data, one entry for every instruction set and law.
#pragma once

#include <cstddef>

#include "kardan/elements/solid/quadratic_points.hpp"
#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan {

/// Hourglass control of the one-point hexahedron: IHQ 1 to 3, 4 and 5, 6.
enum class SolidHourglass { viscous, stiffness, assumed_strain };

/// What all elements of a part share.
struct SolidProperties {
  LawOfTile law;
  double density = 0;                ///< at t = 0
  double longitudinal = 0;           ///< lambda + 2 mu at the start
  double wave_speed = 0;             ///< sqrt((lambda + 2 mu)/rho)
  double q1 = 0, q2 = 0;             ///< bulk viscosity
  SolidHourglass hourglass = SolidHourglass::viscous;
  double hourglass_scale = 0;        ///< stiffness: QM (lambda + 2 mu)/16; viscous: QM rho c/4; assumed strain and pentahedra: QM mu
  double poissons_ratio = 0;         ///< assumed strain
  bool nodal_pressure = false;       ///< tetrahedra ELFORM 13
  double failing_points = 1;         ///< so many points must fail before the element is deleted
  bool erode = false;                ///< an element that turns inside out is deleted instead of stopping the run
};

/// What an element keeps, for every formulation: bulk viscosity's pressure; volume at t = 0; V^(-1/3) at t_n; the
/// formulation's own values; then, for each point, stress xx, yy, zz, xy, yz, zx in global axes and the law's values.
namespace solid_history {
inline constexpr std::size_t viscosity = 0, volume = 1, inverse_size = 2, own = 3;
/// Of `point`, of a formulation with `own_values` and a law with `law_values`.
constexpr std::size_t stress(std::size_t own_values, std::size_t law_values, std::size_t point) {
  return own + own_values + point * (6 + law_values);
}
}  // namespace solid_history

/// The own values of the quadratic hexahedron: square of the longest edge at t = 0; Jacobians of the points at t = 0.
namespace quadratic_history {
inline constexpr std::size_t longest_edge_square = 0, jacobian = 1, count = 1 + quadratic_point_count;
}  // namespace quadratic_history

/// One formulation: how its elements are stored and computed.
struct SolidFormulation {
  std::size_t nodes = 0, points = 0;
  std::size_t own_values = 0;                ///< in the history, beside what all have
  const TileKernels& (*kernels)() = nullptr; ///< for kernel_level() (base/isa.hpp)

  /// Share of a point in the element's mean stress.
  double (*share_of_point)(std::size_t point) = nullptr;  ///< null: all alike

  double share(std::size_t point) const { return share_of_point ? share_of_point(point) : 1.0 / static_cast<double>(points); }
  std::size_t history_size(std::size_t law_values) const { return solid_history::stress(own_values, law_values, points); }
};

/// ELFORM 1: one point; own values: forces of the four hourglass modes.
extern const SolidFormulation one_point_hexahedron;
/// ELFORM 2: eight points, mean volume change.
extern const SolidFormulation full_hexahedron;
/// ELFORM 3: fourteen points, nodes that turn; own values: quadratic_history.
extern const SolidFormulation quadratic_hexahedron;
/// ELFORM 10 and 13: one point; own value: mean volume ratio of the nodes at t_n (13).
extern const SolidFormulation one_point_tetrahedron;
/// ELFORM 15: two points; own value: moment of the twist.
extern const SolidFormulation two_point_pentahedron;

}  // namespace kardan

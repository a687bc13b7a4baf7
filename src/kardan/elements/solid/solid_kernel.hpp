// What the solid kernels are given: plain data, one entry for every instruction set and law.
#pragma once

#include <cstddef>

#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan {

/// What all elements of a part share.
struct SolidProperties {
  LawOfTile law;
  double density = 0;                ///< at t = 0
  double longitudinal = 0;           ///< lambda + 2 mu at the start
  double wave_speed = 0;             ///< sqrt((lambda + 2 mu)/rho)
  double q1 = 0, q2 = 0;             ///< bulk viscosity
  bool stiffness_hourglass = false;  ///< IHQ 4, 5; else viscous
  double hourglass = 0;              ///< stiffness: QM (lambda + 2 mu)/16; viscous: QM rho c/4
};

/// What one element of one point keeps: stress xx, yy, zz, xy, yz, zx in global axes; forces of the four hourglass modes, x, y, z
/// each; bulk viscosity's pressure; volume at t = 0; cube root of the volume at t_n; then the law's own values.
namespace solid_history {
inline constexpr std::size_t stress = 0, hourglass = 6, viscosity = 18, volume = 19, size = 20, law = 21;
}

/// The one-point hexahedron for kernel_level() (base/isa.hpp).
const TileKernels& hexahedron();

}  // namespace kardan

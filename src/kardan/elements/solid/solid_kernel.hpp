// The solid kernel as the rest of the program sees it: plain pointers in, plain pointers out, one entry an instruction
// set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/elastic.hpp"

namespace kardan {

/// What all elements of a tile share.
struct SolidProperties {
  Elastic law;
  double density = 0;                ///< at t = 0
  double wave_speed = 0;             ///< sqrt((lambda + 2 mu)/rho)
  double q1 = 0, q2 = 0;             ///< bulk viscosity
  bool stiffness_hourglass = false;  ///< IHQ 4, 5; else viscous
  double hourglass = 0;              ///< stiffness: QM (lambda + 2 mu)/16; viscous: QM rho c/4
};

/// What one element keeps: stress xx, yy, zz, xy, yz, zx in global axes; forces of the four hourglass modes, x, y, z
/// each; bulk viscosity's pressure; volume at t = 0; cube root of the volume at t_n.
namespace solid_history {
inline constexpr std::size_t stress = 0, hourglass = 6, viscosity = 18, volume = 19, size = 20, count = 21;
}

/// Doubles of a tile's node: position at t_n, velocity at t_{n-1/2}, each filled up to four.
inline constexpr std::size_t solid_node_stride = 8;

/// One tile in one cycle. Local arrays are indexed by the tile's own nodes.
struct SolidTileWork {
  const SolidProperties* properties = nullptr;
  const std::uint16_t* connectivity = nullptr;  ///< [block][8][block_lanes]
  std::size_t elements = 0;
  const double* node = nullptr;  ///< [node][solid_node_stride]
  double dt = 0;                 ///< t_n - t_{n-1}
  double* history = nullptr;     ///< [block][solid_history::count][block_lanes]
  double* force = nullptr;       ///< [node][3] on the nodes; overwritten
  std::size_t nodes = 0;
  double internal_increment = 0;   ///< out: work of the stresses and of bulk viscosity over the step
  double hourglass_increment = 0;  ///< out
  double time_step = 0;            ///< out: smallest stable step
  std::size_t governing = 0;       ///< out: its element in the tile
  std::size_t broken = 0;          ///< out: 1 + an element without volume or with a value that is not finite; 0 = none
};

using SolidKernel = void (*)(SolidTileWork&);

/// The one-point hexahedron with MAT_ELASTIC for kernel_level() (base/isa.hpp).
SolidKernel hexahedron_elastic();

}  // namespace kardan

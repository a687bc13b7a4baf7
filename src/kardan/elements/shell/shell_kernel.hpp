// The shell kernels as the rest of the program sees them: plain pointers in, plain pointers out, one entry for every instruction set
// and every law.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/elastic_plane_stress.hpp"
#include "kardan/materials/plastic_plane_stress.hpp"

namespace kardan {

inline constexpr std::size_t max_shell_points = 32;

/// The laws of shells: the kernel is compiled for each of them.
using ShellLaw = std::variant<ElasticPlaneStress, PlasticPlaneStress>;

/// What all elements of a tile share.
struct ShellProperties {
  ShellLaw law;
  int points = 2;                      ///< through the thickness
  double zeta[max_shell_points] = {};  ///< z / (h/2) of the points, measured from the surface of the nodes
  double weight[max_shell_points] = {};///< Gauss weights, sum 2
  double wave_speed = 0;               ///< sqrt(E / (rho (1 - nu^2)))
  bool stiffness_hourglass = false;    ///< IHQ 4, 5; else viscous
  double hourglass_membrane = 0;       ///< stiffness: r E/8;            viscous: QM rho c/4
  double hourglass_bending = 0;        ///< stiffness: r E/192;          viscous: the membrane's / 24
  double hourglass_warping = 0;        ///< stiffness: r k G/12;         viscous: the membrane's (2/3) k G/E
  bool side_lengths = true;            ///< time step by sides (ISDO 0), else by diagonals
};

/// Number of values that one point keeps: 5 stresses and the law's own.
template <class Law>
inline constexpr std::size_t shell_point_values = 5 + Law::history;

/// Number of values that one element keeps: those of its points, 5 hourglass forces, thickness.
constexpr std::size_t shell_history_size(int points, std::size_t point_values) {
  return point_values * static_cast<std::size_t>(points) + 6;
}

/// One tile in one cycle. Local arrays are indexed by the tile's own nodes.
struct ShellTileWork {
  const ShellProperties* properties = nullptr;
  const std::uint16_t* connectivity = nullptr;  ///< [block][4][block_lanes]
  std::size_t elements = 0;
  const double* x = nullptr;      ///< [node][3] at t_n
  const double* v = nullptr;      ///< [node][6] velocity, angular velocity at t_{n-1/2}
  double dt = 0;                  ///< t_n - t_{n-1}
  double* history = nullptr;      ///< [block][shell_history_size][block_lanes]
  double* force = nullptr;        ///< [node][6] force and moment on the nodes; overwritten
  std::size_t nodes = 0;
  double internal_increment = 0;  ///< out: work of the stresses over the step
  double hourglass_increment = 0; ///< out
  double time_step = 0;           ///< out: smallest stable step
  std::size_t governing = 0;      ///< out: its element in the tile
  std::size_t broken = 0;         ///< out: 1 + an element without area or with a value that is not finite; 0 = none
};

/// A tile with the law that the entry is for.
using ShellKernel = void (*)(ShellTileWork&, const void* law);

/// Entries in the order of the laws.
template <class Laws>
using ShellKernels = std::array<ShellKernel, std::variant_size_v<Laws>>;

/// The Belytschko-Tsay kernels for kernel_level() (base/isa.hpp).
const ShellKernels<ShellLaw>& belytschko_tsay();

}  // namespace kardan

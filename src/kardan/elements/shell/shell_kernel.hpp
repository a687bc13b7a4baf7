// What the shell kernels are given: plain data, one entry for every instruction set and law.
#pragma once

#include <cstddef>

#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan {

inline constexpr std::size_t max_shell_points = 32;

/// What all elements of a part share.
struct ShellProperties {
  LawOfTile law;
  int points = 2;                      ///< through the thickness
  double failing_points = 2;           ///< an element is deleted when so many of its points have failed
  double zeta[max_shell_points] = {};  ///< z / (h/2) of the points, measured from the surface of the nodes
  double weight[max_shell_points] = {};///< Gauss weights, sum 2
  double wave_speed = 0;               ///< sqrt(E / (rho (1 - nu^2)))
  bool stiffness_hourglass = false;    ///< IHQ 4, 5; else viscous
  double hourglass_membrane = 0;       ///< stiffness: r E/8;            viscous: QM rho c/4
  double hourglass_bending = 0;        ///< stiffness: r E/192;          viscous: the membrane's / 24
  double hourglass_warping = 0;        ///< stiffness: r k G/12;         viscous: the membrane's (2/3) k G/E
  bool side_lengths = true;            ///< time step by sides (ISDO 0), else by diagonals
};

/// Values that one point keeps: 5 stresses and the law's own.
constexpr std::size_t shell_point_values(std::size_t law_history) { return 5 + law_history; }

/// Values that one element keeps: those of its points, 5 hourglass forces, thickness.
constexpr std::size_t shell_history_size(int points, std::size_t law_history) {
  return shell_point_values(law_history) * static_cast<std::size_t>(points) + 6;
}

/// The Belytschko-Tsay kernels for kernel_level() (base/isa.hpp).
const TileKernels& belytschko_tsay();

}  // namespace kardan

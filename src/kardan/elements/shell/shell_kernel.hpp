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
  int in_plane = 1;                    ///< points in the plane
  double cross_strain = 0;             ///< -nu, of the assumed strains of the fully integrated shell
  bool thins = false;                  ///< the thickness follows the normal strain (ISTUPD)
  double elastic_thinning = 0;         ///< nu/E where the elastic part of that strain is left out (ISTUPD = 4)
  bool offsets = false;                ///< elements keep the height of their mid surface over the nodes (*ELEMENT_SHELL_OFFSET)
};

/// Values that one point keeps: 5 stresses and the law's own.
constexpr std::size_t shell_point_values(std::size_t law_history) { return 5 + law_history; }

/// Where the values of an element begin that follow those of its points (through the thickness, for one point in the plane after the other):
/// 5 hourglass forces, thickness, and the offset where it is kept.
constexpr std::size_t shell_kept(const ShellProperties& p, std::size_t law_history) {
  return shell_point_values(law_history) * static_cast<std::size_t>(p.points) * static_cast<std::size_t>(p.in_plane);
}
inline constexpr std::size_t kept_thickness = 5, kept_offset = 6;  ///< from there

/// Values that one element keeps.
constexpr std::size_t shell_history_size(const ShellProperties& p, std::size_t law_history) {
  return shell_kept(p, law_history) + (p.offsets ? 7 : 6);
}

/// The kernels for kernel_level() (base/isa.hpp): Belytschko-Tsay, C0 triangle, fully integrated.
const TileKernels& belytschko_tsay();
const TileKernels& c0_triangle();
const TileKernels& fully_integrated();

}  // namespace kardan

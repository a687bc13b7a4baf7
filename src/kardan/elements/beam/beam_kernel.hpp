// What the beam kernels are given: plain data, one entry for every instruction set, formulation and law.
#pragma once

#include <cstddef>

#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan {

inline constexpr std::size_t max_beam_points = 16;

/// What all elements of a part share.
struct BeamProperties {
  LawOfTile law;                             ///< of trusses and integrated beams
  int points = 0;                            ///< of the cross section; 0: no stresses, resultants only
  double s[max_beam_points] = {};            ///< coordinates of the points, as multiples of the element's two half sizes
  double t[max_beam_points] = {};
  double weight[max_beam_points] = {};       ///< shares of the area, sum 1
  double shear_factor = 1;                   ///< SHRF
  double torsion = 1;                        ///< 0: the beam twists freely (ITOFF)
  double youngs_modulus = 0, shear_modulus = 0;
  bool breaks = false;                       ///< spot welds: fail by resultants or time
  double inverse_limit[6] = {};              ///< 1/limit of N (tension only), Q_s, Q_t, T, M_s, M_t; 0 = none
  double failure_time = 0;                   ///< TFAIL; 0 = none
};

/// Values that an element keeps, each in a row of block_lanes; those of its points follow.
namespace beam_history {
inline constexpr std::size_t axis = 0;       ///< unit vector s, global components
inline constexpr std::size_t mass = 3;       ///< of the element at each node
inline constexpr std::size_t inertia = 4;    ///< likewise
inline constexpr std::size_t constant = 5;   ///< 6 constants of the cross section, see the formulations
inline constexpr std::size_t constants = 6;
inline constexpr std::size_t force = 11;     ///< 6 conjugate forces, see BeamForce
inline constexpr std::size_t tilt = 17;      ///< rotations of nodes 1, 2 about s, then about t, see BeamTilt
inline constexpr std::size_t count = 21;
}  // namespace beam_history

/// Values that one point keeps: 3 stresses and the law's own.
constexpr std::size_t beam_point_values(std::size_t law_history) { return 3 + law_history; }

/// Values that one element keeps.
constexpr std::size_t beam_history_size(int points, std::size_t law_history) {
  return beam_history::count + static_cast<std::size_t>(points) * beam_point_values(law_history);
}

/// The kernels for kernel_level() (base/isa.hpp).
const TileKernels& belytschko_schwer();
const TileKernels& truss();
const TileKernels& hughes_liu();

}  // namespace kardan

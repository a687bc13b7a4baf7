// *DAMPING_PART_STIFFNESS: the stress of Rayleigh's damping beta K on top of any law.
//
//   sigma = sigma_law + sigma_v,   sigma_v = beta C d eps/dt over the step that ended,
// with C Hooke's law of the material at the start (shells: in plane stress, transverse shears with SHRF; beams: E along, G across). sigma_v acts
// on the nodes and is not seen by the law. Each point has its own beta [time]; what COEF makes of it stands in elements/damping_factors.hpp.
// Source: Rayleigh 1877; Hallquist, LS-DYNA Theory Manual 2006, "Stiffness damping" of the releases before 960.
#pragma once

#include <cstddef>

#include "kardan/materials/law_entry.hpp"

namespace kardan {

/// History of a point: sigma_v (a tensor; shells xx, yy, xy, yz, zx; beams rr, rs, tr), then the law's own, then beta.
struct DampedLaw {
  const void* law = nullptr;    ///< constants of the law below
  PointUpdate update = nullptr;
  std::size_t law_history = 0;
  double lambda = 0, shear = 0; ///< of C; shells: nu E/(1 - nu^2) in place of lambda
  double transverse = 0;        ///< of the shears yz and zx of shells
  double youngs_modulus = 0;    ///< of beams

  static constexpr std::size_t law_begin = 6;
  std::size_t damping_place() const { return law_begin + law_history; }
  std::size_t history() const { return damping_place() + 1; }
};

}  // namespace kardan

// The factor beta of *DAMPING_PART_STIFFNESS for each element.
//
// COEF < 0 is beta = -COEF itself, Rayleigh's factor on the stiffness: a mode of frequency omega has the damping ratio beta omega/2.
// COEF > 0 is, by LS-DYNA's manual, about that share of critical damping at high frequencies; how LS-DYNA does it is not published. Here every
// element has the beta that gives its own highest frequency, omega = 2/dt with its stable step dt at t = 0, the damping ratio COEF:
//   beta = COEF dt   (beams: dt = l/c).
// In a bar of equal elements a wave n elements long has omega = 2/dt sin(pi/n) and with it the damping ratio COEF sin(pi/n).
#pragma once

#include "kardan/model/model.hpp"

namespace kardan {

/// The entry that holds for a part, the last one; null where there is none.
inline const StiffnessDamping* stiffness_damping_of(const Model& model, PartIndex part) {
  const StiffnessDamping* found = nullptr;
  for (const StiffnessDamping& damping : model.stiffness_dampings) {
    for (const PartIndex p : damping.parts) {
      if (p == part) found = &damping;
    }
  }
  return found;
}

/// What each element of the part has. @param step stable step of the element at t = 0
inline double damping_factor(const StiffnessDamping& damping, double step) {
  return damping.beta > 0 ? damping.beta : damping.fraction * step;
}

}  // namespace kardan

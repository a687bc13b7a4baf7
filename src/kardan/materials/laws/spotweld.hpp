// *MAT_SPOTWELD (100) of beams: von Mises' yield condition with linear isotropic hardening, Y = SIGY + EH p.
//
// The mathematics is that of *MAT_PLASTIC_KINEMATIC with BETA = 1 and the plastic modulus E_p = EH; a point fails when its effective plastic
// strain reaches EFAIL. Failure by resultants and by time belongs to the element (beam_formulations.hpp).
// Source: Hallquist, LS-DYNA Keyword User's Manual Vol. II, *MAT_SPOTWELD.
#pragma once

#include "kardan/materials/laws/plastic_kinematic.hpp"

namespace kardan {

struct Spotweld : PlasticKinematic {
  /// From *MAT_SPOTWELD; complains where it cannot be computed.
  static std::optional<Spotweld> make(LawSource& source);
};

}  // namespace kardan

// *MAT_SPOTWELD (100) of beams and solids: von Mises' yield condition with linear isotropic hardening, Y = SIGY + EH p.
//
// The mathematics is that of *MAT_PLASTIC_KINEMATIC with BETA = 1 and the plastic modulus E_p = EH; a point fails when its effective plastic
// strain reaches EFAIL. Failure of beams by resultants and by time belongs to the
// element (beam_formulations.hpp); solids fail by EFAIL, and by time here.
// Source: Hallquist, LS-DYNA Keyword User's Manual Vol. II, *MAT_SPOTWELD.
#pragma once

#include "kardan/materials/laws/plastic_kinematic.hpp"

namespace kardan {

struct Spotweld : PlasticKinematic {
  double failure_time = 0;  ///< TFAIL of solids; 0 = none

  /// From *MAT_SPOTWELD; complains where it cannot be computed.
  static std::optional<Spotweld> make(LawSource& source);
  bool can_fail() const { return PlasticKinematic::can_fail() || failure_time > 0; }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    PlasticKinematic::update(p, t, values);
    if (failure_time > 0 && t.time >= failure_time) p.failed = R(1.0);
  }
};

}  // namespace kardan

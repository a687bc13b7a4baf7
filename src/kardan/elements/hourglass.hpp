// Which hourglass control and bulk viscosity a part has.
#pragma once

#include "kardan/model/model.hpp"

namespace kardan {

/// Hourglass type and coefficients of a part: *HOURGLASS, else *CONTROL_HOURGLASS, else LS-DYNA's defaults (viscous, QM
/// = 0.1); bulk viscosity: *HOURGLASS, else *CONTROL_BULK_VISCOSITY.
struct HourglassChoice {
  int type = 1;
  double membrane = 0.1;                ///< QM
  double bending = 0.1, warping = 0.1;  ///< QB, QW of shells
  double q1 = 1.5, q2 = 0.06;           ///< quadratic and linear coefficient of bulk viscosity

  bool stiffness() const { return type >= 4; }
};

inline HourglassChoice hourglass_of(const Model& model, const Part& part) {
  HourglassChoice c;
  const Control& control = model.control;
  if (control.hourglass_type != 0) c.type = control.hourglass_type;
  c.membrane = control.hourglass_qm != 0 ? control.hourglass_qm : 0.1;
  c.q1 = control.bulk_q1;
  c.q2 = control.bulk_q2;
  const Hourglass* own =
      part.hourglass == none ? nullptr : &model.hourglasses[static_cast<std::size_t>(part.hourglass)];
  if (own && own->type != 0) c.type = own->type;
  if (own && own->coefficient != 0) c.membrane = own->coefficient;
  if (own && own->q1 != 0) c.q1 = own->q1;
  if (own && own->q2 != 0) c.q2 = own->q2;
  c.bending = own && own->bending != 0 ? own->bending : c.membrane;
  c.warping = own && own->warping != 0 ? own->warping : c.membrane;
  return c;
}

}  // namespace kardan

// Load curves against time, in the two phases of a run.
#pragma once

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Value at `time` of a curve that drives a load or a motion: 0 in a phase to which the curve does not belong (SIDR), 1
/// without a curve.
inline double load_curve_value(const Model& model, const Clock& clock, CurveIndex curve, double time) {
  if (curve == none) return 1.0;
  const Curve& c = model.curves[curve];
  const auto other = clock.relaxing ? Curve::Phase::transient : Curve::Phase::relaxation;
  return c.phase == other ? 0.0 : c.value(time);
}
inline double load_curve_value(const Model& model, const Clock& clock, CurveIndex curve) {
  return load_curve_value(model, clock, curve, clock.time);
}

}  // namespace kardan

// When a result file is due.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "kardan/model/control.hpp"
#include "kardan/model/curve.hpp"

namespace kardan {

/// Output times k * dt from t = 0, or steps of a curve's interval (LCUR); always also the end time. A file is written
/// at the first cycle that has reached its time, once a cycle.
class OutputSchedule {
 public:
  /// @param interval  curve of the interval against time, which must live as long; nullptr: `dt` throughout (> 0)
  /// @param end_time  0 = the run has none
  OutputSchedule(double dt, const Curve* interval, double end_time) : dt_(dt), interval_(interval), end_(end_time) {}

  /// Output is due at `time`, reached in steps of about `step`: times closer than a thousandth of a step are equal.
  bool due(double time, double step) const;
  /// Output has been written at `time`.
  void written(double time, double step);

  /// What a later run needs to go on.
  nlohmann::json mark() const;
  void resume(const nlohmann::json& mark);

 private:
  double interval_at(double time) const { return interval_ != nullptr ? interval_->value(time) : dt_; }

  double dt_;
  const Curve* interval_;
  double end_;
  double next_ = 0;       ///< nominal time of the next output
  double last_ = -1e300;  ///< time of the last output written
  bool paused_ = false;   ///< the curve was at or below zero; output goes on when it rises
};

}  // namespace kardan

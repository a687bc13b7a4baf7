#include "kardan/io/output_schedule.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace kardan {

namespace {

/// Two times closer than this are the same cycle. Without a step, rounding of the time itself is the measure.
double tolerance(double time, double step) {
  return step > 0 ? 1e-3 * step : 1e-12 * std::abs(time);
}

}  // namespace

bool OutputSchedule::due(double time, double step) const {
  const double near = tolerance(time, step);
  if (time <= last_ + near) return false;
  if (end_ > 0 && time >= end_ - near) return true;
  return paused_ ? interval_at(time) > 0 : time >= next_ - near;
}

nlohmann::json OutputSchedule::mark() const { return {{"next", next_}, {"last", last_}, {"paused", paused_}}; }

void OutputSchedule::resume(const nlohmann::json& mark) {
  mark.at("next").get_to(next_);
  mark.at("last").get_to(last_);
  mark.at("paused").get_to(paused_);
}

void OutputSchedule::written(double time, double step) {
  last_ = time;
  const double near = tolerance(time, step);
  if (interval_ == nullptr) {
    // Multiples of dt, not sums: no drift of the output times over a long run.
    next_ = dt_ * (std::floor((time + near) / dt_) + 1);
    return;
  }
  paused_ = interval_at(time) <= 0;
  next_ += interval_at(next_);
  if (next_ <= time + near) next_ = time + interval_at(time);
}

}  // namespace kardan

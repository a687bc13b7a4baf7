#include "kardan/solver/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

/// A step that differs from another by less than this is the other one, up to rounding.
constexpr double same_step = 1e-9;

const Curve& curve_of(const Model& model, CurveIndex index) { return model.curves[static_cast<std::size_t>(index)]; }

}  // namespace

std::string to_string(const StepBound& bound) {
  if (bound.rule) return bound.rule;
  static constexpr const char* names[] = {"prescribed", "solid", "beam", "shell", "discrete", "joint"};
  return fmt::format("{} {}", names[static_cast<int>(bound.owner.kind)], bound.owner.id);
}

TimeStepRule::TimeStepRule(const Model& model, const StepFacts& facts, std::optional<double> given, double end,
                           double scale)
    : end_(end) {
  const TimeStepControl& control = model.control.time_step;
  scale_ = scale > 0 ? scale : control.scale > 0 ? control.scale : 0.9;
  limit_ = control.limit;
  if (facts.deformable) {
    first_ = control.initial;
    if (given) cap_ = *given;
    reason_ = fmt::format("time step: {:g} (TSSFAC) x the smallest stable step of the deformable elements", scale_);
    if (given) reason_ += fmt::format(", at most {:g} (--dt)", *given);
    return;
  }
  kind_ = Kind::constant;
  if (given) {
    constant_ = {*given, {}, "--dt"};
    limit_ = none;
    reason_ = fmt::format("time step: constant {:g} as given by --dt (nothing deforms)", constant_.dt);
  } else if (control.initial > 0) {
    constant_ = {control.initial, {}, "DTINIT"};
    limit_ = none;
    reason_ = fmt::format("time step: constant {:g} = DTINIT of *CONTROL_TIMESTEP (nothing deforms)", constant_.dt);
  } else if (limit_ != none) {
    kind_ = Kind::curve;
    reason_ = fmt::format("time step: curve {} (LCTM of *CONTROL_TIMESTEP; nothing deforms)", curve_of(model, limit_).id);
  } else if (std::isfinite(facts.rigid_elements.dt)) {
    constant_ = facts.rigid_elements;
    constant_.dt *= scale_;
    reason_ = fmt::format(
        "time step: constant {:g} = {:g} (TSSFAC) x the Courant step of {} (nothing deforms; set DTINIT or --dt for "
        "another one)", constant_.dt, scale_, to_string(facts.rigid_elements));
  } else {
    constant_ = {facts.rigid_default, {}, "default"};
    reason_ = fmt::format("time step: constant {:g}, 1/20,000 of the end time (nothing deforms, no element, no DTINIT)",
                          constant_.dt);
  }
}

StepBound TimeStepRule::from_rule(const Model& model, const Clock& clock, const StepBound& stable) const {
  StepBound step = stable;
  step.dt *= scale_;
  if (kind_ == Kind::constant) return constant_.dt < step.dt ? constant_ : step;
  const auto cap = [&step](double dt, const char* by) {
    if (dt < step.dt) step = {dt, {}, by};
  };
  if (limit_ != none) cap(curve_of(model, limit_).value(clock.time), "LCTM");
  if (kind_ == Kind::courant) {
    cap(cap_, "--dt");
    if (clock.cycle == 0 && first_ > 0) cap(first_, "DTINIT");
    if (clock.cycle > 0) cap(largest_growth * clock.dt_previous, "growth");
  }
  return step;
}

StepBound TimeStepRule::next(const Model& model, const Clock& clock, const StepBound& stable, double rotation) const {
  StepBound step = from_rule(model, clock, stable);
  if (rotation < step.dt) step = {rotation, {}, "rotation"};
  const double rest = end_ - clock.time;
  if (rest <= 0) return step;  // the kick at the end time: as if the run went on
  if (std::abs(rest - step.dt) <= same_step * step.dt) return step;
  if (rest < step.dt) return {rest, {}, "end time", true};
  if (rest < 2 * step.dt * (1 - same_step)) return {0.5 * rest, {}, "end time", true};
  return step;
}

void ClockHand::advance(Clock& clock, double end) {
  const double y = clock.dt - carry_;
  const double t = clock.time + y;
  carry_ = (t - clock.time) - y;
  clock.time = t;
  if (std::abs(end - t) <= same_step * clock.dt) {
    clock.time = end;
    carry_ = 0;
  }
  clock.dt_previous = clock.dt;
  ++clock.cycle;
}

}  // namespace kardan

// Choice of the time step.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// A step and what sets it: an element or joint (`owner`), or one of Kardan's own rules, by name.
struct StepBound {
  double dt = std::numeric_limits<double>::infinity();
  TimeStepOwner owner;
  const char* rule = nullptr;  ///< "DTINIT", "LCTM", "rotation" … where no element sets it; static storage
  bool to_end = false;         ///< shortened so that the run ends at its end time
};
/// "shell 4711", "joint 3", "DTINIT": for the progress line.
std::string to_string(const StepBound& bound);

/// What the model allows, gathered before the first cycle.
struct StepFacts {
  bool deformable = false;    ///< something deforms: solids, shells, beams that are not rigid
  StepBound rigid_elements;   ///< Courant step of the elements of rigid parts (what an analyst expects to see)
  double rigid_default = 0;   ///< step of last resort
};

/// The rule of the time step, settled once for a run:
///   parts that deform:       dt = TSSFAC x the smallest stable step, DTINIT (if smaller) for the first one; a step is at
///                            most `largest_growth` times the one before; *CONTROL_TIMESTEP LCTM and --dt are caps;
///   nothing deforms:         the first of --dt, DTINIT, the curve LCTM, TSSFAC x Courant step of the rigid elements,
///                            1/20,000 of the end time; springs and fast rotations can only make it smaller.
/// The last steps are shortened so that the run ends exactly at the end time: a remainder of less than two steps is halved,
/// because a sliver of a step would make penalty joints, whose stiffness follows 1/dt^2, hit hard.
class TimeStepRule {
 public:
  static constexpr double largest_growth = 1.1;

  /// @param given step of the command line (--dt)
  /// @param end   time at which the run ends
  /// @param scale factor on the smallest stable step; 0 = TSSFAC
  TimeStepRule(const Model& model, const StepFacts& facts, std::optional<double> given, double end, double scale = 0);

  /// dt of the drift from clock.time on.
  /// @param stable the smallest stable step of elements and springs at t_n, without TSSFAC
  /// @param rotation bound from the rotation of bodies (full, no TSSFAC)
  StepBound next(const Model& model, const Clock& clock, const StepBound& stable, double rotation) const;

  /// One sentence for the log: which rule holds and why.
  const std::string& reason() const { return reason_; }
  /// True if the rule by itself gives the same step every cycle.
  bool constant() const { return kind_ == Kind::constant; }

 private:
  enum class Kind { courant, constant, curve };

  StepBound from_rule(const Model& model, const Clock& clock, const StepBound& stable) const;

  Kind kind_ = Kind::courant;
  StepBound constant_;
  double first_ = 0, scale_ = 0.9, cap_ = std::numeric_limits<double>::infinity(), end_ = 0;
  CurveIndex limit_ = none;
  std::string reason_;
};

/// Moves the clock one step on. Time is summed with a compensation (Kahan 1965), so that after n equal steps it is n dt
/// rounded once, and arrives at `end` exactly.
class ClockHand {
 public:
  void advance(Clock& clock, double end);
  /// What the sum has lost so far; part of the state of a run.
  double& carry() { return carry_; }

 private:
  double carry_ = 0;
};

}  // namespace kardan

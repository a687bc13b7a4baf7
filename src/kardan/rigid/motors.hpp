// Targets of motor joints: *CONSTRAINED_JOINT_ROTATIONAL_MOTOR and _TRANSLATIONAL_MOTOR.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/joint_set.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class Motors {
 public:
  /// Finds the motors among the joints; an error for a motor without a curve.
  void initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics);
  /// Rates of the driven rows at t = 0 into `rates` (JointSet::offset); the other entries stay.
  void initial_rates(const Model& model, const State& state, const JointSet& joints, std::vector<double>& rates) const;
  /// Sets the targets for the kick at t_n: the value at t_{n+1} (exact joints close on it) or at t_n (penalty).
  void aim(const Model& model, const State& state, JointSet& joints, bool at_end_of_step);
  /// After the kick: work of the motors, with the force of each row.
  void account(const JointSet& joints, const std::vector<double>& force, const Clock& clock);
  double work(const Clock& clock) const { return work_before_ + clock.share_before() * work_of_kick_; }
  void register_state(State& state);

 private:
  struct Motor {
    std::size_t joint;
    int row;
  };
  std::vector<Motor> motors_;
  std::vector<double> reached_;  ///< target at t_n of each motor driven by acceleration or by a curve of its way
  std::vector<double> rate_;     ///< rate of the target of motors driven by acceleration
  std::vector<double> rate_before_, rate_now_;  ///< of every target, at t_{n-1/2} and at t_n
  double work_before_ = 0, work_of_kick_ = 0;
};

}  // namespace kardan

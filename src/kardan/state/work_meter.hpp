// Work of forces over leapfrog kicks.
#pragma once

#include "kardan/state/state.hpp"

namespace kardan {

/// Sums the work of a force that acts during the kicks. The kick at t_n of length k changes the kinetic energy by exactly
/// k F . (v_{n-1/2} + v_{n+1/2})/2, and by dt_previous/2 F . (v_{n-1/2} + v_n)/2 up to t_n.
class WorkMeter {
 public:
  /// Power with the velocities before the kick, F . v_{n-1/2}.
  void before(double power) { before_ = power; }
  /// Power with the velocities after the kick. Closes the kick; returns the work up to t_n.
  double after(double power, const Clock& clock) {
    const double power_now = before_ + clock.share_before() * (power - before_);
    const double now = closed_ + 0.5 * (before_ + power_now) * 0.5 * clock.dt_previous;
    closed_ += 0.5 * (before_ + power) * clock.kick();
    return now;
  }

 private:
  double before_ = 0;
  double closed_ = 0;  ///< work of all kicks that are over
};

}  // namespace kardan

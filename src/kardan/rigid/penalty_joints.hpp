// Joints held by penalty, eq. (14) of the paper: f = K d / tau^2.
//
// Every row of a joint gets a spring and a damper against its residual C and its rate at t_n:
//   lambda = -(k C + c C'),   k = RPS beta / (dt^2 A_rr g_r),   c = 2 xi sqrt(k / A_rr),
// where 1 / A_rr is the row's effective mass (A = J W J^T) and g_r = sum_s |A_rs| / sqrt(A_rr A_ss) over all rows s that
// share a body with row r. By Gershgorin's theorem the largest eigenvalue of dt^2 K A is then at most beta RPS, whatever
// the masses, arms and number of joints on a body: the stability limit of central differences is 4, so beta = 1 keeps
// any deck stable at RPS = 1 with room for the damper (its force lags by half a step) and for the change of A between
// refreshes.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/rigid/block_cholesky.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/joint_set.hpp"

namespace kardan {

class PenaltyJoints {
 public:
  static constexpr double beta = 1.0;            ///< dt^2 times the largest eigenvalue of K A, at RPS = 1
  static constexpr double damping_ratio = 0.1;   ///< xi at DAMP = 1
  static constexpr int refresh_cycles = 20;      ///< cycles between new stiffnesses
  /// RPS above which the scheme would be unstable.
  static constexpr double largest_rps = 3.0;

  void initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics);

  /// The next apply() will need the mobilities of the bodies.
  bool refresh_due(double h) const { return age_ >= refresh_cycles || h != refreshed_dt_; }
  /// Adds the impulses of the springs and dampers to the trial momenta. Call after the Jacobians at t_n stand.
  void apply(const State& state, JointSet& joints, BodySet& bodies, double kick, double h);

  std::vector<double> force;               ///< of each row at t_n (JointSet::offset)
  std::vector<double> stored, dissipated;  ///< energy by joint: in the springs at t_n, in the dampers so far
  JointSeparation largest;                 ///< of all cycles so far

 private:
  void refresh(const JointSet& joints, const BodySet& bodies, double h);

  BlockCholesky matrix_;
  std::vector<double> stiffness_, damper_;   ///< by row
  std::vector<double> rps_, damp_;           ///< by joint
  std::vector<double> row_sum_;              ///< scratch
  double refreshed_dt_ = 0;
  int age_ = 0;
};

}  // namespace kardan

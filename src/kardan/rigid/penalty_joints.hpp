// Joints held by penalty, eq. (14) of the paper: f = K d / tau^2.
//
// Each joint consists of groups: its point part (three rows, one isotropic spring) and each of its scalar rows. A group gets
// a spring and a damper against its residual C and its rate at t_n:
//   lambda = -(k C + c C'),   k = RPS beta / (dt^2 a g),   c = 2 xi sqrt(k / a),
// where a is the largest eigenvalue of the group's diagonal block of A = J W J^T (1/a: its effective mass) and
// g = 1 + sum_h |A_gh| / sqrt(a_g a_h) over all groups h that share a body with group g (Frobenius norms: a and g do not
// depend on how the global axes lie). By Gershgorin's theorem the largest eigenvalue of dt^2 K A is then at most beta RPS,
// whatever the masses, arms and number of joints on a body: the stability limit of central differences is 4, so beta = 1
// keeps any deck stable at RPS = 1 with room for the damper, whose force lags by half a step.
// A changes as the mechanism moves. The stiffness is checked every `refresh_cycles` but changed only where the bound has
// moved far: a change of k under load is a jump of the force.
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
  static constexpr int refresh_cycles = 20;      ///< cycles between checks of the stiffnesses
  static constexpr double soften_at = 1.5;       ///< stiffness over its bound at which it is set back to the bound
  static constexpr double stiffen_at = 4.0;      ///< bound over stiffness at which it is raised to the bound
  /// RPS above which the scheme would be unstable.
  static constexpr double largest_rps = 3.0;

  void initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics);

  /// The next apply() will need the mobilities of the bodies.
  bool refresh_due(double h) const { return age_ >= refresh_cycles || h != refreshed_dt_; }
  /// Adds the impulses of the springs and dampers to the trial momenta. Call after the Jacobians at t_n stand.
  void apply(const State& state, JointSet& joints, BodySet& bodies, double kick, double h);

  void register_state(Registry& registry);

  std::vector<double> force;               ///< of each row at t_n (JointSet::offset)
  std::vector<double> stored, dissipated;  ///< energy by joint: in the springs at t_n, in the dampers so far
  JointSeparation largest;                 ///< of all cycles so far

 private:
  struct Group {                   ///< rows with one spring
    std::size_t first_row;         ///< JointSet::offset + row in the joint
    int row, size;                 ///< in the joint
  };
  void refresh(const JointSet& joints, const BodySet& bodies, double h);
  /// a of every group from the assembled matrix.
  void find_group_sizes(const JointSet& joints);
  /// g of every group.
  void find_group_sums(const JointSet& joints);

  BlockCholesky matrix_;
  std::vector<double> stiffness_, damper_;   ///< by row
  std::vector<double> rps_, damp_;           ///< by joint
  std::vector<Group> groups_;                ///< in the order of the rows
  std::vector<std::size_t> first_group_;     ///< by joint, and one past the last
  std::vector<double> inverse_mass_, sum_;   ///< a and g by group
  double refreshed_dt_ = 0;
  int age_ = 0;
};

}  // namespace kardan

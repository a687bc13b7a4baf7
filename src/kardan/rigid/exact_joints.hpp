// Joints held exactly: Lagrange multipliers on all joints together, at position level.
//
// With q the poses, v the velocities, W the inverse mass matrix and J the Jacobian of the constraints C(q) = 0 at t_n, the
// impulses lambda of the kick at t_n are those for which the poses they lead to satisfy the constraints:
//   v(n+1/2) = v(n-1/2) + W (kick F + J^T lambda),   q(n+1) = drift(q(n), v(n+1/2)),   C(q(n+1)) = 0.          (1)
// This is SHAKE (Ryckaert, Ciccotti and Berendsen 1977, J. Comput. Phys. 23, 327-341), which in leapfrog form is RATTLE
// (Andersen 1983, J. Comput. Phys. 52, 24-34; Hairer, Lubich and Wanner, "Geometric Numerical Integration", VII.1.3):
// second order, time-reversible, no drift of the constraints and none of the energy.
//
// (1) is solved by Newton's method with the matrix of t_n, A = J W J^T, factored once a cycle:
//   A dlambda = -C(q(n+1)) / h;  its error shrinks by about h|w| an iteration, so two or three reach rounding.
// Redundant constraints (a planar four-bar with four revolutes has three too many) make A singular. Rows whose pivot
// vanishes in a trial factorisation are left out of the solution; the other rows hold them. Their residual is watched all
// the same: where one opens - a mechanism that started in a singular position and has left it - the rows are chosen anew.
// In a passage through a singular position (a parallelogram that is flat) a row cannot be held for a step or two: it is left
// out there, its residual stays of third order in h, and the next cycle removes it.
// The multipliers of redundant rows are not unique; for the reports they are made so: of all that give the same motion, those of least
// weighted norm, so that two hinges of a door share its weight.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "kardan/rigid/block_cholesky.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/joint_set.hpp"

namespace kardan {

class ExactJoints {
 public:
  /// Residual accepted, relative to the size of the joint's mechanism: close to rounding, because an error C of the positions
  /// is an error C m / h^2 of the reactions.
  static constexpr double tolerance = 1e-14;
  /// Added to the diagonal of A, relative to it: keeps passages through singular positions finite.
  static constexpr double regularisation = 1e-12;
  /// A row whose pivot falls below this share of its diagonal entry is redundant.
  static constexpr double redundancy = 1e-10;

  void initialise(const JointSet& joints);

  void register_state(Registry& registry) { registry.keep_value({"joints.largest_gap", "length, angle", "rigid.kick"}, largest); }

  /// Finds the impulses of the kick and leaves the trial poses on the constraints. The trial momenta hold the kick of all
  /// other forces. @throws RunError naming the worst joint where the iteration does not converge.
  void solve(const Model& model, const State& state, JointSet& joints, BodySet& bodies, double kick, double h);

  /// Changes velocities (trial, at t = 0) so that J v = target rates.
  void project_velocities(const State& state, JointSet& joints, BodySet& bodies, const std::vector<double>& target_rates);

  /// Finds the redundant rows at the poses of t_n and takes them out. @return their joints, into JointSet::joints.
  std::vector<int> find_redundant_rows(JointSet& joints, const BodySet& bodies);

  /// Forces of the last kick that act the same, of least weighted norm (equal to `force` without redundant rows).
  std::vector<double> shared_forces(const JointSet& joints, const BodySet& bodies) const;

  std::vector<double> force;        ///< of each row at t_n (JointSet::offset): impulse over the length of the kick
  JointSeparation largest;          ///< of all cycles so far

 private:
  [[noreturn]] void fail(const Model& model, const State& state, const JointSet& joints) const;
  /// Applies the forces of the cycle before as a first guess.
  void guess(const JointSet& joints, BodySet& bodies, double kick);
  /// Newton's iteration with the factored matrix; false where it does not converge.
  bool close(const State& state, JointSet& joints, BodySet& bodies, double h, int iteration_limit);
  /// Residuals at the trial poses into correction_; returns the largest relative to the mechanism's size, and its joint.
  std::pair<double, std::size_t> residuals(const JointSet& joints, const BodySet& bodies, double h);
  void factor(const JointSet& joints, const BodySet& bodies);
  /// One Newton correction from the residuals in correction_.
  void close_step(const JointSet& joints, BodySet& bodies, double h);

  BlockCholesky matrix_;
  std::vector<double> correction_, impulse_;
  std::vector<std::uint8_t> skipped_;  ///< by row: left out of this cycle only
  bool passing_singularity_ = false;
  double worst_ = 0;                ///< largest relative residual of the rows that are held
  std::size_t worst_joint_ = 0;
  double worst_inactive_ = 0;       ///< of those left out
};

}  // namespace kardan

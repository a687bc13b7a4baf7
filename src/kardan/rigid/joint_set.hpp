// All joints of a run: what they are made of, their Jacobians at t_n, and the matrix A = J W J^T that couples them.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/rigid/block_cholesky.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/joint_parts.hpp"

namespace kardan {

/// One joint between two bodies: a point part (three rows) or none, then scalar rows; at most six rows together.
struct JointRuntime {
  BodyIndex a = none, b = none;
  bool has_point = false;
  Vec3 arm_a, arm_b;                  ///< to the joint's points, principal axes
  int first_row = 0, row_count = 0;   ///< scalar rows, into JointSet::rows and memory
  int size = 0;                       ///< rows of the joint: 3 if has_point, plus row_count
  double length = 0;                  ///< size of the mechanism the joint belongs to: scale of its residual
  Index model_joint = none;           ///< into Model::joints

  int point_rows() const { return has_point ? 3 : 0; }
};

/// Jacobian of a scalar row at t_n.
struct RowJacobian {
  JacobianSide a, b;
};

/// Arms of a joint's point part at t_n, global components: its three rows are e_i on B at arm b and -e_i on A at arm a.
struct PointArms {
  Vec3 a, b;
};

/// Running maximum of how far joints have come apart.
struct JointSeparation {
  double distance = 0, angle = 0;
  Index joint = none;   ///< into Model::joints, of the largest distance

  void consider(double d, double a, Index which) {
    if (d > distance || joint == none) joint = which;
    distance = d > distance ? d : distance;
    angle = a > angle ? a : angle;
  }
};

class JointSet {
 public:
  std::vector<JointRuntime> joints;
  std::vector<ConstraintRow> rows;
  std::vector<RowMemory> memory;      ///< by row
  std::vector<std::uint8_t> failed;   ///< by joint: holds nothing any more
  std::vector<RowJacobian> jacobian;  ///< by row
  std::vector<PointArms> arms;        ///< by joint
  std::vector<std::size_t> offset;    ///< first entry of each joint in arrays over all rows (forces, impulses, residuals)
  std::size_t total_rows = 0;
  std::vector<std::uint8_t> inactive; ///< by row: redundant, held by the other rows

  /// Fixes the pattern of A once joints and rows stand.
  void analyse(const BodySet& bodies);
  void register_state(Registry& registry);
  /// Jacobians from the poses at t_n.
  void linearise(const State& state, const BodySet& bodies);
  /// A = J W J^T + regularisation x the diagonal A would have if the bodies were free.
  void assemble(const BodySet& bodies, double regularisation, BlockCholesky& matrix) const;
  /// A x = J W J^T x for forces x of all rows.
  std::vector<double> times_matrix(const BodySet& bodies, const std::vector<double>& x) const;
  /// Marks the rows that depend on the others: (joint, row in the joint).
  void set_inactive(const std::vector<std::pair<int, int>>& joint_rows);
  bool has_redundant_rows() const { return !inactive_rows_.empty(); }
  /// Takes the inactive rows out of an assembled matrix: their solution is what stands in the right-hand side.
  void deactivate_rows(BlockCholesky& matrix) const;
  /// The same pattern for `matrix`.
  void prepare(BlockCholesky& matrix) const { matrix.analyse(sizes_, pairs_); }

  /// C of joint j at the trial poses (t_{n+1}); `c` has joints[j].size entries.
  void residual_at_trial(const BodySet& bodies, std::size_t j, double h, double* c) const;
  /// C of joint j at t_n.
  void residual_now(const State& state, const BodySet& bodies, std::size_t j, double* c) const;
  /// J v for given velocities of both bodies.
  void rates(std::size_t j, const Vec3& velocity_a, const Vec3& omega_a, const Vec3& velocity_b, const Vec3& omega_b,
             double* c) const;
  /// Applies the impulses J^T lambda to the trial momenta of both bodies.
  void apply(std::size_t j, const double* lambda, BodySet& bodies) const;
  /// Resultant of lambda on body B: force, and moment about the joint's point on B.
  std::pair<Vec3, Vec3> resultant(const BodySet& bodies, std::size_t j, const double* lambda) const;
  /// 1 for rows measured as a length, `length` for rows measured as an angle.
  double row_scale(std::size_t j, int row) const;
  /// Distance and angle by which a residual misses zero.
  std::pair<double, double> separation(std::size_t j, const double* c) const;
  /// Sums the rotations of coupled rows over the step to the trial poses; motion holds the velocities at t_{n+1/2}.
  void remember_step(const State& state, const BodySet& bodies, double h);

 private:
  double row_residual(const JointRuntime& joint, const ConstraintRow& row, const RowMemory& m, const Pose& a,
                      const Pose& b, double turned_a, double turned_b) const;

  /// Rows of one side of a joint, the point's first; @return their number.
  int side_rows(int joint, bool side_b, std::array<JacobianSide, 6>& out) const;

  struct CouplingTerm {  ///< adds J_row W_body J_column^T to a pair's block
    std::size_t pair;
    BodyIndex body;
    int first, second;             ///< joints of the pair
    bool first_on_b, second_on_b;  ///< which side of each the body is
  };
  std::vector<int> sizes_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<CouplingTerm> terms_;
  std::vector<std::pair<int, int>> inactive_rows_;
  std::vector<std::uint8_t> inactive_joints_;
};

/// Makes the runtime joint of a deck's joint: the recipes. Points 1, 3, 5 (A) and 2, 4, 6 (B) in global coordinates at
/// t = 0; points a recipe does not use are ignored. Messages about geometry go to `diagnostics`.
void append_joint(const Joint& joint, Index model_joint, BodyIndex a, BodyIndex b, const std::array<Vec3, 6>& points,
                  const State& state, JointSet& set, Diagnostics& diagnostics);

}  // namespace kardan

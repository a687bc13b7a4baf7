#include "kardan/rigid/exact_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kardan {

void ExactJoints::initialise(const JointSet& joints) {
  joints.prepare(matrix_);
  for (auto* by_row : {&force, &impulse_, &correction_}) by_row->assign(joints.total_rows, 0.0);
  skipped_.assign(joints.total_rows, 0);
}

void ExactJoints::fail(const Model& model, const State& state, const JointSet& joints) const {
  const JointRuntime& runtime = joints.joints[worst_joint_];
  const Joint& joint = model.joints[runtime.model_joint];
  const Vec3& x = state.bodies.motion[runtime.a].center;
  throw RunError(fmt::format("joint {} ({}) between bodies {} and {} cannot be closed at t = {:.6g}: residual {:.3g} of the "
                             "mechanism's size; body {} is at ({:.6g}, {:.6g}, {:.6g}). The time step {:.3g} is too long for the "
                             "speed of the mechanism, or the constraints contradict each other",
                             joint.id, to_string(joint.kind), state.bodies.info[runtime.a].id,
                             state.bodies.info[runtime.b].id, state.clock.time, worst_, state.bodies.info[runtime.a].id, x.x,
                             x.y, x.z, state.clock.dt));
}

std::pair<double, std::size_t> ExactJoints::residuals(const JointSet& joints, const BodySet& bodies, double h) {
  double worst = 0;
  std::size_t worst_joint = 0;
  worst_inactive_ = 0;
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    double* const c = correction_.data() + joints.offset[j];
    if (joints.failed[j]) {
      std::fill_n(c, joints.joints[j].size, 0.0);
      continue;
    }
    joints.residual_at_trial(bodies, j, h, c);
    for (int r = 0; r < joints.joints[j].size; ++r) {
      const double relative = std::abs(c[r]) * joints.row_scale(j, r) / joints.joints[j].length;
      if (joints.inactive[joints.offset[j] + r] || skipped_[joints.offset[j] + r]) {
        worst_inactive_ = std::max(worst_inactive_, relative);
        c[r] = 0;
        continue;
      }
      if (!(relative <= worst)) {
        worst = relative;
        worst_joint = j;
      }
    }
  }
  return {worst, worst_joint};
}

void ExactJoints::factor(const JointSet& joints, const BodySet& bodies) {
  joints.assemble(bodies, regularisation, matrix_);
  joints.deactivate_rows(matrix_);
  matrix_.factor();
}

void ExactJoints::close_step(const JointSet& joints, BodySet& bodies, double h) {
  for (double& c : correction_) c *= -1.0 / h;
  matrix_.solve(correction_.data());
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const std::size_t first = joints.offset[j];
    for (int r = 0; r < joints.joints[j].size; ++r) impulse_[first + r] += correction_[first + r];
    joints.apply(j, correction_.data() + first, bodies);
  }
}

bool ExactJoints::close(const State& state, JointSet& joints, BodySet& bodies, double h, int iteration_limit) {
  constexpr double reopened = 1e-11;
  bool chosen_anew = false;
  double previous = 1e300;
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    for (std::size_t b = 0; b < bodies.size(); ++b) bodies.advance(state, b, h);
    std::tie(worst_, worst_joint_) = residuals(joints, bodies, h);
    if (!std::isfinite(worst_)) return false;
    // Done at the tolerance, or where rounding (coordinates far from the origin) lets it go no further.
    if (worst_ <= tolerance || (worst_ < 1e-11 && worst_ > 0.2 * previous)) {
      if (worst_inactive_ <= reopened || chosen_anew || passing_singularity_) return true;
      chosen_anew = true;
      find_redundant_rows(joints, bodies);
      factor(joints, bodies);
      worst_ = 1e300;
      residuals(joints, bodies, h);
    }
    previous = worst_;
    close_step(joints, bodies, h);
  }
  return false;
}

void ExactJoints::guess(const JointSet& joints, BodySet& bodies, double kick) {
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const std::size_t first = joints.offset[j];
    for (int r = 0; r < joints.joints[j].size; ++r)
      impulse_[first + r] = joints.failed[j] || skipped_[first + r] ? 0.0 : force[first + r] * kick;
    joints.apply(j, impulse_.data() + first, bodies);
  }
}

void ExactJoints::solve(const Model& model, const State& state, JointSet& joints, BodySet& bodies, double kick, double h) {
  factor(joints, bodies);
  guess(joints, bodies, kick);
  passing_singularity_ = false;
  bool closed = close(state, joints, bodies, h, 30);
  // Near a singular position the direction of some row turns round within the step, and no impulse along it does any good:
  // the motion carries the mechanism through. Rows with small pivots are left out of this cycle, as few as possible.
  for (double threshold = 1e-9; !closed && threshold < 0.02; threshold *= 30) {
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
      for (int r = 0; r < joints.joints[j].size; ++r) impulse_[joints.offset[j] + r] *= -1.0;
      joints.apply(j, impulse_.data() + joints.offset[j], bodies);
    }
    joints.assemble(bodies, regularisation, matrix_);
    joints.deactivate_rows(matrix_);
    matrix_.factor(threshold);
    std::fill(skipped_.begin(), skipped_.end(), std::uint8_t{0});
    for (const auto& [joint, row] : matrix_.dropped()) skipped_[joints.offset[joint] + row] = 1;
    passing_singularity_ = true;
    guess(joints, bodies, kick);
    closed = close(state, joints, bodies, h, 30) && worst_inactive_ < 1e-4;
  }
  if (!closed) fail(model, state, joints);
  if (passing_singularity_) std::fill(skipped_.begin(), skipped_.end(), std::uint8_t{0});
  largest.consider(std::max(worst_, worst_inactive_) * joints.joints[worst_joint_].length, 0.0,
                   joints.joints[worst_joint_].model_joint);
  for (std::size_t r = 0; r < force.size(); ++r) force[r] = impulse_[r] / kick;
}

void ExactJoints::project_velocities(const State& state, JointSet& joints, BodySet& bodies,
                                     const std::vector<double>& target_rates) {
  joints.linearise(state, bodies);
  factor(joints, bodies);
  std::vector<Vec3> velocity(bodies.size()), omega(bodies.size());
  // The regularisation leaves a rest of its own size: a few repetitions remove it.
  for (int repetition = 0; repetition < 4; ++repetition) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      bodies.advance(state, b, 0.0);
      velocity[b] = bodies.trial[b].constrained_velocity;
      omega[b] = bodies.trial[b].angular_velocity;
    }
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
      const JointRuntime& joint = joints.joints[j];
      double* const c = correction_.data() + joints.offset[j];
      joints.rates(j, velocity[joint.a], omega[joint.a], velocity[joint.b], omega[joint.b], c);
      for (int r = 0; r < joint.size; ++r) {
        const std::size_t row = joints.offset[j] + r;
        c[r] = joints.inactive[row] ? 0.0 : target_rates[row] - c[r];
      }
    }
    matrix_.solve(correction_.data());
    for (std::size_t j = 0; j < joints.joints.size(); ++j) joints.apply(j, correction_.data() + joints.offset[j], bodies);
  }
}

std::vector<int> ExactJoints::find_redundant_rows(JointSet& joints, const BodySet& bodies) {
  joints.assemble(bodies, 0.0, matrix_);
  matrix_.factor(redundancy);
  joints.set_inactive(matrix_.dropped());
  std::vector<int> result;
  for (const auto& [block, row] : matrix_.dropped()) result.push_back(block);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<double> ExactJoints::shared_forces(const JointSet& joints, const BodySet& bodies) const {
  if (!joints.has_redundant_rows()) return force;
  // Least weighted norm of all x with A x = A force: (A + e D) x = A force, where the small e leaves the null space empty.
  constexpr double e = 1e-7;
  BlockCholesky matrix;
  joints.prepare(matrix);
  const auto times_a = [&](const std::vector<double>& x) { return joints.times_matrix(bodies, x); };
  const std::vector<double> right = times_a(force);
  joints.assemble(bodies, e, matrix);
  matrix.factor();
  std::vector<double> x(force.size(), 0.0);
  for (int refinement = 0; refinement < 4; ++refinement) {
    std::vector<double> rest = times_a(x);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = right[i] - rest[i];
    matrix.solve(rest.data());
    for (std::size_t i = 0; i < rest.size(); ++i) x[i] += rest[i];
  }
  return x;
}

}  // namespace kardan

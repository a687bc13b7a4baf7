#include "kardan/rigid/penalty_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kardan {

void PenaltyJoints::initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics) {
  joints.prepare(matrix_);
  for (auto* by_row : {&force, &stiffness_, &damper_, &row_sum_}) by_row->assign(matrix_.rows(), 0.0);
  stored.assign(joints.joints.size(), 0.0);
  dissipated.assign(joints.joints.size(), 0.0);
  rps_.clear();
  damp_.clear();
  for (const JointRuntime& joint : joints.joints) {
    const Joint& deck = model.joints[joint.model_joint];
    if (deck.rps > largest_rps)
      diagnostics.warning(fmt::format("joint {}: relative penalty stiffness RPS = {:.4g} would be unstable at this time step; {:.4g} "
                                      "is used", deck.id, deck.rps, largest_rps),
                          "shorten the time step, or hold the joints exactly (--joints exact)", "*CONSTRAINED_JOINT");
    rps_.push_back(std::min(deck.rps > 0 ? deck.rps : 1.0, largest_rps));
    // 0 < DAMP <= 0.01 switches damping off; joints that do not take DAMP carry 0, which means the default here.
    damp_.push_back(deck.damp > 0 && deck.damp <= 0.01 ? 0.0 : deck.damp > 0 ? std::min(deck.damp, 3.0) : 1.0);
  }
}

void PenaltyJoints::refresh(const JointSet& joints, const BodySet& bodies, double h) {
  joints.assemble(bodies, 0.0, matrix_);
  const auto diagonal = [&](std::size_t j, int r) {
    return matrix_.diagonal(static_cast<int>(j))[r * (joints.joints[j].size + 1)];
  };
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const int m = joints.joints[j].size;
    const double* const d = matrix_.diagonal(static_cast<int>(j));
    for (int r = 0; r < m; ++r) {
      double sum = 0;
      for (int c = 0; c < m; ++c) {
        const double a = c < r ? d[r * m + c] : d[c * m + r];
        const double scale = diagonal(j, r) * diagonal(j, c);
        if (scale > 0) sum += std::abs(a) / std::sqrt(scale);
      }
      row_sum_[joints.offset[j] + r] = sum;
    }
  }
  for (std::size_t p = 0; p < matrix_.coupling_count(); ++p) {
    const BlockCholesky::Coupling& place = matrix_.coupling(p);
    const auto row_joint = static_cast<std::size_t>(place.row_block), column_joint = static_cast<std::size_t>(place.column_block);
    const int rows = joints.joints[row_joint].size, columns = joints.joints[column_joint].size;
    const double* const v = matrix_.values(place);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const double scale = diagonal(row_joint, r) * diagonal(column_joint, c);
        if (!(scale > 0)) continue;
        const double share = std::abs(v[r * columns + c]) / std::sqrt(scale);
        row_sum_[joints.offset[row_joint] + r] += share;
        row_sum_[joints.offset[column_joint] + c] += share;
      }
  }
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const JointRuntime& joint = joints.joints[j];
    for (int r = 0; r < joint.size; ++r) {
      const std::size_t row = joints.offset[j] + r;
      const double a = diagonal(j, r);
      stiffness_[row] = a > 0 ? rps_[j] * beta / (h * h * a * row_sum_[row]) : 0.0;
    }
    // The point's spring is the same in every direction: the softest of its three rows.
    if (joint.has_point) {
      const std::size_t first = joints.offset[j];
      double k = 1e300;
      for (int r = 0; r < 3; ++r)
        if (stiffness_[first + r] > 0) k = std::min(k, stiffness_[first + r]);
      for (int r = 0; r < 3; ++r) stiffness_[first + r] = k < 1e300 ? k : 0.0;
    }
    for (int r = 0; r < joint.size; ++r) {
      const double a = diagonal(j, r);
      damper_[joints.offset[j] + r] = a > 0 ? 2.0 * damping_ratio * damp_[j] * std::sqrt(stiffness_[joints.offset[j] + r] / a) : 0.0;
    }
  }
  refreshed_dt_ = h;
  age_ = 0;
}

void PenaltyJoints::apply(const State& state, JointSet& joints, BodySet& bodies, double kick, double h) {
  if (refresh_due(h)) refresh(joints, bodies, h);
  ++age_;
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const JointRuntime& joint = joints.joints[j];
    double* const lambda = force.data() + joints.offset[j];
    if (joints.failed[j]) {
      std::fill_n(lambda, joint.size, 0.0);
      continue;
    }
    double c[6], rate[6], impulse[6];
    joints.residual_now(state, bodies, j, c);
    const BodyMotion &a = state.bodies.motion[joint.a], &b = state.bodies.motion[joint.b];
    joints.rates(j, a.velocity, a.angular_velocity, b.velocity, b.angular_velocity, rate);
    for (int r = joint.point_rows(); r < joint.size; ++r)
      rate[r] -= joints.memory[joint.first_row + r - joint.point_rows()].target_rate;
    double energy = 0;
    for (int r = 0; r < joint.size; ++r) {
      const std::size_t row = joints.offset[j] + r;
      lambda[r] = -(stiffness_[row] * c[r] + damper_[row] * rate[r]);
      impulse[r] = lambda[r] * kick;
      energy += 0.5 * stiffness_[row] * c[r] * c[r];
      dissipated[j] += damper_[row] * rate[r] * rate[r] * kick;
    }
    stored[j] = energy;
    const auto [distance, angle] = joints.separation(j, c);
    largest.consider(distance, angle, joint.model_joint);
    joints.apply(j, impulse, bodies);
  }
}

}  // namespace kardan

#include "kardan/rigid/penalty_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kardan {

void PenaltyJoints::initialise(const Model& model, const JointSet& joints, Diagnostics& diagnostics) {
  joints.prepare(matrix_);
  for (auto* by_row : {&force, &stiffness_, &damper_}) by_row->assign(matrix_.rows(), 0.0);
  stored.assign(joints.joints.size(), 0.0);
  dissipated.assign(joints.joints.size(), 0.0);
  rps_.clear();
  damp_.clear();
  groups_.clear();
  first_group_.clear();
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    first_group_.push_back(groups_.size());
    const JointRuntime& joint = joints.joints[j];
    if (joint.has_point) groups_.push_back({joints.offset[j], 0, 3});
    for (int r = joint.point_rows(); r < joint.size; ++r) groups_.push_back({joints.offset[j] + r, r, 1});
  }
  first_group_.push_back(groups_.size());
  inverse_mass_.assign(groups_.size(), 0.0);
  sum_.assign(groups_.size(), 0.0);
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

void PenaltyJoints::register_state(Registry& registry) {
  registry.add({"joints.penalty_stiffness", "force/length", "rigid.kick"}, stiffness_);
  registry.add({"joints.penalty_dissipated", "energy", "rigid.kick"}, dissipated);
  registry.keep({"joints.penalty_damper", "force*time/length", "rigid.kick"}, damper_);
  registry.keep_value({"joints.penalty_dt", "time", "rigid.kick"}, refreshed_dt_);
  registry.keep_value({"joints.penalty_age", "1", "rigid.kick"}, age_);
  registry.keep_value({"joints.penalty_largest_gap", "length, angle", "rigid.kick"}, largest);
}

void PenaltyJoints::find_group_sizes(const JointSet& joints) {
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const int m = joints.joints[j].size;
    const double* const d = matrix_.diagonal(static_cast<int>(j));
    for (std::size_t g = first_group_[j]; g < first_group_[j + 1]; ++g) {
      if (groups_[g].size == 1) {
        inverse_mass_[g] = d[groups_[g].row * (m + 1)];
        continue;
      }
      Mat3 block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c <= r; ++c) block[r][c] = block[c][r] = d[r * m + c];
      inverse_mass_[g] = principal_axes(block).values.z;
    }
  }
}

void PenaltyJoints::find_group_sums(const JointSet& joints) {
  std::fill(sum_.begin(), sum_.end(), 1.0);
  // Adds |A_gh| / sqrt(a_g a_h) to both groups; entry(r, c) is the matrix entry at their rows.
  const auto couple = [&](std::size_t g, std::size_t h, const auto& entry) {
    if (!(inverse_mass_[g] > 0 && inverse_mass_[h] > 0)) return;
    double squares = 0;
    for (int r = groups_[g].row; r < groups_[g].row + groups_[g].size; ++r)
      for (int c = groups_[h].row; c < groups_[h].row + groups_[h].size; ++c) squares += entry(r, c) * entry(r, c);
    const double share = std::sqrt(squares / (inverse_mass_[g] * inverse_mass_[h]));
    sum_[g] += share;
    sum_[h] += share;
  };
  for (std::size_t j = 0; j < joints.joints.size(); ++j) {
    const int m = joints.joints[j].size;
    const double* const d = matrix_.diagonal(static_cast<int>(j));
    for (std::size_t g = first_group_[j]; g < first_group_[j + 1]; ++g)
      for (std::size_t h = first_group_[j]; h < g; ++h) couple(g, h, [&](int r, int c) { return d[r * m + c]; });
  }
  for (std::size_t p = 0; p < matrix_.coupling_count(); ++p) {
    const BlockCholesky::Coupling& place = matrix_.coupling(p);
    const int columns = joints.joints[place.column_block].size;
    const double* const v = matrix_.values(place);
    for (std::size_t g = first_group_[place.row_block]; g < first_group_[place.row_block + 1]; ++g)
      for (std::size_t h = first_group_[place.column_block]; h < first_group_[place.column_block + 1]; ++h)
        couple(g, h, [&](int r, int c) { return v[r * columns + c]; });
  }
}

void PenaltyJoints::refresh(const JointSet& joints, const BodySet& bodies, double h) {
  joints.assemble(bodies, 0.0, matrix_);
  find_group_sizes(joints);
  find_group_sums(joints);
  const bool anew = h != refreshed_dt_;
  for (std::size_t j = 0; j < joints.joints.size(); ++j)
    for (std::size_t g = first_group_[j]; g < first_group_[j + 1]; ++g) {
      const double a = inverse_mass_[g];
      const double bound = a > 0 ? rps_[j] * beta / (h * h * a * sum_[g]) : 0.0;
      const double k = stiffness_[groups_[g].first_row];
      if (!anew && k <= soften_at * bound && bound <= stiffen_at * k) continue;
      const double c = a > 0 ? 2.0 * damping_ratio * damp_[j] * std::sqrt(bound / a) : 0.0;
      for (int r = 0; r < groups_[g].size; ++r) {
        stiffness_[groups_[g].first_row + r] = bound;
        damper_[groups_[g].first_row + r] = c;
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

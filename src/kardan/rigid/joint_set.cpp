#include "kardan/rigid/joint_set.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace kardan {

namespace {

constexpr std::array<Vec3, 3> global_axis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Pose pose_now(const State& state, const BodySet& bodies, BodyIndex b) {
  const auto i = static_cast<std::size_t>(b);
  const BodyMotion& m = state.bodies.motion[i];
  return {m.center, &bodies.rotation[i], &m.orientation};
}

Pose pose_trial(const BodySet& bodies, BodyIndex b) {
  const BodyTrial& t = bodies.trial[static_cast<std::size_t>(b)];
  return {t.center, &t.rotation, &t.orientation};
}

Vec3 separation_vector(const JointRuntime& joint, const Pose& a, const Pose& b) {
  return (b.center - a.center) + (*b.rotation * joint.arm_b - *a.rotation * joint.arm_a);
}

/// Jacobian of one scalar row at the poses a, b.
std::pair<JacobianSide, JacobianSide> row_jacobian(const JointRuntime& joint, const ConstraintRow& row, const Pose& a,
                                                   const Pose& b) {
  using Kind = ConstraintRow::Kind;
  const Vec3 axis_a = *a.rotation * row.axis_a, axis_b = *b.rotation * row.axis_b;
  switch (row.kind) {
    case Kind::axis_axis: {
      const Vec3 n = cross(axis_b, axis_a);
      return {{{}, -n}, {{}, n}};
    }
    case Kind::axis_axis_pair: {
      const Vec3 n = cross(axis_b, axis_a) - cross(*b.rotation * row.axis_b2, *a.rotation * row.axis_a2);
      return {{{}, -n}, {{}, n}};
    }
    case Kind::axis_separation: {
      const Vec3 arm_a = *a.rotation * joint.arm_a, arm_b = *b.rotation * joint.arm_b;
      const Vec3 d = separation_vector(joint, a, b);
      return {{-axis_a, -cross(arm_a + d, axis_a)}, {axis_a, cross(arm_b, axis_a)}};
    }
    case Kind::twist:
      return {{{}, -axis_a}, {{}, axis_a}};
    case Kind::coupling: {
      JacobianSide on_a{{}, axis_a * row.k_a}, on_b{{}, (row.k_d != 0 ? axis_a : axis_b) * row.k_b};
      if (row.k_d != 0) {
        const Vec3 arm_a = *a.rotation * joint.arm_a, arm_b = *b.rotation * joint.arm_b;
        const Vec3 d = separation_vector(joint, a, b);
        on_a.linear -= axis_b * row.k_d;
        on_a.angular -= cross(arm_a, axis_b) * row.k_d;
        on_b.linear += axis_b * row.k_d;
        on_b.angular += cross(arm_b - d, axis_b) * row.k_d;
      }
      return {on_a, on_b};
    }
  }
  return {};
}

/// Rotations of A and B that a coupling counts in the step to the trial poses.
std::pair<double, double> step_rotations(const BodySet& bodies, const JointRuntime& joint, const ConstraintRow& row,
                                         const Vec3& omega_a, const Vec3& omega_b, double h) {
  const Vec3 axis_a = bodies.rotation[joint.a] * row.axis_a;
  // B about the axis of A: the mean of the axis before and after the step, so that the step can be taken back.
  const Vec3 axis_b = row.k_d != 0 ? 0.5 * (axis_a + bodies.trial[joint.a].rotation * row.axis_a)
                                   : bodies.rotation[joint.b] * row.axis_b;
  return {rotation_about(omega_a, axis_a, h), rotation_about(omega_b, axis_b, h)};
}

double product(const JacobianSide& row, const Vec3& linear, const Vec3& angular) {
  return dot(row.linear, linear) + dot(row.angular, angular);
}

}  // namespace

void JointSet::analyse(const BodySet& bodies) {
  sizes_.clear();
  offset.clear();
  total_rows = 0;
  pairs_.clear();
  terms_.clear();
  std::vector<std::vector<int>> joints_of(bodies.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    sizes_.push_back(joints[j].size);
    offset.push_back(total_rows);
    total_rows += static_cast<std::size_t>(joints[j].size);
    joints_of[joints[j].a].push_back(static_cast<int>(j));
    joints_of[joints[j].b].push_back(static_cast<int>(j));
  }
  std::map<std::pair<int, int>, std::size_t> pair_index;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies.fixed(body)) continue;
    const auto& list = joints_of[body];
    for (std::size_t s = 0; s < list.size(); ++s)
      for (std::size_t t = 0; t < s; ++t) {
        const std::pair<int, int> key{list[s], list[t]};
        const auto [it, is_new] = pair_index.try_emplace(key, pairs_.size());
        if (is_new) pairs_.push_back(key);
        const auto on_b = [&](int joint) { return joints[joint].b == static_cast<BodyIndex>(body); };
        terms_.push_back({it->second, static_cast<BodyIndex>(body), key.first, key.second, on_b(key.first), on_b(key.second)});
      }
  }
  jacobian.assign(rows.size(), {});
  arms.assign(joints.size(), {});
  failed.resize(joints.size(), 0);
  memory.resize(rows.size());
  inactive.assign(total_rows, 0);
}

void JointSet::register_state(Registry& registry) {
  registry.add({"joints.memory", "mixed", "rigid.drift"}, memory);
  registry.add({"joints.failed", "1", "rigid.kick"}, failed);
  registry.keep({"joints.jacobian", "1, length", "rigid.kick"}, jacobian);
  registry.keep({"joints.arms", "length", "rigid.kick"}, arms);
  registry.keep({"joints.inactive_rows", "1", "rigid.kick"}, inactive);
  registry.after_restore([this] {
    std::vector<std::pair<int, int>> rows_left_out;
    for (std::size_t j = 0; j < joints.size(); ++j)
      for (int r = 0; r < joints[j].size; ++r)
        if (inactive[offset[j] + static_cast<std::size_t>(r)]) rows_left_out.emplace_back(static_cast<int>(j), r);
    set_inactive(rows_left_out);
  });
}

void JointSet::linearise(const State& state, const BodySet& bodies) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointRuntime& joint = joints[j];
    const Pose a = pose_now(state, bodies, joint.a), b = pose_now(state, bodies, joint.b);
    if (joint.has_point) {
      // Arms to the middle of the two points: where a penalty joint gives way, the forces on A and B still act in one line.
      const Vec3 arm_a = *a.rotation * joint.arm_a, arm_b = *b.rotation * joint.arm_b;
      const Vec3 half = ((b.center - a.center) + (arm_b - arm_a)) * 0.5;
      arms[j] = {arm_a + half, arm_b - half};
    }
    for (int r = joint.first_row; r < joint.first_row + joint.row_count; ++r)
      std::tie(jacobian[r].a, jacobian[r].b) = row_jacobian(joint, rows[r], a, b);
  }
}

int JointSet::side_rows(int joint, bool side_b, std::array<JacobianSide, 6>& out) const {
  const JointRuntime& runtime = joints[joint];
  int n = 0;
  if (runtime.has_point) {
    const double sign = side_b ? 1.0 : -1.0;
    const Vec3& arm = side_b ? arms[joint].b : arms[joint].a;
    for (const Vec3& e : global_axis) out[n++] = {e * sign, cross(arm, e) * sign};
  }
  for (int r = runtime.first_row; r < runtime.first_row + runtime.row_count; ++r)
    out[n++] = side_b ? jacobian[r].b : jacobian[r].a;
  return n;
}

void JointSet::assemble(const BodySet& bodies, double regularisation, BlockCholesky& matrix) const {
  matrix.clear();
  std::array<JacobianSide, 6> row_side, column_side;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointRuntime& joint = joints[j];
    const int m = joint.size;
    double* const d = matrix.diagonal(static_cast<int>(j));
    if (failed[j]) {
      for (int r = 0; r < m; ++r) d[r * m + r] = 1.0;
      continue;
    }
    for (const bool side_b : {false, true}) {
      const auto body = static_cast<std::size_t>(side_b ? joint.b : joint.a);
      side_rows(static_cast<int>(j), side_b, row_side);
      for (int c = 0; c < m; ++c) {
        const Vec3 linear = bodies.linear_response(body, row_side[c].linear);
        const Vec3 angular = bodies.angular_response(body, row_side[c].angular);
        for (int r = c; r < m; ++r) d[r * m + c] += product(row_side[r], linear, angular);
        if (regularisation > 0) d[c * m + c] += regularisation * bodies.free_response(body, row_side[c]);
      }
    }
  }
  for (const CouplingTerm& term : terms_) {
    if (failed[term.first] || failed[term.second]) continue;
    const auto body = static_cast<std::size_t>(term.body);
    const BlockCholesky::Coupling& place = matrix.coupling(term.pair);
    const bool first_is_row = place.row_block == term.first;
    const int row_size = side_rows(place.row_block, first_is_row ? term.first_on_b : term.second_on_b, row_side);
    const int columns = side_rows(place.column_block, first_is_row ? term.second_on_b : term.first_on_b, column_side);
    double* const v = matrix.values(place);
    for (int c = 0; c < columns; ++c) {
      const Vec3 linear = bodies.linear_response(body, column_side[c].linear);
      const Vec3 angular = bodies.angular_response(body, column_side[c].angular);
      for (int r = 0; r < row_size; ++r) v[r * columns + c] += product(row_side[r], linear, angular);
    }
  }
}

std::vector<double> JointSet::times_matrix(const BodySet& bodies, const std::vector<double>& x) const {
  std::vector<Vec3> linear(bodies.size()), angular(bodies.size());
  std::array<JacobianSide, 6> side;
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (const bool side_b : {false, true}) {
      const BodyIndex body = side_b ? joints[j].b : joints[j].a;
      const int count = side_rows(static_cast<int>(j), side_b, side);
      for (int r = 0; r < count; ++r) {
        linear[body] += side[r].linear * x[offset[j] + r];
        angular[body] += side[r].angular * x[offset[j] + r];
      }
    }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    linear[b] = bodies.linear_response(b, linear[b]);
    angular[b] = bodies.angular_response(b, angular[b]);
  }
  std::vector<double> y(x.size(), 0.0);
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (!failed[j]) rates(j, linear[joints[j].a], angular[joints[j].a], linear[joints[j].b], angular[joints[j].b], y.data() + offset[j]);
  return y;
}

void JointSet::deactivate_rows(BlockCholesky& matrix) const {
  if (inactive_joints_.empty()) return;
  for (const auto& [joint, row] : inactive_rows_) {
    const int m = joints[joint].size;
    double* const d = matrix.diagonal(joint);
    for (int i = 0; i < m; ++i) d[row * m + i] = d[i * m + row] = 0.0;
    d[row * m + row] = 1.0;
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const BlockCholesky::Coupling& place = matrix.coupling(p);
    if (!inactive_joints_[place.row_block] && !inactive_joints_[place.column_block]) continue;
    const int rows_here = joints[place.row_block].size, columns = joints[place.column_block].size;
    double* const v = matrix.values(place);
    for (int r = 0; r < rows_here; ++r)
      for (int c = 0; c < columns; ++c)
        if (inactive[offset[place.row_block] + r] || inactive[offset[place.column_block] + c]) v[r * columns + c] = 0.0;
  }
}

void JointSet::set_inactive(const std::vector<std::pair<int, int>>& joint_rows) {
  inactive_rows_ = joint_rows;
  std::fill(inactive.begin(), inactive.end(), std::uint8_t{0});
  inactive_joints_.assign(joint_rows.empty() ? 0 : joints.size(), 0);
  for (const auto& [joint, row] : joint_rows) {
    inactive[offset[joint] + row] = 1;
    inactive_joints_[joint] = 1;
  }
}

double JointSet::row_residual(const JointRuntime& joint, const ConstraintRow& row, const RowMemory& m, const Pose& a,
                              const Pose& b, double turned_a, double turned_b) const {
  using Kind = ConstraintRow::Kind;
  const double target = row.constant + m.target;
  switch (row.kind) {
    case Kind::axis_axis:
      return dot(*a.rotation * row.axis_a, *b.rotation * row.axis_b) - target;
    case Kind::axis_axis_pair:
      return dot(*a.rotation * row.axis_a, *b.rotation * row.axis_b) -
             dot(*a.rotation * row.axis_a2, *b.rotation * row.axis_b2) - target;
    case Kind::axis_separation:
      return dot(*a.rotation * row.axis_a, separation_vector(joint, a, b)) - target;
    case Kind::twist:
      return twist_angle(row, *a.orientation, *b.orientation, m.angle_b) - target;
    case Kind::coupling: {
      double c = row.k_a * (m.angle_a + turned_a) + row.k_b * (m.angle_b + turned_b);
      if (row.k_d != 0) c += row.k_d * (dot(*b.rotation * row.axis_b, separation_vector(joint, a, b)) - target);
      return c;
    }
  }
  return 0;
}

void JointSet::residual_at_trial(const BodySet& bodies, std::size_t j, double h, double* c) const {
  const JointRuntime& joint = joints[j];
  const Pose a = pose_trial(bodies, joint.a), b = pose_trial(bodies, joint.b);
  if (joint.has_point) {
    const Vec3 d = separation_vector(joint, a, b);
    c[0] = d.x;
    c[1] = d.y;
    c[2] = d.z;
  }
  for (int r = 0; r < joint.row_count; ++r) {
    const ConstraintRow& row = rows[joint.first_row + r];
    double turned_a = 0, turned_b = 0;
    if (row.kind == ConstraintRow::Kind::coupling)
      std::tie(turned_a, turned_b) = step_rotations(bodies, joint, row, bodies.trial[joint.a].angular_velocity,
                                                    bodies.trial[joint.b].angular_velocity, h);
    c[joint.point_rows() + r] = row_residual(joint, row, memory[joint.first_row + r], a, b, turned_a, turned_b);
  }
}

void JointSet::residual_now(const State& state, const BodySet& bodies, std::size_t j, double* c) const {
  const JointRuntime& joint = joints[j];
  const Pose a = pose_now(state, bodies, joint.a), b = pose_now(state, bodies, joint.b);
  if (joint.has_point) {
    const Vec3 d = separation_vector(joint, a, b);
    c[0] = d.x;
    c[1] = d.y;
    c[2] = d.z;
  }
  for (int r = 0; r < joint.row_count; ++r)
    c[joint.point_rows() + r] =
        row_residual(joint, rows[joint.first_row + r], memory[joint.first_row + r], a, b, 0.0, 0.0);
}

void JointSet::rates(std::size_t j, const Vec3& velocity_a, const Vec3& omega_a, const Vec3& velocity_b,
                     const Vec3& omega_b, double* c) const {
  const JointRuntime& joint = joints[j];
  if (joint.has_point) {
    const Vec3 v = velocity_b + cross(omega_b, arms[j].b) - velocity_a - cross(omega_a, arms[j].a);
    *c++ = v.x;
    *c++ = v.y;
    *c++ = v.z;
  }
  for (int r = joint.first_row; r < joint.first_row + joint.row_count; ++r)
    *c++ = product(jacobian[r].a, velocity_a, omega_a) + product(jacobian[r].b, velocity_b, omega_b);
}

void JointSet::apply(std::size_t j, const double* lambda, BodySet& bodies) const {
  const JointRuntime& joint = joints[j];
  Vec3 p_a, l_a, p_b, l_b;
  if (joint.has_point) {
    p_b = {lambda[0], lambda[1], lambda[2]};
    p_a = -p_b;
    l_b = cross(arms[j].b, p_b);
    l_a = cross(arms[j].a, p_a);
  }
  for (int i = 0; i < joint.row_count; ++i) {
    const RowJacobian& row = jacobian[joint.first_row + i];
    const double impulse = lambda[joint.point_rows() + i];
    p_a += row.a.linear * impulse;
    l_a += row.a.angular * impulse;
    p_b += row.b.linear * impulse;
    l_b += row.b.angular * impulse;
  }
  bodies.add_impulse(static_cast<std::size_t>(joint.a), p_a, l_a);
  bodies.add_impulse(static_cast<std::size_t>(joint.b), p_b, l_b);
}

std::pair<Vec3, Vec3> JointSet::resultant(const BodySet& bodies, std::size_t j, const double* lambda) const {
  const JointRuntime& joint = joints[j];
  std::array<JacobianSide, 6> side;
  const int count = side_rows(static_cast<int>(j), true, side);
  Vec3 force, moment;
  for (int r = 0; r < count; ++r) {
    force += side[r].linear * lambda[r];
    moment += side[r].angular * lambda[r];
  }
  return {force, moment - cross(bodies.rotation[joint.b] * joint.arm_b, force)};
}

double JointSet::row_scale(std::size_t j, int row) const {
  const JointRuntime& joint = joints[j];
  if (row < joint.point_rows()) return 1.0;
  return rows[joint.first_row + row - joint.point_rows()].angular() ? joint.length : 1.0;
}

std::pair<double, double> JointSet::separation(std::size_t j, const double* c) const {
  const JointRuntime& joint = joints[j];
  double distance = 0, angle = 0;
  for (int r = 0; r < joint.size; ++r) {
    const bool is_angle = r >= joint.point_rows() && rows[joint.first_row + r - joint.point_rows()].angular();
    (is_angle ? angle : distance) += c[r] * c[r];
  }
  return {std::sqrt(distance), std::sqrt(angle)};
}

void JointSet::remember_step(const State& state, const BodySet& bodies, double h) {
  for (const JointRuntime& joint : joints)
    for (int r = joint.first_row; r < joint.first_row + joint.row_count; ++r) {
      const ConstraintRow& row = rows[r];
      if (row.kind == ConstraintRow::Kind::coupling) {
        const auto [turned_a, turned_b] =
            step_rotations(bodies, joint, row, state.bodies.motion[joint.a].angular_velocity,
                           state.bodies.motion[joint.b].angular_velocity, h);
        memory[r].angle_a += turned_a;
        memory[r].angle_b += turned_b;
      } else if (row.kind == ConstraintRow::Kind::twist) {
        memory[r].angle_b =
            twist_angle(row, bodies.trial[joint.a].orientation, bodies.trial[joint.b].orientation, memory[r].angle_b);
      }
    }
}

}  // namespace kardan

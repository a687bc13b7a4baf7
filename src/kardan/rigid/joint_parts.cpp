#include "kardan/rigid/joint_parts.hpp"

#include <cmath>
#include <numbers>

namespace kardan {

double rotation_about(const Vec3& angular_velocity, const Vec3& axis, double h) {
  const double half = 0.5 * h * norm(angular_velocity);
  const double along = h * dot(angular_velocity, axis);
  return half < 1e-5 ? along * (1.0 - half * half / 3.0) : along * std::atan(half) / half;
}

double twist_angle(const ConstraintRow& row, const Quat& orientation_a, const Quat& orientation_b, double previous) {
  const Quat now = conjugate(orientation_a) * orientation_b * conjugate(row.relative);
  const double angle = 2.0 * std::atan2(dot(now.vec(), row.axis_a), now.w);
  constexpr double turn = 2.0 * std::numbers::pi;
  return angle + turn * std::round((previous - angle) / turn);
}

}  // namespace kardan

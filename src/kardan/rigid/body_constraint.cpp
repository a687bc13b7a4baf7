#include "kardan/rigid/body_constraint.hpp"

namespace kardan {

bool PrescribedDirections::add(const Vec3& direction, double value) {
  const double length = norm(direction);
  Vec3 e = direction * (1.0 / length);
  double s = value / length;
  // Gram-Schmidt, twice for orthogonality to rounding; the value follows the direction.
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i < count_; ++i) {
      const double overlap = dot(orthonormal_[i], e);
      e -= orthonormal_[i] * overlap;
      s -= dot(orthonormal_[i], particular_) * overlap;
    }
  const double rest = norm(e);
  if (count_ == 3 || rest < 1e-8) return false;
  orthonormal_[count_] = e * (1.0 / rest);
  particular_ += orthonormal_[count_] * (s / rest);
  ++count_;
  return true;
}

std::array<Vec3, 3> PrescribedDirections::complement() const {
  std::array<Vec3, 3> n{};
  if (count_ == 0) {
    n = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  } else if (count_ == 1) {
    const Vec3& e = orthonormal_[0];
    const Vec3 helper = std::abs(e.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    n[0] = normalized(cross(e, helper));
    n[1] = cross(e, n[0]);
  } else if (count_ == 2) {
    n[0] = normalized(cross(orthonormal_[0], orthonormal_[1]));
  }
  return n;
}

Mat3 BodyConstraint::angular_mobility(const Mat3& inertia) const {
  const auto n = angular.complement();
  switch (angular.count()) {
    case 0:
      return inverse(inertia);
    case 1: {
      const double a = dot(n[0], inertia * n[0]), b = dot(n[0], inertia * n[1]), c = dot(n[1], inertia * n[1]);
      const double inv_det = 1.0 / (a * c - b * b);
      return (outer(n[0], n[0]) * c + outer(n[1], n[1]) * a - (outer(n[0], n[1]) + outer(n[1], n[0])) * b) * inv_det;
    }
    case 2:
      return outer(n[0], n[0]) * (1.0 / dot(n[0], inertia * n[0]));
    default:
      return Mat3{};
  }
}

}  // namespace kardan

// A point that turns with a segment: how it moves, and what the segment's nodes get of a force on it.
//
// With the weights w_i of the corners (fixed, sum 1) and the arm d from the foot x_c = sum w_i x_i to the point,
//   v = sum w_i v_i + W x d.
// The segment's angular velocity W is
//   nodal (shells):    W = sum w_i omega_i,
//   fitted (others):   W = A^-1 sum r_i x v_i,   A = sum (r_i^2 1 - r_i r_i),   r_i = x_i - mean,
// the rigid motion that is nearest to the corners' velocities by least squares. With `torsion` a nodal W takes its component along the
// normal n from the fit, because shells have no stiffness against nodal rotations about n (drilling).
// A force f at the foot and a moment T go to the corners by the transposed relations, so that powers are equal:
//   f_i = w_i f [+ (A^-1 T) x r_i],   [m_i = w_i T].
// sum f_i = f and sum (x_i x f_i + m_i) = x_c x f + T: momentum and angular momentum are kept exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// How a segment's angular velocity is found.
enum class Spin : std::uint8_t { nodal, nodal_with_torsion, fitted };

struct SegmentPoint {
  std::array<NodeIndex, 4> nodes{none, none, none, none};
  std::array<double, 4> weights{};
  std::uint8_t corners = 4;        ///< 3 for a triangle, whose fourth weight is zero
  Spin spin = Spin::fitted;

  template <class F>
  void each(F&& f) const {
    for (std::size_t i = 0; i < corners; ++i) f(i, static_cast<std::size_t>(nodes[i]));
  }
  Vec3 mean(const std::vector<Vec3>& of) const {
    Vec3 sum;
    each([&](std::size_t i, std::size_t n) { sum += of[n] * weights[i]; });
    return sum;
  }
};

/// The corners' places and A^-1 at one time.
class SegmentFrame {
 public:
  /// At the positions x + v ahead.
  SegmentFrame(const SegmentPoint& p, const NodeState& nodes, double ahead) : point_(p) {
    if (p.spin == Spin::nodal) return;
    Vec3 center;
    p.each([&](std::size_t i, std::size_t n) {
      r_[i] = nodes.x[n] + nodes.v[n] * ahead;
      center += r_[i] * (1.0 / p.corners);
    });
    Mat3 moment;
    p.each([&](std::size_t i, std::size_t) {
      r_[i] -= center;
      moment += Mat3::identity() * dot(r_[i], r_[i]) - outer(r_[i], r_[i]);
    });
    inverse_ = inverse(moment);
    if (p.spin != Spin::nodal_with_torsion) return;
    normal_ = p.corners == 3 ? cross(r_[1] - r_[0], r_[2] - r_[0]) : cross(r_[2] - r_[0], r_[3] - r_[1]);
    normal_ = normalized(normal_);
  }

  Vec3 angular_velocity(const NodeState& nodes) const {
    if (point_.spin == Spin::nodal) return point_.mean(nodes.omega);
    Vec3 moment;
    point_.each([&](std::size_t i, std::size_t n) { moment += cross(r_[i], nodes.v[n]); });
    const Vec3 fitted = inverse_ * moment;
    if (point_.spin == Spin::fitted) return fitted;
    const Vec3 nodal = point_.mean(nodes.omega);
    return nodal + normal_ * dot(normal_, fitted - nodal);
  }

  /// give(n, f_i, m_i) for each corner of a force at the foot and a moment.
  template <class F>
  void share(const Vec3& force, const Vec3& moment, F&& give) const {
    const bool fitted = point_.spin == Spin::fitted;
    const Vec3 by_forces = fitted ? moment : point_.spin == Spin::nodal ? Vec3{} : normal_ * dot(normal_, moment);
    const Vec3 g = point_.spin == Spin::nodal ? Vec3{} : inverse_ * by_forces, nodal = moment - by_forces;
    point_.each([&](std::size_t i, std::size_t n) { give(n, force * point_.weights[i] + cross(g, r_[i]), nodal * point_.weights[i]); });
  }

 private:
  const SegmentPoint& point_;
  std::array<Vec3, 4> r_{};
  Mat3 inverse_;
  Vec3 normal_;
};

}  // namespace kardan

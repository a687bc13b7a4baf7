// The runtime bodies: constants, the kick-and-drift integrator of one body, and its response to impulses.
//
// Integrator (paper eqs. 1-13; docs/theory/rigid-bodies.md). Symbols: J principal inertia, R(q) principal axes -> global,
// L angular momentum about the centre (global components), w angular velocity in the principal axes, h the step.
//
//   L(n+1/2) = L(n-1/2) + M(n) (h_before + h_after)/2                                      torque kick
//   J w + (h/2) w x J w = R(n)^T L(n+1/2)                                                  half-step w         (a)
//   q(n+1) = q(n) * HughesWinget(h w)                                                      eq. (10)            (b)
//
// (a) with (b) is the implicit midpoint rule of Euler's equations J w' + w x J w = 0 - the term that eq. (5) of the paper
// drops: with the Cayley increment (b) the body momentum P = R^T L obeys P(n+1) - P(n) = (h/2) (P(n) + P(n+1)) x w and
// P(n) + P(n+1) = 2 J w, so a free body keeps L to the last bit and its kinetic energy P.J^-1 P/2 at t_n to rounding, at any
// h.
// Source: Austin, Krishnaprasad and Wang 1993, J. Comput. Phys. 107, 105-117; Simo and Wong 1991, Int. J. Numer. Meth.
// Eng. 31, 19-52. The scheme is time-reversible and of second order.
#pragma once

#include <cmath>
#include <vector>

#include "kardan/base/rotation.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/rigid/body_constraint.hpp"
#include "kardan/rigid/joint_parts.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// A body on the way from t_n to t_{n+1}: momenta at t_{n+1/2} and the pose they lead to.
struct BodyTrial {
  Vec3 velocity, angular_momentum;      ///< before the body's own constraints are imposed
  Vec3 constrained_velocity;            ///< what moves the centre: equal to velocity for a free body
  Vec3 angular_velocity;                ///< global components, constraints imposed
  Vec3 center;                          ///< at t_{n+1}
  Quat orientation;
  Mat3 rotation;                        ///< of `orientation`
};

/// Response of a body at t_n to an impulse: dv = linear p, dw = angular l (l about the centre).
struct Mobility {
  double inverse_mass = 0;  ///< 0 for a body whose translation is constrained: `linear` holds then
  Mat3 angular{};
  Index constraint = none;  ///< into BodySet::constraints
};

/// Solves J w + (h/2) w x J w = momentum (principal axes) by fixed-point iteration from w = J^-1 momentum; contracts by
/// about h|w|/2 an iteration, and the caller keeps h|w| <= 1.
inline Vec3 half_step_angular_velocity(const Vec3& momentum, const Vec3& inertia, const Vec3& inverse_inertia, double h) {
  const auto scaled = [](const Vec3& a, const Vec3& b) { return Vec3{a.x * b.x, a.y * b.y, a.z * b.z}; };
  Vec3 w = scaled(inverse_inertia, momentum);
  const double limit = 1e-33 * dot(w, w);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vec3 next = scaled(inverse_inertia, momentum - (0.5 * h) * cross(w, scaled(inertia, w)));
    const Vec3 change = next - w;
    w = next;
    if (dot(change, change) <= limit) break;
  }
  return w;
}

class BodySet {
 public:
  /// Takes over the constants of state.bodies.info; `constraints` has one entry for each constrained body.
  void initialise(const State& state, std::vector<BodyConstraint> constraints);

  std::size_t size() const { return inverse_mass_.size(); }
  /// Rotations and responses: what reads them between two updates, reads those of the cycle before.
  void register_state(Registry& registry);

  /// Response to impulses at t_n from the rotation at t_n.
  void update_mobility(std::size_t b);
  /// Angular velocity, pose at t_{n+1} from trial momenta; h = t_{n+1} - t_n.
  void advance(const State& state, std::size_t b, double h);
  /// Angular momentum that belongs to the trial's angular velocity: L of (a), with the reactions of the body's constraints.
  Vec3 angular_momentum_after(std::size_t b, double h) const;
  /// Adds a linear impulse p and an angular impulse l about the centre to the trial.
  void add_impulse(std::size_t b, const Vec3& p, const Vec3& l) {
    trial[b].velocity += p * inverse_mass_[b];
    trial[b].angular_momentum += l;
  }

  /// dv of an impulse p (constraints of the body respected).
  Vec3 linear_response(std::size_t b, const Vec3& p) const {
    const Mobility& m = mobility[b];
    return m.constraint == none ? p * m.inverse_mass : constraints[m.constraint].linear_mobility * p;
  }
  Vec3 angular_response(std::size_t b, const Vec3& l) const { return mobility[b].angular * l; }
  /// row . (what the body would do under the row if it were free).
  double free_response(std::size_t b, const JacobianSide& row) const {
    return dot(row.linear, row.linear) * inverse_mass_[b] + dot(row.angular, inverse_inertia_times(b, row.angular));
  }
  bool fixed(std::size_t b) const {
    return mobility[b].constraint != none && constraints[mobility[b].constraint].fixed;
  }
  double inverse_mass(std::size_t b) const { return inverse_mass_[b]; }
  const Vec3& inertia(std::size_t b) const { return inertia_[b]; }
  /// Inertia tensor at t_n in global components, times a vector.
  Vec3 inertia_times(std::size_t b, const Vec3& w) const;
  /// Inverse of it (constraints not considered), times a vector.
  Vec3 inverse_inertia_times(std::size_t b, const Vec3& l) const;

  std::vector<Mat3> rotation;       ///< principal axes -> global at t_n
  std::vector<Mobility> mobility;
  std::vector<BodyTrial> trial;
  std::vector<BodyConstraint> constraints;

 private:
  std::vector<double> inverse_mass_;
  std::vector<Vec3> inertia_, inverse_inertia_;
};

}  // namespace kardan

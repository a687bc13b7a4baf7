// The parts joints are made of. Each part is one scalar equation C = 0 between a body A and a body B; the Jacobian gives
// dC/dt = l_A . v_A + a_A . w_A + l_B . v_B + a_B . w_B with v the velocities of the centres and w the angular velocities,
// global components. Source: Haug 1989, "Computer Aided Kinematics and Dynamics of Mechanical Systems", section 9.4
// (his dot-1 and dot-2 constraints); the point part is his spherical joint.
//
// Symbols: c_A, c_B centres; r_A, r_B arms to the joint's points p = c + r; a, b unit axes fixed in A and in B;
// d = p_B - p_A.
//
//   point             C = d                   (three rows)   l_B = e_i, a_B = r_B x e_i, l_A = -e_i, a_A = -r_A x e_i
//   axis_axis         C = a . b - c                          a_B = b x a,  a_A = -a_B            [d(a.b)/dt = (w_B - w_A).(b x a)]
//   axis_axis_pair    C = a . b - a' . b'                    difference of two of the above (constant-velocity joint)
//   axis_separation   C = a . d - c(t)                       l_B = a, a_B = r_B x a, l_A = -a, a_A = -(r_A + d) x a
//   twist             C = twist of B in A about a - c(t)     a_B = a, a_A = -a
//   coupling          C = k_A angle_A + k_B angle_B + k_d (b . d - c)
//                     angle = rotation of a body, summed over the steps: about its own axis (a of A, b of B) where
//                     k_d = 0 (gears, pulley), both about a where k_d != 0 (rack, screw: with k_B = -k_A the moments on
//                     the two bodies balance); the separation term is axis_separation with the axis in B
#pragma once

#include <array>
#include <cstdint>

#include "kardan/base/rotation.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Position and orientation of one body at one instant.
struct Pose {
  Vec3 center;
  const Mat3* rotation;     ///< principal axes -> global
  const Quat* orientation;
};

/// One side of a Jacobian row.
struct JacobianSide {
  Vec3 linear, angular;
};

/// One scalar constraint between two bodies; vectors in the principal axes of the body they are fixed in.
struct ConstraintRow {
  enum class Kind : std::uint8_t { axis_axis, axis_axis_pair, axis_separation, twist, coupling } kind = Kind::axis_axis;
  Vec3 axis_a, axis_b;            ///< a, b
  Vec3 axis_a2, axis_b2;          ///< a', b'
  double constant = 0;            ///< c at t = 0
  double k_a = 0, k_b = 0, k_d = 0;
  Quat relative{};                ///< twist: orientation of B in A at t = 0
  bool angular() const { return kind != Kind::axis_separation && !(kind == Kind::coupling && k_d != 0); }
};

/// What a driven or coupled row carries from step to step; one entry a row, registered with the state.
struct RowMemory {
  double angle_a = 0, angle_b = 0;  ///< coupling: rotations so far; twist: angle_b = twist at t_n
  double target = 0;                ///< c(t) - c(0) at t_{n+1}
  double target_rate = 0;           ///< at t_{n+1/2}, for motors driven by acceleration
};

/// Rotation in one Hughes-Winget step h w about an axis fixed in the body: w.a/|w| 2 atan(h|w|/2).
double rotation_about(const Vec3& angular_velocity, const Vec3& axis, double h);

/// Twist of `orientation_b` relative to `orientation_a` about `axis_a` since `initial`, the multiple of 2 pi chosen next to
/// `previous`.
double twist_angle(const ConstraintRow& row, const Quat& orientation_a, const Quat& orientation_b, double previous);

}  // namespace kardan

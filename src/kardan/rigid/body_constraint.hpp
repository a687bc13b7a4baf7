// Degrees of freedom of one body that are fixed or prescribed: *MAT_RIGID CON1/CON2, *BOUNDARY_SPC on rigid nodes, *CONSTRAINED_
// NODAL_RIGID_BODY_SPC, *BOUNDARY_PRESCRIBED_MOTION_RIGID and stoppers that have met their limit.
//
// Up to three directions c_k of the velocity of the centre have prescribed values s_k at t_{n+1/2}: c_k . v = s_k, and the
// same for the angular velocity. Reactions act along the directions only, so with N a basis of their complement
//   v = v_p + N N^T (v* - v_p),                 v_p = the combination of the c_k that has the prescribed values,
//   N^T (J w + (h/2) w x J w - L*) = 0,         w = w_p + N eta,
// where v* and L* are what the forces alone would make. The response to impulses is N N^T / m and N (N^T J N)^-1 N^T.
#pragma once

#include <array>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Up to three independent directions with prescribed values; the complement is kept orthonormal.
class PrescribedDirections {
 public:
  void clear() {
    count_ = 0;
    particular_ = {};
  }
  int count() const { return count_; }
  /// Adds c . v = value. @return false if c depends on the directions already there (the first one given holds).
  bool add(const Vec3& direction, double value);
  /// The vector in the span of the directions that has the prescribed values.
  Vec3 particular() const { return particular_; }
  /// Orthonormal basis of the complement: 3 - count() columns.
  std::array<Vec3, 3> complement() const;
  /// Part of a that the directions leave free.
  Vec3 project(Vec3 a) const {
    for (int i = 0; i < count_; ++i) a -= orthonormal_[i] * dot(orthonormal_[i], a);
    return a;
  }

 private:
  int count_ = 0;
  std::array<Vec3, 3> orthonormal_{};
  Vec3 particular_{};
};

struct BodyConstraint {
  BodyIndex body = none;
  PrescribedDirections linear, angular;  ///< of the kick in progress
  Mat3 linear_mobility{};                ///< N N^T / m

  bool fixed = false;                    ///< all six degrees of freedom, for the whole run
  /// N (N^T J N)^-1 N^T for an inertia tensor in global components.
  Mat3 angular_mobility(const Mat3& inertia) const;
};

}  // namespace kardan

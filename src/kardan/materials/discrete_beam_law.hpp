// Laws of discrete beams (*SECTION_BEAM, ELFORM 6): six forces of six relative displacements.
//
// Components 0 to 2: forces along r, s, t [force] of the displacements of node 2 relative to node 1 [length]; 3 to 5: moments about r, s, t
// [force length] of the relative rotations [rad]. Sources: Hallquist, LS-DYNA Keyword User's Manual Vol. II, *MAT_066, *MAT_067 and
// *MAT_071; Theory Manual 2006, "Discrete beam".
#pragma once

#include <array>
#include <optional>
#include <string>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// *MAT_LINEAR_ELASTIC_DISCRETE_BEAM (066): F = F0 + k u + c u'.
/// *MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM (067): F = F0 + f(u) + g(u'), curves; a curve that begins at the origin holds for compression
/// too, with the sign turned. The beam fails when sum (F_i/FFAIL_i)^2 or sum (u_i/UFAIL_i)^2 reaches 1 (fields left at 0 do not count).
class SixDofLaw {
 public:
  /// From a material 66 or 67; complains where it cannot be computed.
  static std::optional<SixDofLaw> make(const Model& model, const FieldMaterial& material, const std::string& name, Diagnostics& diagnostics);

  double force(std::size_t component, double displacement, double rate) const;
  /// Bounds of dF/du and dF/du'.
  double stiffness(std::size_t component) const { return largest_stiffness_[component]; }
  double damping(std::size_t component) const { return largest_damping_[component]; }
  bool fails(const std::array<double, 6>& force, const std::array<double, 6>& displacement) const;
  bool can_fail() const { return can_fail_; }

 private:
  std::array<double, 6> stiffness_{}, damping_{}, preload_{}, failure_force_{}, failure_displacement_{};
  std::array<const Curve*, 6> elastic_{}, viscous_{};
  std::array<double, 6> largest_stiffness_{}, largest_damping_{};
  bool can_fail_ = false;
};

/// *MAT_CABLE_DISCRETE_BEAM (071): no compression, F = max(0, F0 + K dL), dL = length - (initial length - OFFSET),
/// K = E A/(initial length - OFFSET); E < 0: K = -E; a curve gives the stress over the engineering strain instead.
class CableLaw {
 public:
  static std::optional<CableLaw> make(const Model& model, const FieldMaterial& material, const std::string& name, Diagnostics& diagnostics);

  /// @param free_length initial length - OFFSET
  double force(double length, double free_length, double area) const;
  /// Bound of dF/dL.
  double stiffness(double free_length, double area) const;

 private:
  double modulus_ = 0, preload_ = 0, steepest_ = 0;
  const Curve* curve_ = nullptr;
};

}  // namespace kardan

// Failure criteria on top of a material (*MAT_ADD_EROSION).
#pragma once

namespace kardan {

/// Limits; `never` (or its negative) where a criterion is not asked for. What each one means: materials/erosion.hpp.
struct ErosionCriteria {
  static constexpr double never = 1e300;
  double max_pressure = never, min_pressure = -never;  ///< MXPRES, MNPRES
  double principal_stress = never, mises = never;      ///< SIGP1, SIGVM
  double max_strain = never, min_strain = -never;      ///< MXEPS, MNEPS
  double shear_strain = never;                         ///< EPSSH
  double expansion = never, compaction = -never;       ///< VOLEPS > 0, < 0
  double effective_strain = never;                     ///< EFFEPS > 0
  double plastic_strain = never;                       ///< -EFFEPS > 0
  double impulse_stress = 0, impulse = never;          ///< SIGTH, IMPULSE
  double time = never;                                 ///< FAILTM
  double thinning = never, major_strain = never;       ///< EPSTHIN; EPSMAJ of *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY
  double needed = 1;                                   ///< NCS
  double failing_points = 1;                           ///< NUMFIP: points of an element; 0 all of them, negative per cent
  double smallest_step = 0;                            ///< DTMIN
};

}  // namespace kardan

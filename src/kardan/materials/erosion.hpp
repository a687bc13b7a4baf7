// *MAT_ADD_EROSION: failure of points by criteria of stress, strain and time on top of any law, and the criteria EPSTHIN and EPSMAJ of
// *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY.
//
// Source: LS-DYNA keyword manual II, *MAT_ADD_EROSION. With the pressure p = -sigma_kk/3, principal stresses sigma_1 >= sigma_2 >= sigma_3,
// effective stress sigma_vm, strains eps summed over the steps in axes that turn with the material
// (in shells with the element), and their principal values eps_1 to eps_3:
//   MXPRES  p >= MXPRES                       MNPRES  p <= MNPRES
//   SIGP1   sigma_1 >= SIGP1                  SIGVM   sigma_vm >= SIGVM
//   MXEPS   eps_1 >= MXEPS                    MNEPS   eps_3 <= MNEPS
//   EPSSH   (eps_1 - eps_3)/2 >= EPSSH        VOLEPS  eps_kk >= VOLEPS > 0, or eps_kk <= VOLEPS < 0
//   EFFEPS  sqrt(2/3 eps':eps') >= EFFEPS, eps' the deviator; EFFEPS < 0: effective plastic strain >= |EFFEPS|
//   SIGTH, IMPULSE   integral of max(0, sigma_1 - SIGTH)^2 dt >= IMPULSE (Tuler and Butcher 1968, Int. J. Fract. Mech. 4, 431-437)
//   FAILTM  t >= FAILTM                       EPSTHIN -eps_zz >= EPSTHIN in shells
//   EPSMAJ  larger principal strain in the plane of the shell >= EPSMAJ
// A point fails for good when NCS of them hold at once, or FAILTM or the law below says so.
#pragma once

#include <cstddef>

#include "kardan/materials/law_entry.hpp"
#include "kardan/model/erosion.hpp"

namespace kardan {

/// History of a point: the strains (tensor), then the law's own history, then the impulse, then 1 if the point has failed.
struct Erosion {
  ErosionCriteria criteria;
  const void* law = nullptr;  ///< constants of the law below
  PointUpdate update = nullptr;
  std::size_t law_history = 0;
  std::size_t law_plastic_strain = 0;  ///< place in the law's history, used where plastic_strain < never

  static constexpr std::size_t own_tensors = 1, law_begin = 6;
  bool wants_principal_strains() const {
    return criteria.max_strain < ErosionCriteria::never || criteria.min_strain > -ErosionCriteria::never ||
           criteria.shear_strain < ErosionCriteria::never;
  }
  bool wants_principal_stress() const {
    return criteria.principal_stress < ErosionCriteria::never || criteria.impulse < ErosionCriteria::never;
  }
  std::size_t impulse_place() const { return law_begin + law_history; }
  std::size_t failed_place() const { return impulse_place() + 1; }
  std::size_t history() const { return failed_place() + 1; }
};

}  // namespace kardan

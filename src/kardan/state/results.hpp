// What the elements report at t_n for D3PLOT: plain arrays that the element folders fill when an output is due. An
// array left empty is written as zeros, so a kind of element that reports nothing costs nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Stress components xx, yy, zz, xy, yz, zx in global axes.
using StressVector = std::array<double, 6>;

/// One integration point of an element, for ELOUT.
struct PointStress {
  StressVector stress{};
  double plastic_strain = 0;
};

/// Shells, by element of the model. `layers` sets of through-thickness data per shell in the order of D3PLOT: mid
/// surface, inner surface, outer surface, then further integration points from the inside out.
struct ShellResults {
  int layers = 3;                            ///< MAXINT of D3PLOT; set before the first output, then fixed
  std::vector<StressVector> stress;          ///< [shell * layers + layer]
  std::vector<double> plastic_strain;        ///< effective plastic strain, [shell * layers + layer]
  std::vector<Vec3> bending;                 ///< Mxx, Myy, Mxy per unit width, local axes, [shell]
  std::vector<std::array<double, 2>> shear;  ///< Qxx, Qyy per unit width, local axes
  std::vector<Vec3> membrane;                ///< Nxx, Nyy, Nxy per unit width, local axes
  std::vector<double> thickness;             ///< length; empty: the section's is written
  std::vector<double> internal_energy;       ///< energy/volume
  std::vector<std::uint8_t> alive;           ///< 0 = eroded; empty = no shell can erode
  /// By entry of OutputControl::history_shells: the points from the inside out, in the element's axes, or global ones (EOCS = 2); none
  /// for rigid and eroded shells.
  std::vector<std::vector<PointStress>> history;
};

/// Solids, by element of the model.
struct SolidResults {
  std::vector<StressVector> stress;
  std::vector<double> plastic_strain;
  std::vector<std::uint8_t> alive;
};

/// Beams, by element of the model: resultants in the beam's axes r, s, t.
struct BeamResults {
  std::vector<double> axial;                   ///< force
  std::vector<std::array<double, 2>> shear;    ///< forces s, t
  std::vector<std::array<double, 2>> bending;  ///< moments s, t
  std::vector<double> torsion;                 ///< moment
  std::vector<std::uint8_t> alive;

  /// Room for the resultants of all beams.
  void resize(std::size_t beams) {
    axial.resize(beams);
    shear.resize(beams);
    bending.resize(beams);
    torsion.resize(beams);
  }
};

struct ElementResults {
  ShellResults shell;
  SolidResults solid;
  BeamResults beam;

  std::int64_t deleted_shells = 0, deleted_solids = 0, deleted_beams = 0;  ///< so far

  /// Some element may erode: D3PLOT then carries a deletion table.
  bool deletable() const { return !shell.alive.empty() || !solid.alive.empty() || !beam.alive.empty(); }
};

/// What limits the time step of the cycle to come (GLSTAT's "dt of cycle … is controlled by …").
struct TimeStepOwner {
  enum class Kind : std::uint8_t { prescribed, solid, beam, shell, discrete, joint } kind = Kind::prescribed;
  UserId id = 0;    ///< of the element or joint
  UserId part = 0;  ///< of the element's part
};

}  // namespace kardan

// Nodes tied to segments by springs (*CONTACT_TIED_…_OFFSET, _BEAM_OFFSET, *CONTACT_SPOTWELD_BEAM_OFFSET, *CONTACT_TIEBREAK_…).
//
// The foot of a tied node s is x_c = sum w_i x_i; an arm d that turns with the segment's angular velocity W (segment_point.hpp) leads from there to
// where the node wants to be. The spring's stretch and its force on the node are
//   u = x_s - x_c,   delta = u - d,   f = -k delta  [- c (v_s - v_c - W x u)],
// and where rotations are tied, the moment on the node  m = -k_r phi,  phi' = omega_s - W, phi turned with W. The segment gets -f at the foot and
// -(u x f + m): momentum and angular momentum are kept exactly, and the work of all these forces is that of the springs: W and the
// moments are transposed to each other. LS-DYNA's _OFFSET leaves the moment u x f out; without it a gap makes energy of nothing.
//
// Stiffness. The eigenvalues of M^-1 K of all springs together are at most (Gershgorin, rows K B M^-1 B^T)
//   max_s k_s sum_j |b_sj| c_j/m_j,   c_j = sum_t |b_tj|,
// with b_sj the share of spring s in node j: 1 for the tied node, w_j for corners, and what the arm adds. So
//   k_s = alpha/(dt^2 sum_j |b_sj| c_j/m_j)
// bounds them by alpha/dt^2, far enough from the 4/dt^2 that the elements may use up to TSSFAC^2 of; k_r likewise. Ends of weld beams
// have so little rotary inertia that k_r would be softer than the beam; they get ten times theirs, which is little beside that of the plate they turn with. A body counts as one
// node of its mass and smallest inertia. dt is the largest step so far: k falls when the step has grown by 5 %, and the stretch grows then, so that
// no force jumps. c = 2 xi k/omega, xi = VDC, omega = sqrt(alpha)/dt.
//
// Tiebreak. With f_n, f_s the tensile normal force and the shear force on the node and n that turns with the segment, the tie begins to fail at
//   (f_n/NFLF)^NEN + (f_s/SFLF)^MES >= 1,       (sigma_n/NFLS)^2 + (sigma_s/SFLS)^2 >= 1,  sigma = f/A, A the node's share of its surface.
// Source: Hallquist, LS-DYNA Keyword User's Manual Vol. I, *CONTACT_TIEBREAK_…, _AUTOMATIC_…_TIEBREAK. It is gone then, or (option 6) the
// traction falls linearly with the largest opening C = sqrt(<delta_n>^2 + delta_s^2) so far:
//   |f| = F_0 (CCRIT - C)/(CCRIT - C_0),  C_0, F_0 those at onset: the whole work is 1/2 F_0 CCRIT, LS-DYNA's energy release.
// Pressure (delta_n < 0) is carried undamaged until the tie is gone.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "kardan/contact/tie_search.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"
#include "kardan/state/work_meter.hpp"

namespace kardan {

/// Which nodes the springs of a contact hold, for the contact that a tiebreak becomes.
struct TieHold {
  std::vector<std::uint8_t> held;  ///< by node of the model, 1 or 0; empty: the contact has no springs
  std::uint64_t releases = 0;      ///< so far
};

class TieSprings {
 public:
  /// Bodies and lumped masses, still with the tied nodes, must stand in the state. Marks nodes of bodies as needed, raises rotary inertias.
  TieSprings(const Model& model, State& state, std::vector<TiedPoint> points);

  bool empty() const { return springs_.empty(); }
  /// Adds the forces at t_n to state.nodes.force and .moment, in the order of the ties; those that fail let go, with a line in the log.
  void apply(const Model& model, State& state);
  /// Those of which `ends` is true let go.
  void release(const std::function<bool(const TiedPoint&)>& ends);
  /// Every cycle after the kick, with velocities at t_{n+1/2}: the springs' energies up to t_n are added to state.contacts.
  void account(State& state);
  /// Adds forces and moments at t_n to state.contacts.
  void report(State& state) const;
  /// After the drift: arms to t_{n+1}.
  void turn(const State& state);
  /// The springs have forgotten all work (after the dynamic relaxation).
  void restart();
  const TieHold& hold(std::size_t contact) const { return holds_[contact]; }

 private:
  struct Memory {
    Vec3 arm, normal;              ///< at t_n
    Vec3 turned;                   ///< phi
    double opening = 0;            ///< largest since onset
    double onset_opening = 0, onset_force = 0;
    std::uint64_t damaged = 0, released = 0;
  };
  struct Action {                  ///< at t_n
    Vec3 force, moment;            ///< on the node
    Vec3 at_foot;                  ///< minus the moment on the segment
    double power_node = 0, power_segment = 0;  ///< with the velocities of before the kick
    bool holds = false, fails = false;
  };
  struct Spring {
    TiedPoint point;
    double stiffness = 0, turning_stiffness = 0;  ///< times dt^2
    bool breaks = false, rotations = false;
  };
  struct Power {                   ///< or work
    double node = 0, segment = 0;
  };
  class StiffnessBound;

  void let_go(std::size_t i);
  void follow_step(const State& state);
  void act(const Model& model, const State& state, std::size_t i);
  static double remaining(const Contact& contact, double area, double stiffness, Memory& m, double normal, double shear);

  std::vector<Spring> springs_;    ///< by contact, then node
  std::vector<Memory> memory_;
  std::vector<Action> actions_;
  std::vector<TieHold> holds_;     ///< by contact of the model, likewise the next ones
  std::vector<WorkMeter> tracked_, reference_;
  std::vector<Power> counted_;     ///< work that state.contacts has already
  std::vector<Power> power_;       ///< work space
  double step_ = 0;                ///< dt of the stiffness; 0 before the first step
};

}  // namespace kardan

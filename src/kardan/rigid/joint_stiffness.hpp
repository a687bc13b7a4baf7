// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED, _FLEXION-TORSION, _TRANSLATIONAL, _CYLINDRICAL: moments and forces between two
// bodies against relative angles and displacements. Independent of any joint. (Paper, section on stiffness and damping of
// joints, fig. 2.)
//
// Frames A and B (CIDA, CIDB) turn with their bodies. Each of up to three relative coordinates q with direction e gets
//   m = curve(q) + damping_curve(q') + friction + stop,           moment (force) -m e on B and +m e on A,
//   friction: an elastic-perfectly plastic spring, f += ES dq, |f| <= FM (or FM(q); or mu |N| with the joint's force N);
//             mu |N| without ES: Coulomb's law without a spring, the force that stops the sliding. What would be more than
//             FS |N| slips at FD |N|,
//   stop:     ES (q - q_stop) beyond the stop.
// Coordinates:
//   generalized      rotations of B against A about the axes of A. JNTF = 0 (default): sum of the relative rotation's
//                    increments, exact for any angle about one axis; JNTF = 1, 2: rotation vector of B in A, whole turns counted.
//   flexion-torsion  alpha angle between the z axes, about their common normal; beta twist about z_B that remains after
//                    the bend; gamma direction of the bend in A's x-y plane, scales the alpha moment.
//   translational    displacement of B's origin from A's along the axes of B.
//   cylindrical      its distance r from the z axis of A, and z along it.
// Rates are those of t_{n-1/2} carried on to t_n linearly.
#pragma once

#include <array>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/joint_set.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class JointStiffnesses {
 public:
  void initialise(const Model& model, State& state, const JointSet& joints, Diagnostics& diagnostics);
  /// Adds the forces and moments at t_n to state.bodies and fills state.joint_stiffnesses. `joint_force` holds the rows'
  /// forces of the cycle before (friction by the joint's force).
  void apply(const Model& model, State& state, const BodySet& bodies, const JointSet& joints,
             const std::vector<double>& joint_force);
  /// Some friction depends on the force of a joint.
  bool asks_for_joint_forces() const;
  /// Energy stored and dissipated since t = 0 (what a spring held then is not counted).
  double energy(const State& state) const;
  void register_state(State& state);

 private:
  struct Element {
    BodyIndex a, b;
    Mat3 axes_a, axes_b;       ///< columns in the principal axes of the bodies
    Vec3 origin_a, origin_b;   ///< from the centres, principal axes
    int joint = -1;            ///< into JointSet::joints, for friction by the joint's force
    std::array<bool, 3> slides{};  ///< coordinates along the axis that the joint leaves free: its force rubs there
    Index model_index;
  };
  struct Memory {              ///< carried from cycle to cycle
    Quat relative;             ///< orientation of B in A at t_{n-1}
    std::array<double, 3> coordinate, rate_before, friction, moment;
    std::array<double, 3> slips;  ///< 1 while the friction spring slips
  };
  struct Kinematics {          ///< at t_n
    std::array<double, 3> coordinate, rate;
    std::array<Vec3, 3> direction;   ///< of the moments (forces), global
    Vec3 point;                      ///< forces act here
    double bend = 1, bend_rate = 1;  ///< gamma factors
  };
  Kinematics kinematics(const Model& model, const State& state, const BodySet& bodies, const Element& e, Memory& m) const;
  struct Sliding {             ///< what friction depends on, at t_n
    double coordinate, increment, rate;
    double normal_force;             ///< resultant of the joint named by JID
    double stopping_force;           ///< would bring the sliding to rest in this kick
    double dt;
    bool first;                      ///< t = 0
  };
  double friction(const Model& model, const JointStiffness::Coordinate& c, const Sliding& now, double before,
                  double& slips) const;
  double stopping_force(const State& state, const BodySet& bodies, const Element& e, const Kinematics& k, std::size_t i) const;

  std::vector<Element> elements_;
  std::vector<Memory> memory_;
};

}  // namespace kardan

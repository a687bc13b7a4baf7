// Rigid bodies and what connects them, as the deck gives them (immutable). The runtime bodies are made of this in rigid/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/model/entities.hpp"

namespace kardan {

/// *CONSTRAINED_NODAL_RIGID_BODY (_INERTIA, _SPC).
struct NodalRigidBody {
  UserId id = 0;  ///< PID: shares the number space of parts
  PartIndex part = none;  ///< its entry in Model::parts (no section, no material); what names the body by PID names this
  std::string title;
  std::vector<NodeIndex> nodes;
  Index frame = none;          ///< CID: output frame, and axes of the SPC and of DRFLAG/RRFLAG
  NodeIndex print_node = none; ///< PNODE
  int drflag = 0, rrflag = 0;  ///< released displacement / rotation DOFs of the nodes (0 = none)
  std::optional<GivenInertia> inertia;
  std::optional<double> cmo;   ///< _SPC: +-1, +-2 as *MAT_RIGID
  int con1 = 0, con2 = 0;      ///< CMO > 0: codes 0-7; CMO < 0: con2 = Dof bits in the axes of `constraint_frame`
  Index constraint_frame = none;         ///< CMO < 0
  Vec3 constraint_point{};               ///< |CMO| = 2: where the constraint acts
  NodeIndex constraint_node = none;      ///< |CMO| = 2: SPCNID, whose initial coordinates are `constraint_point`
  int print = 0;               ///< IPRT
};

/// *CONSTRAINED_RIGID_BODIES: `constrained` becomes a piece of `lead`.
struct RigidBodyMerge {
  PartIndex lead = none, constrained = none;
  int iflag = 0;  ///< 1: lead's *PART_INERTIA is updated by the merge; 0: kept as given
};

/// *CONSTRAINED_EXTRA_NODES_NODE / _SET.
struct ExtraNodes {
  PartIndex part = none;
  std::vector<NodeIndex> nodes;
  int iflag = 0;  ///< 1: *PART_INERTIA is updated
};

enum class JointKind : std::uint8_t {
  spherical, revolute, cylindrical, planar, universal, translational, locking,
  translational_motor, rotational_motor, gears, rack_and_pinion, constant_velocity, pulley, screw
};
const char* to_string(JointKind kind);

/// *CONSTRAINED_JOINT_<kind>. Points 1, 3, 5 belong to body A and 2, 4, 6 to body B (array index = number - 1).
struct Joint {
  UserId id = 0;  ///< JID, or the joint's number in the deck where there is none
  std::string title;
  JointKind kind = JointKind::spherical;
  std::array<NodeIndex, 6> nodes{none, none, none, none, none, none};
  std::optional<std::array<Vec3, 6>> points;  ///< _COOR: coordinates instead of nodes
  PartIndex part_a = none, part_b = none;     ///< _COOR: RBID_A, RBID_B
  double rps = 1.0;
  double damp = 1.0;                          ///< 0 < DAMP <= 0.01: none
  double parameter = 0;                       ///< PARM: ratio R2/R1, rack h, helix ratio
  CurveIndex curve = none;                    ///< LCID of motors
  int motor_type = 0;                         ///< 0 velocity, 1 acceleration, 2 displacement, 3 velocity vs displacement
  double radius_1 = 0;                        ///< R1 of gears and pulleys
  PartIndex local_body = none;                ///< _LOCAL RAID: part whose frame forces are reported in
  int local_system = 0;                       ///< LST
  struct Failure {
    Index frame = none;                       ///< CID: system of the resultants; none = body frame of `local_body`/global
    double time = 1e20;                       ///< TFAIL
    double coupling = 0;                      ///< COUPL
    std::array<double, 6> limits{};           ///< NXX NYY NZZ MXX MYY MZZ; 0 = not considered
  };
  std::optional<Failure> failure;
};

enum class JointStiffnessKind : std::uint8_t { generalized, flexion_torsion, translational, cylindrical };

/// *CONSTRAINED_JOINT_STIFFNESS_<kind>: independent of any joint. For each of up to three relative coordinates
/// (generalized: phi, theta, psi; flexion-torsion: alpha, gamma, beta; translational: x, y, z; cylindrical: r, z as 0 and 2).
struct JointStiffness {
  UserId id = 0;
  JointStiffnessKind kind = JointStiffnessKind::generalized;
  PartIndex part_a = none, part_b = none;
  Index frame_a = none, frame_b = none;
  UserId joint = 0;                                  ///< JID
  double rps = 1.0;
  struct Coordinate {
    CurveIndex moment = none;      ///< moment (force) against angle in radians (displacement)
    CurveIndex damping = none;     ///< moment (force) against rate
    double elastic = 0;            ///< ES: stiffness of friction and stops; 0 switches both off
    double friction = 0;           ///< FM: limit
    CurveIndex friction_curve = none;  ///< FM < 0: limit against angle
    double stop_negative = 0;      ///< radians or length; 0 = no stop; angle at which the stop acts (sign as given)
    double stop_positive = 0;
    double static_coefficient = 0, dynamic_coefficient = 0;  ///< FS, FD on the joint's force
  };
  std::array<Coordinate, 3> coordinate{};
  CurveIndex moment_scale = none, damping_scale = none;  ///< flexion-torsion LCIDG, DLCIDG: factor on the alpha moment
};

/// *CONSTRAINED_RIGID_BODY_STOPPERS: limits on the motion of a body's centre in one direction.
struct RigidBodyStopper {
  PartIndex part = none;
  int direction = 1;            ///< DIR: 1-3 translation along global axes, 4 along `vector`, 5-7 and 8 rotation likewise
  Index vector = none;          ///< VID, into Model::vectors
  struct Limit {
    CurveIndex curve = none;    ///< LCMAX / LCMIN against time; none = no limit
    bool displacement = false;  ///< given negative: bounds the displacement, else the coordinate
  };
  Limit maximum, minimum;
  CurveIndex velocity = none;   ///< LCVMNX: largest |velocity| against time
  double birth = 0, death = 1e21;
  struct Follower {
    PartIndex part = none;
    double closure = 0;         ///< distance from the lead body at which it stops too; 0 = when the lead stops
  };
  std::vector<Follower> followers_maximum, followers_minimum;  ///< PSIDMX, PSIDMN
};

}  // namespace kardan

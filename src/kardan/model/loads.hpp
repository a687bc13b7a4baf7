// Loads, boundary and initial conditions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// *LOAD_BODY_X/Y/Z/RX/RY/RZ/VECTOR: base acceleration; a positive LOAD_BODY_Z accelerates the model in -z.
struct BodyLoad {
  int axis = 0;                    ///< 0-2 translation, 3-5 rotation (angular velocity about the axis), 6 vector
  Vec3 vector{};                   ///< direction of `vector`
  CurveIndex curve = none;         ///< acceleration (angular velocity) against time
  CurveIndex relaxation_curve = none;  ///< LCIDDR: the same in the dynamic relaxation; none = `curve`
  double scale = 1.0;
  Vec3 center{};                   ///< XC, YC, ZC of rotations
  Index frame = none;
  std::vector<PartIndex> parts;    ///< *LOAD_BODY_PARTS; empty = all
};

/// *LOAD_RIGID_BODY and *LOAD_NODE_POINT/SET. DOF 1-3 forces, 5-7 moments, 4 and 8 follower along nodes m.
struct PointLoad {
  PartIndex body_part = none;      ///< rigid body, or none where `nodes` are loaded
  std::vector<NodeIndex> nodes;
  int dof = 1;
  CurveIndex curve = none;
  double scale = 1.0;
  Index frame = none;
  std::array<NodeIndex, 3> m{none, none, none};  ///< M1, M2, M3 of follower forces
};

/// *LOAD_SEGMENT(_SET), *LOAD_SHELL_ELEMENT/_SET: a positive pressure acts against the normal of a segment.
struct PressureLoad {
  std::vector<std::array<NodeIndex, 4>> segments;  ///< a triangle repeats its third node
  CurveIndex curve = none;                         ///< pressure against the time since `arrival`
  double scale = 1.0;
  double arrival = 0;                              ///< AT: no pressure before it
};

/// *DAMPING_GLOBAL, *DAMPING_PART_MASS(_SET), *DAMPING_RELATIVE.
struct DampingLaw {
  std::vector<PartIndex> parts;     ///< empty = the whole model
  CurveIndex curve = none;          ///< factor on `value` against time
  double value = 1.0;               ///< D [1/time]; with `relative_to`: fraction of critical damping at `frequency`
  Vec3 translation{1, 1, 1};        ///< STX, STY, STZ
  Vec3 rotation{1, 1, 1};           ///< SRX, SRY, SRZ
  PartIndex relative_to = none;     ///< _RELATIVE: the rigid body against which velocities are taken
  double frequency = 0;             ///< FREQ [1/time]
};

/// *DAMPING_PART_STIFFNESS(_SET): a later entry replaces an earlier one.
struct StiffnessDamping {
  std::vector<PartIndex> parts;
  double fraction = 0;              ///< COEF > 0: of critical damping at the highest frequency of each element
  double beta = 0;                  ///< -COEF > 0: Rayleigh's factor on the stiffness [time]
};

/// *BOUNDARY_NON_REFLECTING: waves leave through these faces of solids.
struct NonReflectingBoundary {
  std::vector<std::array<NodeIndex, 4>> segments;  ///< a triangle repeats its third node
  bool dilatational = true;                        ///< AD = 0: pressure waves are let through
  bool shear = true;                               ///< AS = 0: shear waves are let through
};

enum class MotionKind : std::uint8_t { velocity, acceleration, displacement, velocity_versus_displacement,
                                       relative_displacement };

/// *BOUNDARY_PRESCRIBED_MOTION_RIGID(_LOCAL), _NODE, _SET.
struct PrescribedMotion {
  UserId id = 0;
  PartIndex body_part = none;      ///< _RIGID
  std::vector<NodeIndex> nodes;    ///< _NODE, _SET
  bool local = false;              ///< _LOCAL: body axes of the rigid part's LCO frame (moving)
  int dof = 1;                     ///< 1-3, 5-7 global; 4/-4, 8/-8 vector; 9/-9, 10/-10, 11/-11 rotation about an offset axis
  MotionKind kind = MotionKind::velocity;
  CurveIndex curve = none;
  double scale = 1.0;
  Index vector = none;             ///< VID
  double birth = 0.0, death = 1e28;
  double offset_1 = 0, offset_2 = 0;
  PartIndex lead_part = none;      ///< LRB of VAD = 4
  std::array<NodeIndex, 2> lead_nodes{none, none};
};

/// *BOUNDARY_SPC_NODE/_SET (with _BIRTH_DEATH).
struct SinglePointConstraint {
  UserId id = 0;
  std::vector<NodeIndex> nodes;
  std::uint8_t dofs = 0;  ///< Dof bits in the axes of `frame`
  Index frame = none;
  double birth = 0, death = 1e20;
};

/// *INITIAL_VELOCITY, _NODE, _GENERATION, _RIGID_BODY. Later entries override earlier ones.
struct InitialVelocity {
  enum class Kind : std::uint8_t { nodes, rigid_body, generation } kind = Kind::nodes;
  std::vector<NodeIndex> nodes;        ///< nodes, generation
  std::vector<NodeIndex> exempt;       ///< NSIDEX of *INITIAL_VELOCITY
  bool all_nodes = false;
  PartIndex body_part = none;          ///< rigid_body
  Vec3 velocity{}, angular_velocity{}; ///< in the axes of `frame`
  Vec3 exempt_velocity{}, exempt_angular_velocity{};
  /// IRIGID: the velocity given by *PART_INERTIA (or _NODAL_RIGID_BODY_INERTIA) is overridden too; rigid bodies without
  /// such a velocity take this one in any case. Where `override_parts` is not empty, only the bodies of those parts.
  bool include_rigid = true;
  std::vector<PartIndex> override_parts;
  double omega = 0;                    ///< generation: angular velocity about the axis
  Vec3 axis_point{}, axis_direction{};
  std::vector<PartIndex> parts;        ///< generation by part
  Index frame = none;                  ///< ICID
};

}  // namespace kardan

// The mutable side of a run. Floor-3 folders meet here: elements, contact and loads write nodal forces, rigid and nodes
// read them.
//
// Time levels (leapfrog): at the start of cycle n positions are at t_n and velocities at t_{n-1/2}. The kick brings
// velocities to t_{n+1/2}; between kick and drift every quantity "at t_n" is known and observers are called; the drift
// brings positions to t_{n+1}.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/rotation.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/state/registry.hpp"
#include "kardan/state/results.hpp"

namespace kardan {

struct Clock {
  std::int64_t cycle = 0;
  double time = 0;         ///< t_n
  double dt = 0;           ///< t_{n+1} - t_n, of the drift to come
  double dt_previous = 0;  ///< t_n - t_{n-1}; 0 at the start

  std::uint64_t relaxing = 0;  ///< 1: in the dynamic relaxation before t = 0

  /// Length of the kick at t_n: half the step before and half the step after.
  double kick() const { return 0.5 * (dt_previous + dt); }
  /// Share of the kick that belongs to the time before t_n: v_n = v_{n-1/2} + share (v_{n+1/2} - v_{n-1/2}).
  double share_before() const { return dt_previous / (dt_previous + dt); }
};

/// One entry a node, in the model's order. Nodes of rigid bodies: x and v are made from the body when somebody needs them.
struct NodeState {
  std::vector<Vec3> x;               ///< positions at t_n                      (nodes.drift, rigid.drift)
  std::vector<Vec3> v;               ///< velocities at t_{n-1/2}, after the kick t_{n+1/2}
  std::vector<Vec3> omega;           ///< angular velocities, likewise
  std::vector<Vec3> v_now;           ///< velocities at t_n, valid between kick and drift of a cycle that an observer looks at
  std::vector<Vec3> a;               ///< accelerations at t_n, likewise
  std::vector<Vec3> omega_now, alpha;///< angular velocities and accelerations at t_n of deformable nodes, likewise (for output)
  std::vector<Vec3> force;           ///< sum of all forces at t_n              (nodes.kick; of free nodes valid like v_now)
  std::vector<Vec3> moment;          ///< sum of all moments at t_n
  std::vector<double> mass;          ///< lumped mass
  std::vector<double> inertia;       ///< lumped isotropic rotary inertia
  std::vector<BodyIndex> body;       ///< rigid body the node belongs to, `none` if deformable
  std::vector<std::uint8_t> needed;  ///< 1: somebody reads or loads this node every cycle, so a rigid body keeps it current;
                                     ///< the other nodes of bodies are brought up to date only for output

  void resize(std::size_t n) {
    for (auto* a3 : {&x, &v, &omega, &v_now, &a, &omega_now, &alpha, &force, &moment}) a3->assign(n, Vec3{});
    mass.assign(n, 0.0);
    inertia.assign(n, 0.0);
    body.assign(n, none);
    needed.assign(n, 0);
  }
};

/// Motion of one rigid body (paper eqs. 1-13). Orientation turns the principal axes at t_n into global axes.
struct BodyMotion {
  Vec3 center;             ///< centre of mass at t_n
  Quat orientation;        ///< principal axes -> global at t_n
  Vec3 velocity;           ///< of the centre, half step
  Vec3 angular_momentum;   ///< about the centre, global components, half step
  Vec3 angular_velocity;   ///< global components, half step
};

/// What is reported of a body at t_n (RBDOUT); valid between kick and drift.
struct BodyReport {
  Vec3 velocity, angular_velocity;          ///< at t_n
  Vec3 acceleration, angular_acceleration;  ///< at t_n
  Vec3 force, moment;                       ///< applied resultants at t_n, joints left out
};

/// What stays the same of a body.
struct BodyInfo {
  UserId id = 0;           ///< part id of the lead part, or PID of a nodal rigid body
  bool nodal = false;      ///< *CONSTRAINED_NODAL_RIGID_BODY
  PartIndex part = none;   ///< lead part; none for nodal rigid bodies
  double mass = 0;
  Vec3 principal_inertia;
  Vec3 initial_center;
  Quat initial_orientation;  ///< principal axes -> global at t = 0
};

struct BodyState {
  std::vector<BodyInfo> info;
  std::vector<BodyIndex> of_part;  ///< body of each part of the model (merged parts share one), `none` if deformable
  std::vector<BodyMotion> motion;
  std::vector<BodyReport> report;
  std::vector<Vec3> force, moment;  ///< resultants being summed for the kick at t_n: loads write, rigid adds the nodes'
};

/// What a joint reports at t_n (JNTFORC): force and moment that body A exerts on body B at point 2, global components.
struct JointReport {
  Vec3 force, moment;
  double separation = 0;        ///< distance of the joint's points from where the joint wants them
  double angular_separation = 0;///< radians
  double energy = 0;            ///< stored in the penalty springs plus dissipated by their dampers
  std::uint8_t failed = 0;
};

/// What a joint stiffness reports at t_n (JNTFORC type 0/1).
struct JointStiffnessReport {
  std::array<double, 3> coordinate{}, rate{};             ///< radians (length) and radians/time
  std::array<double, 3> elastic{}, damping{}, total{};    ///< moments (forces)
  ///< flexion-torsion: elastic[1] is the factor that gamma puts on alpha's moment
  double energy = 0;                                      ///< stored plus dissipated
};

/// Reaction of a *BOUNDARY_SPC (SPCFORC) or of a prescribed motion (BNDOUT) at t_n, global components.
struct ReactionReport {
  enum class Kind : std::uint8_t { single_point_constraint, motion_of_node, motion_of_body } kind =
      Kind::single_point_constraint;
  UserId id = 0;           ///< of the constraint or motion; 0 = none given
  NodeIndex node = none;
  BodyIndex body = none;
  Vec3 force, moment;
  double work = 0;         ///< done on the model so far
};

/// DEFORC of one discrete element at t_n.
struct DiscreteReport {
  double force = 0, elongation = 0;  ///< moment and rotation for torsional elements
  Vec3 global_force;                 ///< on node 2
};

/// SECFORC of one cross section at t_n: what its nodes exert on its elements, in the axes of its frame.
struct SectionReport {
  Vec3 force, moment;  ///< moment about the centroid
  Vec3 centroid;       ///< mean of the nodes' positions, global
};

/// RCFORC, SLEOUT and NCFORC of one contact at t_n.
struct ContactReport {
  Vec3 force;                    ///< on the tracked side; the reference side gets the opposite
  Vec3 moment;                   ///< of those forces about the origin
  double tracked_energy = 0;     ///< work of the contact's springs and dampers against the tracked side's nodes, so far; with …
  double reference_energy = 0;   ///< … that against the nodes of the reference side: what the contact stores and dissipates, friction included
  double friction_energy = 0;    ///< dissipated by friction, so far: part of the two above
  std::int64_t touching = 0;     ///< pairs of node and segment in touch
  std::int64_t rebuilds = 0;     ///< of the list of candidates, so far
  /// Forces of this contact on its nodes, by entry of `nodes`; only where SPR or MPR ask for them, valid where somebody looks.
  std::array<std::vector<NodeIndex>, 2> nodes;  ///< tracked, reference side: ascending, fixed
  std::array<std::vector<Vec3>, 2> nodal_force;
  std::array<std::vector<double>, 2> nodal_area;  ///< their share of the segments' area at t = 0: a third of a triangle, a quarter of a quadrilateral
  std::array<std::vector<std::array<NodeIndex, 4>>, 2> segments;  ///< of those sides; a triangle repeats its third node; fixed
};

/// RWFORC of one rigid wall at t_n.
struct WallReport {
  UserId id = 0;
  Vec3 force;                       ///< of the nodes on the wall
  double normal_force = 0;          ///< sum of the pressing forces on the nodes, each along its normal
  Vec3 eased_force;                 ///< like `force`, the impulses of arriving nodes handed out over some cycles: what RWFORC shows
  double eased_normal_force = 0;    ///< like `normal_force`, likewise
  double energy = 0;                ///< taken from the nodes so far: impact, friction and what penalty springs hold
  Vec3 displacement, velocity;      ///< of the wall
  std::vector<Vec3> segment_force;  ///< by segment of a wall that has some, like `force`; valid where somebody looks
};

/// SWFORC of one weld at t_n.
struct WeldReport {
  enum class Kind : std::uint8_t { constrained, generalized, beam } kind = Kind::constrained;
  UserId id = 0;             ///< of the constraint or element
  double axial = 0;          ///< force along the weld, tension positive
  double shear = 0;          ///< resultant force across it
  double moment = 0, torsion = 0;  ///< of beams: resultant bending moment, twisting moment
  double length = 0;         ///< distance of its nodes
  bool failed = false;
  double failure_time = 0;   ///< of those that have failed
};

/// Energies at t_n by the classes GLSTAT prints, per part where a part has it.
///
/// Accounting, every cycle between kick and drift: the solver first calls begin(), which zeroes what is a snapshot at t_n;
/// then every system adds (+=) its share. external_work and the eroded energies are running sums and are never zeroed.
struct EnergyLedger {
  void begin(std::size_t parts) {
    part_kinetic.assign(parts, 0.0);
    part_internal.assign(parts, 0.0);
    part_hourglass.assign(parts, 0.0);
    resolution = 0;
    kinetic = internal = spring_damper = hourglass = system_damping = sliding = joint = stopper = stonewall = 0;
  }

  std::vector<double> part_kinetic, part_internal, part_hourglass;  ///< by part of the model
  std::vector<double> part_mass;   ///< of deformable parts, for MATSUM and D3PLOT; may be empty (rigid: from the body)
  std::vector<Vec3> part_momentum; ///< likewise
  double kinetic = 0, internal = 0, spring_damper = 0, hourglass = 0, system_damping = 0, sliding = 0;
  double external_work = 0, joint = 0, stopper = 0, stonewall = 0, eroded_kinetic = 0, eroded_internal = 0;
  double initial = 0;  ///< total at t = 0
  double initial_joint_loss = 0;  ///< kinetic energy removed at t = 0 where initial velocities contradicted the joints

  double total() const {
    return kinetic + internal + spring_damper + hourglass + system_damping + sliding + joint + stopper + stonewall +
           eroded_kinetic + eroded_internal;
  }
  /// What the applied forces would give the bodies in one step from rest: less than that is rounding, not energy.
  double resolution = 0;

  /// GLSTAT's energy ratio total / (initial + external work); 1 where there is no energy to speak of.
  double ratio() const {
    const double base = initial + external_work;
    return base != 0 && (std::abs(base) > resolution || std::abs(total()) > resolution) ? total() / base : 1.0;
  }
};

/// Mass scaling (DT2MS of *CONTROL_TIMESTEP).
struct AddedMass {
  double physical = 0;  ///< of the whole model
  double added = 0;     ///< so far; negative where DT2MS > 0 took some away

  double percent() const { return physical > 0 ? 100 * added / physical : 0.0; }
};

struct State {
  Clock clock;
  NodeState nodes;
  BodyState bodies;
  std::vector<JointReport> joints;
  std::vector<JointStiffnessReport> joint_stiffnesses;
  std::vector<DiscreteReport> discretes;     ///< by discrete element
  std::vector<ReactionReport> reactions;
  std::vector<SectionReport> sections;       ///< by cross section, valid between kick and drift of a cycle that is looked at
  std::vector<WallReport> walls;             ///< by rigid wall of the model
  std::vector<ContactReport> contacts;       ///< by contact of the model
  std::vector<WeldReport> welds;             ///< of elements, then constraints; current between kick and drift of a cycle that is looked at
  EnergyLedger energy;
  AddedMass added_mass;
  ElementResults results;
  TimeStepOwner step_owner;
  Registry registry;
};

}  // namespace kardan

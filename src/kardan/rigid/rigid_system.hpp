// Rigid bodies, their joints, stiffnesses, prescribed motions and stoppers: the stage `rigid` of the step.
#pragma once

#include <memory>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// How the joints of a run are held.
enum class JointHolding {
  exact,   ///< Lagrange multipliers on all joints together, position level (SHAKE/RATTLE)
  penalty  ///< eq. (14) of the paper, stiffness from the effective mass
};

class RigidSystem {
 public:
  /// Makes the bodies and joints of the model. Lumped masses must stand in state.nodes.mass. Fills state.bodies,
  /// state.nodes.body, state.joints, state.joint_stiffnesses and adds to state.reactions.
  /// Errors (zero mass, a node in two bodies, joint nodes on no body …) go to `diagnostics`; with an error the system
  /// must not be used.
  RigidSystem(const Model& model, State& state, JointHolding holding, Diagnostics& diagnostics);
  ~RigidSystem();
  RigidSystem(RigidSystem&&) noexcept;
  RigidSystem& operator=(RigidSystem&&) noexcept;

  /// Velocities of the bodies at t = 0 from the velocities of their nodes (by momentum), from *PART_INERTIA and from
  /// *INITIAL_VELOCITY_RIGID_BODY; then the prescribed motions and the joints are imposed on them, and a notice says how
  /// much kinetic energy that took. Call once, after the nodes have their initial velocities.
  void set_initial_velocities(const Model& model, State& state, Diagnostics& diagnostics);

  /// Largest dt the rotation of the bodies allows (|omega| dt <= 1/2); infinity if nothing turns.
  double stable_time_step(const State& state) const;
  /// Step for decks in which nothing else sets one: a 1/20,000 of the end time.
  double default_time_step(const Model& model, const State& state) const;

  /// Adds the resultants of state.nodes.force and .moment (needed nodes) to state.bodies.force and .moment. Once a cycle.
  void gather_forces(State& state) const;
  /// Momenta to t_{n+1/2}: gathered forces, joint stiffnesses, joints. @throws RunError naming the body where |omega| dt > 1 or a value is not finite.
  void kick(const Model& model, State& state);
  /// Poses to t_{n+1}, and with them x of the needed nodes.
  void drift(const Model& model, State& state);
  /// Brings x, v, omega, v_now and a of all nodes of bodies, and the joints' reports, up to date at t_n (before output).
  void update_reports(const Model& model, State& state) const;
  /// Every cycle after kick(): work of motions and motors up to t_n into state.energy.external_work. In every one, so that its rounding does not
  /// depend on who looks when.
  void account_work(State& state);
  /// Reports of the bodies and energies at t_n into state.bodies.report and state.energy: kinetic energy of the bodies by
  /// part, joints, stoppers. Needed only in cycles that somebody looks at; call it after kick()
  /// and before update_reports().
  void account(const Model& model, State& state);

  /// Largest separation of any joint so far, and the joint's index (none if there is no joint).
  struct Separation {
    double distance = 0, angle = 0;
    Index joint = none;
  };
  Separation largest_separation() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kardan

// Body forces, nodal and rigid-body loads, pressure, damping, ties, single point constraints, prescribed motion and initial velocities: the stage
// `loads` of the step.
#pragma once

#include <memory>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class LoadSystem {
 public:
  /// Sets state.nodes.v and .omega of all nodes from *INITIAL_VELOCITY, _NODE and _GENERATION; later entries override
  /// earlier ones. Nodes of rigid bodies get them too: the bodies take the mean by momentum. *INITIAL_VELOCITY_RIGID_BODY
  /// belongs to the bodies and is left alone.
  static void set_initial_velocities(const Model& model, State& state, Diagnostics& diagnostics);

  /// Resolves what acts where. The bodies must stand in state.bodies.info and .of_part and state.nodes.body, the lumped
  /// masses in state.nodes.mass. Marks state.nodes.needed and appends to state.reactions.
  LoadSystem(const Model& model, State& state, Diagnostics& diagnostics);
  ~LoadSystem();
  LoadSystem(LoadSystem&&) noexcept;
  LoadSystem& operator=(LoadSystem&&) noexcept;

  /// At t_n: adds to state.nodes.force and .moment and to state.bodies.force and .moment (about the centre).
  void apply(const Model& model, State& state);

  /// Right after the kick of the free nodes and before that of the bodies, whose resultants must be complete: damping and
  /// non-reflecting boundaries, whose forces follow from the velocities on both sides of the kick.
  void damp(const Model& model, State& state);

  /// Right after the deformable nodes were kicked to t_{n+1/2}: ties nodes to one another, takes out the constrained velocities and imposes the
  /// prescribed ones, so that a prescribed displacement is exact at t_{n+1}. Reactions at t_n go to state.reactions.
  /// Nodes of rigid bodies are not touched: their constraints are the bodies'.
  void constrain_velocities(const Model& model, State& state);

  /// Between kick and drift, with state.nodes.v at t_{n+1/2} and the bodies' velocities likewise: work of the loads and of
  /// the reactions of prescribed motion up to t_n into state.energy.external_work, of damping into .system_damping.
  void account(const Model& model, State& state);

  /// Time and work begin anew (after a dynamic relaxation); supports and ties are imposed on the velocities in the state.
  void restart(const Model& model, State& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kardan

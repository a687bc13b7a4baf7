// Finite elements and discrete elements: the stage `elements` of the step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/governing.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ElementSystem {
 public:
  /// Adds the lumped masses of all elements, rigid ones too, and of point masses to state.nodes.mass, the rotary inertia
  /// of deformable shells to state.nodes.inertia; marks state.nodes.needed for every node a deformable or discrete
  /// element touches; sizes state.discretes and the energies by part; registers the elements' history in state.registry.
  /// state.nodes must be sized and state.nodes.x set.
  /// Errors (a deformable material that this version does not compute, an element without area or volume, a part without
  /// section …) go to `diagnostics`; with an error the system must not be used.
  ElementSystem(const Model& model, State& state, Diagnostics& diagnostics);
  ~ElementSystem();
  ElementSystem(ElementSystem&&) noexcept;
  ElementSystem& operator=(ElementSystem&&) noexcept;

  /// At t_n, with velocities at t_{n-1/2} and state.clock.dt_previous: stresses and spring forces are brought to t_n. The forces
  /// that springs exert ON the nodes are added to state.nodes.force and .moment; those of tiles wait for add_forces(). Call once a
  /// cycle.
  /// @throws RunError naming the element whose area vanished or whose force is not finite.
  void internal_forces(const Model& model, State& state);

  /// Right after internal_forces(): mass scaling (mass_scaling.hpp). @return nodes whose mass or rotary inertia has changed, with repeats
  const std::vector<NodeIndex>& scale_masses(const Model& model, State& state);
  /// From now on elements whose stable step (without TSSFAC) is below `step` are deleted where *CONTROL_TIMESTEP ERODE asks for it.
  void erode_below(double step);

  /// Shells, solids and beams deleted so far, and whether an element of the model is left.
  std::int64_t deleted() const;
  bool alive(ElementKind kind, Index element) const;

  /// Adds the forces of the tiles on the nodes begin <= n < end to state.nodes.force and .moment. Several threads may do so for
  /// nodes of their own.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const;

  /// Largest stable step at t_n of the deformable and discrete elements, without TSSFAC; +infinity if there are none.
  /// Valid after internal_forces().
  double stable_time_step() const;
  /// The element that stable_time_step() belongs to.
  Governing governing() const;

  /// Smallest step the elements of rigid parts would have if they were deformable (E, nu, density of their *MAT_RIGID),
  /// +infinity if there are none: LS-DYNA takes it for decks with nothing deformable.
  double rigid_courant_time_step(const Model& model, const State& state) const;

  /// What D3PLOT and ELOUT show of the elements at t_n, into state.results.
  void report(const Model& model, State& state) const;

  /// Between kick and drift: internal and hourglass energies by part and in sum, and the energy of springs and dampers,
  /// at t_n, into state.energy.
  void account(const Model& model, State& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kardan

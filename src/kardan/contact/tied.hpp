// Tied contacts and tiebreaks: *CONTACT_TIED_…, *CONTACT_SPOTWELD…, *CONTACT_…TIEBREAK. Nodes that begin on a segment stay there: without a spring
// between (kinematic_ties.hpp) or held by springs (tie_springs.hpp), as the keyword's suffix says.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/kinematic_ties.hpp"
#include "kardan/contact/surface.hpp"
#include "kardan/contact/tie_springs.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class TiedContacts {
 public:
  /// Finds the tied nodes; marks nodes of bodies as needed. Bodies and lumped masses must stand in the state.
  TiedContacts(const Model& model, State& state, Diagnostics& diagnostics);

  /// Room for the forces of single nodes in state.contacts, which must stand.
  void size_reports(const Model& model, State& state) const;
  /// After the initial velocities: masses and momenta of nodes without springs go to their segments.
  void take_masses(State& state) { kinematic_.take_masses(state); }
  /// After mass scaling, likewise. @return nodes whose mass has changed
  const std::vector<NodeIndex>& pass_on_masses(State& state) { return kinematic_.pass_on_masses(state); }

  /// Some elements have been deleted: ties of nodes that have no element left, and on segments of deleted elements, end, with a line in the log.
  /// @return whether masses have come back to nodes
  bool drop_deleted(const Model& model, State& state, const Alive& alive);

  bool empty() const { return kinematic_.empty() && springs_.empty(); }
  /// Forces of springs at t_n.
  void apply(const Model& model, State& state) { springs_.apply(model, state); }
  /// Right after the kick of the free nodes. @return an upper bound of the speeds of the nodes of segments now
  double transfer(State& state) { return kinematic_.transfer(state); }
  /// After the velocities of the free nodes were constrained.
  void follow(State& state) { kinematic_.follow(state); }
  /// In a cycle that is looked at: velocities and accelerations at t_n.
  void settle(State& state) const { kinematic_.settle(state); }
  /// Every cycle: energies of springs up to t_n into state.contacts.
  void account(State& state) { springs_.account(state); }
  /// In a cycle that is looked at, after the other contacts have reported: forces into state.contacts, energies into state.energy.
  void report(State& state) const;
  /// After the drift of all other nodes.
  void drift(State& state);
  void restart() { springs_.restart(); }

  /// Nodes of contact `contact` of the model that springs hold.
  const TieHold& hold(std::size_t contact) const { return springs_.hold(contact); }

 private:
  std::vector<std::size_t> for_good_;  ///< contacts that never break, into Model::contacts
  KinematicTies kinematic_;
  TieSprings springs_;
};

}  // namespace kardan

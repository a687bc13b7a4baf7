// All contacts of a model: the stage `contact` of the step.
#pragma once

#include <memory>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/penalty.hpp"
#include "kardan/contact/tied.hpp"
#include "kardan/contact/transducer.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ContactSystem {
 public:
  /// Sizes state.contacts, marks the nodes that contacts look at in state.nodes.needed and registers what contacts remember. Masses and bodies
  /// must stand in the state, positions at t = 0. Warns of initial penetrations and of sides without segments.
  /// `ties`, which must outlive the system, says which nodes of tiebreaks are held still: they touch nothing in their contact.
  ContactSystem(const Model& model, State& state, const TiedContacts& ties, Diagnostics& diagnostics);
  ~ContactSystem();
  ContactSystem(const ContactSystem&) = delete;
  ContactSystem& operator=(const ContactSystem&) = delete;

  bool empty() const { return penalties_.empty(); }
  /// At t_n, with the step to come in state.clock.dt: forces of all contacts into state.nodes.force, energies up to t_n into state.contacts.
  void apply(State& state);
  /// Between kick and drift of a cycle that somebody looks at: the rest of state.contacts, and state.energy.sliding.
  void account(State& state) const;
  /// After a dynamic relaxation: energies begin at zero.
  void restart(State& state) const;
  /// Some elements have been deleted: segments of theirs drop out. `alive(kind, element of the model)` says which are left.
  void drop_deleted(const Alive& alive);

 private:
  void find_masses(const State& state);
  void crowd_bodies(const State& state);
  void add_forces(State& state) const;

  const Model& model_;
  std::vector<std::unique_ptr<PenaltyContact>> penalties_;
  std::vector<Transducer> transducers_;
  std::vector<double> inverse_mass_;            ///< by node of the model, as stiffnesses of contacts see it
  std::vector<double> single_;                  ///< of nodes of bodies: with one touch on the body
  std::vector<std::vector<NodeIndex>> of_body_; ///< nodes of contacts on each body
  std::vector<std::uint64_t> crowd_, touches_;  ///< by body: touches that stiffnesses reckon with; those there are
};

}  // namespace kardan

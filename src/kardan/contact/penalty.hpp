// One *CONTACT by penalty: its surfaces, who is kept out of whom, energies and reports.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/edge_contact.hpp"
#include "kardan/contact/motion_meter.hpp"
#include "kardan/contact/penalty_pass.hpp"
#include "kardan/contact/tie_springs.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class PenaltyContact {
 public:
  /// Makes the surfaces, finds what touches at t = 0 and warns of initial penetrations. `inverse_mass` by node, see contact_masses.hpp.
  /// Nodes that `hold`, which must outlive the contact, holds touch nothing, and nothing touches their segments.
  PenaltyContact(const Model& model, State& state, Index contact, const TieHold& hold, Diagnostics& diagnostics);
  PenaltyContact(const PenaltyContact&) = delete;
  PenaltyContact& operator=(const PenaltyContact&) = delete;

  /// A direction of the contact. In a `reversed` one nodes of the reference side meet segments of the tracked side.
  struct Direction {
    PenaltyPass pass;
    bool reversed = false;
  };

  Index index() const { return contact_; }
  const std::vector<std::unique_ptr<Direction>>& directions() const { return directions_; }
  /// Edges among themselves; null where the contact does not look at them.
  const EdgeContact* edges() const { return edges_.get(); }
  /// Nodes of both surfaces, ascending.
  std::vector<NodeIndex> nodes() const;

  /// Touches and forces at t_n; energies up to t_n.
  void evaluate(State& state, const std::vector<double>& inverse_mass);
  /// Report at t_n.
  void report(State& state) const;
  /// Elements have died: their segments, and nodes without segments, drop out; where the contact erodes, faces laid bare join.
  void drop_deleted(const Alive& alive);

 private:
  const Contact& contact() const { return model_.contacts[contact_]; }
  void register_state(Registry& registry);
  TouchFrame frame(const State& state, bool birth) const;
  void search(const State& state);
  void add_energy(const Direction& direction, const PassEnergy& energy, ContactReport& report);
  void size_report(State& state) const;
  void report_nodes(ContactReport& report, const Direction& direction, const Touch& touch, const Segment& segment) const;
  void report_edges(ContactReport& report) const;
  void warn_of_penetrations(const State& state, Diagnostics& diagnostics) const;
  const Model& model_;
  Index contact_;
  std::array<Surface, 2> surfaces_;   ///< tracked, reference
  std::vector<std::unique_ptr<Direction>> directions_;
  std::unique_ptr<EdgeContact> edges_;
  PenaltyLaw law_;
  MotionMeter meter_;
  double size_ = 0;                   ///< mean size of segments
  double margin_ = 0;
  std::int64_t cycles_ = 0;           ///< since the last search
  std::uint64_t born_ = 0;
  const TieHold& hold_;
  std::uint64_t releases_ = 0;        ///< of hold_, that the candidates know of
  bool renew_ = true;
};

}  // namespace kardan

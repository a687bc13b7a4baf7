// One *CONTACT by penalty: its surfaces, who is kept out of whom, energies and reports.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/motion_meter.hpp"
#include "kardan/contact/penalty_pass.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class PenaltyContact {
 public:
  /// Makes the surfaces, finds what touches at t = 0 and warns of initial penetrations. `inverse_mass` by node, see contact_masses.hpp.
  PenaltyContact(const Model& model, State& state, Index contact, Diagnostics& diagnostics);
  PenaltyContact(const PenaltyContact&) = delete;
  PenaltyContact& operator=(const PenaltyContact&) = delete;

  /// A direction of the contact. In a `reversed` one nodes of the reference side meet segments of the tracked side.
  struct Direction {
    PenaltyPass pass;
    bool reversed = false;
  };

  Index index() const { return contact_; }
  const std::vector<std::unique_ptr<Direction>>& directions() const { return directions_; }
  /// Nodes of both surfaces, ascending.
  std::vector<NodeIndex> nodes() const;

  /// Touches and forces at t_n; energies up to t_n.
  void evaluate(State& state, const std::vector<double>& inverse_mass);
  /// Report at t_n.
  void report(State& state) const;
  /// Elements have died: `alive(kind, element)` says which are left.
  template <class Alive>
  void drop_deleted(Alive&& alive) {
    for (const auto& d : directions_) drop_segments(d->pass, alive);
    renew_ = true;
  }

 private:
  const Contact& contact() const { return model_.contacts[contact_]; }
  TouchFrame frame(const State& state, bool birth) const;
  void search(const State& state);
  void add_energy(const Direction& direction, const PassEnergy& energy, ContactReport& report);
  void size_report(State& state) const;
  void report_nodes(ContactReport& report, const Direction& direction, const Touch& touch, const Segment& segment) const;
  void warn_of_penetrations(const State& state, Diagnostics& diagnostics) const;
  template <class Alive>
  static void drop_segments(PenaltyPass& pass, Alive&& alive) {
    const auto& segments = pass.segments().segments();
    pass.dead_segment.resize(segments.size(), 0);
    for (std::size_t s = 0; s < segments.size(); ++s)
      if (!pass.dead_segment[s] && segments[s].element != none && !alive(segments[s].kind, segments[s].element)) pass.dead_segment[s] = 1;
    const Surface& nodes = pass.nodes();
    pass.dead_node.resize(nodes.nodes().size(), 0);
    for (std::size_t p = 0; p < pass.dead_node.size(); ++p) {
      const auto own = nodes.segments_at(static_cast<Index>(p));
      pass.dead_node[p] = !own.empty() && std::all_of(own.begin(), own.end(), [&](Index s) {
        const Segment& segment = nodes.segments()[s];
        return segment.element != none && !alive(segment.kind, segment.element);
      });
    }
  }

  const Model& model_;
  Index contact_;
  std::array<Surface, 2> surfaces_;   ///< tracked, reference
  std::vector<std::unique_ptr<Direction>> directions_;
  PenaltyLaw law_;
  MotionMeter meter_;
  double size_ = 0;                   ///< mean size of segments
  double margin_ = 0;
  std::int64_t cycles_ = 0;           ///< since the last search
  std::uint64_t born_ = 0;
  bool renew_ = true;
};

}  // namespace kardan

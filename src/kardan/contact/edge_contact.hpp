// Edges against edges (*CONTACT_AUTOMATIC_GENERAL): beams, and edges of shells that no other shell of the surface shares.
//
// Two edges touch at every local minimum of their distance, as nodes and segments do (touch_finder.hpp): if the closest point of one lies in an end that another edge
// shares, the nearer of the two pairs counts, or the first. With u between the closest points, d = |u| and t the sum of the radii, the penetration is t - d along u, or
// t + d along -u where the edges have gone through each other, which they remember. Between shells only insides of edges meet: ends are nodes, which meet segments
// anyway. Closest points of two lines: Ericson, Real-Time Collision Detection 2005, section 5.1.9. Forces are those of penalty_law.hpp.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "kardan/contact/motion_meter.hpp"
#include "kardan/contact/penalty_law.hpp"
#include "kardan/contact/penalty_pass.hpp"
#include "kardan/contact/surface.hpp"

namespace kardan {

/// Two edges in touch; the force acts on the first, its opposite on the second. Without gaps, for the hash of the state.
struct EdgeTouch {
  Index first = none, second = none;
  double s = 0, t = 0;             ///< places of the closest points: 0 first node, 1 second node
  Touch touch;                     ///< direction, force, friction, penetration, offset
};

class EdgeContact {
 public:
  /// Edges of one surface among themselves.
  EdgeContact(const Model& model, const Surface& surface);

  /// Touches and forces at t_n. @return energies of the step that ends there; all of it is of one surface
  PassEnergy evaluate(const State& state, bool birth, const PenaltyLaw& law, const std::vector<double>& inverse_mass);
  /// Energies of the step with the forces of its begin only; then no touches are left.
  PassEnergy end(const State& state);
  void drop_dead(const Alive& alive);
  void register_state(Registry& registry, const std::string& name);

  std::size_t touches() const { return touches_.size(); }
  /// f(nodes of the first edge, shares, nodes of the second, shares, force on the first) for all touches, in order.
  template <class F>
  void for_each(F&& f) const {
    for (const EdgeTouch& t : touches_)
      f(edges_[t.first].nodes, std::array{1 - t.s, t.s}, edges_[t.second].nodes, std::array{1 - t.t, t.t}, t.touch.force);
  }

 private:
  struct Edge {
    std::array<NodeIndex, 2> nodes{};
    double radius = 0, stiffness = 0, area = 0;
    PartIndex part = none;
    Index element = none;
    ElementKind kind = ElementKind::shell;
    bool dead = false;
  };
  struct Pair {
    Index first = none, second = none;
    double wake = 0;               ///< travel before which they cannot touch
  };
  /// Closest points of a pair.
  struct Place {
    std::size_t pair = 0;
    double s = 0, t = 0, distance = 0;
    Vec3 u;                        ///< from the second edge to the first
  };

  void add_beams(const Model& model, const Surface& surface);
  void add_free_edges(const Model& model, const Surface& surface);
  void search(const State& state);
  Place look(const State& state, std::size_t pair) const;
  bool is_minimum(const Place& place) const;
  bool meets(const Place& place) const;
  const EdgeTouch* recall(const Place& place) const;
  EdgeTouch decide(const State& state, const Place& place, bool birth) const;
  TouchMotion motion(const State& state, const EdgeTouch& touch, const std::vector<double>& inverse_mass) const;
  double work(const State& state) const;

  std::vector<Edge> edges_;
  MotionMeter meter_;
  double margin_ = 0;
  bool renew_ = true;
  std::vector<Pair> pairs_;
  std::vector<Place> places_;      ///< work space
  std::vector<EdgeTouch> touches_, before_;
};

}  // namespace kardan

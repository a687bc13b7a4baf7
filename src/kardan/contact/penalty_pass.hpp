// The nodes of one surface against the segments of one: candidates, touches and their forces.
//
// Nodes are worked on in chunks, in parallel; touches stand in the order of the nodes, and everything that is summed, is summed in that order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kardan/base/aligned.hpp"
#include "kardan/contact/penalty_law.hpp"
#include "kardan/contact/search.hpp"
#include "kardan/contact/surface.hpp"
#include "kardan/contact/touch_finder.hpp"
#include "kardan/parallel/shares.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Energies of one step: minus the work of the contact's forces on the nodes, trapezoidal in time.
struct PassEnergy {
  double nodes = 0, segments = 0;  ///< on the tracked nodes, on the corners of segments
  double friction = 0;             ///< dissipated by friction
};

/// By place: 1 where neither a segment nor a beam is left at a node. Nodes of a side of nodes stay.
std::vector<std::uint8_t> dead_nodes(const Model& model, const Surface& surface, const Alive& alive);

class PenaltyPass {
 public:
  /// The surfaces must outlive the pass.
  PenaltyPass(const Model& model, const Surface& nodes, const Surface& segments);

  const Surface& nodes() const { return *nodes_; }
  const Surface& segments() const { return *segments_; }

  /// Lists the candidates anew; `frame` is that of the cycle. @param held  by node of the model: 1 leaves the node and its segments out; may be empty
  void search(const State& state, const TouchFrame& frame, const std::vector<std::uint8_t>& held);
  /// Touches and forces at t_n. @param inverse_mass  1/mass by node of the model, as stiffnesses see it
  /// @return energies of the step that ends at t_n
  PassEnergy evaluate(const State& state, const TouchFrame& frame, PenaltyLaw& law, const std::vector<double>& inverse_mass);
  /// Energies of the step with the forces of its begin only; then no touches are left.
  PassEnergy end(const State& state);

  /// Adds the touches' forces to those of the nodes begin <= n < end of the model, in the order of the touches.
  void add_forces(std::vector<Vec3>& force, NodeIndex begin, NodeIndex end) const;
  /// f(const Touch&) for all touches with a share of force, in order.
  template <class F>
  void for_each(F&& f) const {
    for (const Chunk& chunk : chunks_)
      for (const Touch& t : chunk.touches)
        if (t.share > 0) f(t);
  }
  /// Those without a share included.
  std::size_t touches() const;

  /// Segments of deleted elements drop out of the next search, and dead_nodes().
  /// Call it too after Surface::expose().
  void drop_dead(const Model& model, const Alive& alive);

  void register_state(Registry& registry, const std::string& name);

 private:
  /// Nodes begin <= place < end.
  struct alignas(cache_line) Chunk {
    Index begin = 0, end = 0;
    std::vector<Index> active;         ///< places of nodes that have candidates
    std::vector<float> wake;           ///< of them: travel before which none of the candidates can be touched
    std::vector<Touch> touches;
    PassEnergy energy;
  };
  /// What a thread works with.
  struct alignas(cache_line) Desk {
    TouchFinder finder;
    std::vector<Touch> before;         ///< touches of the cycle before
  };

  void take_stiffnesses();
  void wake_touched(Chunk& chunk);
  void list_active(Chunk& chunk) const;
  void weigh();
  void find_touches(const State& state, const TouchFrame& frame, Desk& desk, Chunk& chunk);
  void push_all(const State& state, const TouchFrame& frame, const PenaltyLaw& law, const std::vector<double>& inverse_mass, Chunk& chunk) const;
  double force_of_penetration(const PenaltyLaw& law) const;
  void push(const TouchFrame& frame, const PenaltyLaw& law, const std::vector<double>& inverse_mass, std::size_t first, std::size_t end,
            Chunk& chunk) const;
  void add_work(const State& state, const Touch& touch, PassEnergy& energy) const;
  PassEnergy sum_energies() const;

  const Surface* nodes_;
  const Surface* segments_;
  std::vector<std::array<double, 4>> corner_stiffness_;  ///< by segment
  std::vector<std::uint8_t> dead_segment_, dead_node_;   ///< by segment and by place of a node; empty where none is dead
  CandidateSearch search_;
  Candidates candidates_;
  std::vector<Chunk> chunks_;
  std::vector<double> weights_;       ///< of the chunks: about how much work each is
  Shares shares_;
  std::vector<Desk> desks_;           ///< one a thread
};

}  // namespace kardan

// Deformable elements of one kind of connectivity: tiles, histories, the loop over tiles, energies, deletion, stable step. A folder of
// formulations (shell, solid, beam) says which kernel computes a part and what it is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kardan/base/aligned.hpp"
#include "kardan/elements/governing.hpp"
#include "kardan/elements/tiles/tile_work.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/model/model.hpp"
#include "kardan/parallel/shares.hpp"
#include "kardan/parallel/tile.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// How the elements of a part are computed.
struct PartKernel {
  TileKernel kernel = nullptr;
  std::shared_ptr<const void> properties;  ///< of the type that the kernel knows
  std::size_t history_size = 0;            ///< values of an element
  bool can_fail = false;                   ///< its elements may be deleted
  double smallest_step = 0;                ///< then also where the stable step falls below it
  bool erodes = false;                     ///< and are, where their stable step falls below TileElements::erode_below()
};

/// How many of an element's points must fail before it is deleted.
double failing_points(const ElementDeletion& deletion, int points);

/// The entry of a formulation for a law.
TileKernel kernel_for(const TileKernels& kernels, const Law& law);

/// What is tiled. The spans must outlive the TileElements, but for TileInput::elements and ::nodes.
struct TileElementsInput {
  std::string name;                ///< of the arrays in the registry: "shells"
  const char* element_name = "";   ///< "shell", for messages
  ElementKind kind = ElementKind::shell;
  std::span<const UserId> ids;     ///< by element of the model
  TileInput tiles;
  std::size_t components = 3;      ///< of the nodal forces: 3, or 6 with moments
  bool energies = false;           ///< keep the internal energy of every element, not only of those that can be deleted
};

class TileElements {
 public:
  TileElements(const TileElementsInput& input, std::size_t node_count);

  bool empty() const { return mesh_.empty(); }
  ElementKind kind() const { return input_.kind; }
  /// Parts that have elements here, ascending.
  std::vector<PartIndex> parts() const;

  /// Set-up, once: every part's kernel, then start(), then for_each() to fill the histories, which are zero.
  void set_kernel(PartIndex part, PartKernel kernel);
  /// A value of every local node of all tiles that kernels read as the fourth of the node's position; empty: none.
  std::vector<double>& node_values() { return node_values_; }
  const TileMesh& mesh() const { return mesh_; }
  /// From now on elements of parts that erode are deleted where their stable step is below `step`.
  void erode_below(double step) { erode_below_ = step; }
  /// After start(): masses of elements will be scaled.
  void prepare_mass_scaling(State& state);
  /// After internal_forces(): makes the elements heavier whose stable step is below `step` (where `exactly`, also others lighter), so that
  /// it becomes `step`; add(element, increase of its mass over the mass of t = 0) for each, in the order of the tiles.
  template <class F>
  void scale_masses(double step, bool exactly, F&& add) {
    for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
      const Tile& tile = mesh_.tiles[t];
      if (!exactly && !(outcome_[t].time_step < step)) continue;
      for (std::size_t i = 0; i < tile.elements; ++i) {
        const std::size_t place = tile.first_block * block_lanes + i;
        // The undamped step, which goes with the root of the mass, is sqrt(step^2 + 2 beta step); see TileReport.
        const double own = steps_[place], twice_beta = damping_.empty() ? 0.0 : 2 * damping_[place];
        const double ratio = step / own * ((step + twice_beta) / (own + twice_beta));
        if (!(ratio > 0) || !((exactly ? std::abs(ratio - 1) : ratio - 1) > scaling_tolerance)) continue;  // 0: deleted, its step is infinite
        const double factor = mass_factor_[place] * ratio;
        add(mesh_.element[place], factor - mass_factor_[place]);
        mass_factor_[place] = factor;
        take_mass_factor(t, i);
      }
      outcome_[t].time_step = step;
    }
    if (governing_.time_step < step || exactly) governing_.time_step = step;
  }
  /// After start(): the stable steps of elements are multiplied by factor(element of the model, its part); see free_sides.hpp.
  template <class F>
  void scale_steps(F&& factor) {
    step_factor_.resize(mesh_.tiles.size());
    for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
      const Tile& tile = mesh_.tiles[t];
      const Index* element = mesh_.element.data() + tile.first_block * block_lanes;
      AlignedVector<double> factors(tile.blocks * block_lanes);
      for (std::size_t i = 0; i < factors.size(); ++i) factors[i] = factor(element[i], tile.part);
      if (std::any_of(factors.begin(), factors.end(), [](double f) { return f != 1; })) step_factor_[t] = std::move(factors);
    }
  }
  void start(State& state);
  /// After start(): stiffness damping, beta(element of the model, its part) [time], which shortens the stable steps.
  template <class F>
  void set_damping(F&& beta) {
    damping_.assign(mesh_.element.size(), 0.0);
    for (const Tile& tile : mesh_.tiles) {
      const std::size_t first = tile.first_block * block_lanes;
      for (std::size_t i = first; i < first + tile.blocks * block_lanes; ++i) damping_[i] = beta(mesh_.element[i], tile.part);
    }
  }

  /// f(element of the model, its part, its values): value k at values[k * block_lanes]. Empty lanes of last blocks, which repeat the
  /// last element, are met too unless `real_only`.
  template <class F>
  void for_each(F&& f, bool real_only = false) {
    for (std::size_t t = 0; t < mesh_.tiles.size(); ++t) {
      const Tile& tile = mesh_.tiles[t];
      const std::size_t count = real_only ? tile.elements : tile.blocks * block_lanes;
      for (std::size_t i = 0; i < count; ++i) f(mesh_.element[tile.first_block * block_lanes + i], tile.part, values(t, i));
    }
  }
  template <class F>
  void for_each(F&& f) const {
    const_cast<TileElements*>(this)->for_each([&](Index e, PartIndex p, double* own) { f(e, p, static_cast<const double*>(own)); }, true);
  }
  /// Values of an element, null if it is not here.
  const double* values_of(Index element) const;
  /// After start(): internal energy that an element has at t = 0; and its values, null if it is not here.
  void add_energy(Index element, double energy);
  double* values_of(Index element);
  /// Part of an element that is here.
  PartIndex part_of(Index element) const { return mesh_.tiles[find(element).tile].part; }
  /// 1, or 0 if the element has been deleted; 1 where it is not here.
  double alive(Index element) const;
  /// Whether some element may be deleted.
  bool deletable() const { return !alive_.empty(); }
  /// Internal energy of an element at t_n; 0 where it is not kept.
  double energy(Index element) const;

  /// Set-up, after start(): keeps the nodal forces of these elements, those that are here, for force_on().
  void watch(const std::vector<Index>& elements);
  /// Nodes of an element; empty if it is not here.
  std::vector<NodeIndex> nodes_of(Index element) const;
  /// Force and moment that node `a` of nodes_of() exerts on a watched element at t_n.
  std::array<Vec3, 2> force_on(Index element, std::size_t a) const;

  /// Stresses to t_n and forces into the slots.
  /// @param fault says what is wrong with an element: "has no area …"
  /// @throws RunError naming the element that the kernel could not compute, with its nodes.
  void internal_forces(const Model& model, State& state, const std::function<std::string(const State&, Index)>& fault);
  /// Adds the forces of the cycle to the nodes begin <= n < end.
  void add_forces(State& state, NodeIndex begin, NodeIndex end) const {
    slots_.add_to(state.nodes.force, state.nodes.moment, begin, end);
  }
  const Governing& governing() const { return governing_; }
  /// Elements deleted so far, and the internal energy they took with them.
  std::int64_t deleted() const;
  double eroded_energy() const;
  /// Adds the energies at t_n of the elements that are left, by part.
  void add_energies(std::vector<double>& internal, std::vector<double>& hourglass) const;

 private:
  static constexpr double scaling_tolerance = 1e-12;  ///< of the mass: what is less is rounding, and would add up over the cycles
  /// Values in the histories, of which so many reach no cache from one cycle to the next: 128 MiB.
  static constexpr std::size_t beyond_caches = std::size_t{1} << 24;
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  /// What a tile reports of a cycle.
  struct Outcome {
    double time_step = 0;
    std::size_t governing = 0, broken = 0;
  };
  /// Work space of the tile that a thread is at: TileWork::node and ::sum.
  struct Scratch {
    AlignedVector<double> node, sum;
  };
  struct Place {
    std::size_t tile = 0, element = 0;
    bool here = false;
  };

  double* values(std::size_t tile, std::size_t element) {
    const std::size_t size = kernels_[mesh_.tiles[tile].part].history_size;
    return history_.data() + history_begin_[tile] + element / block_lanes * size * block_lanes + element % block_lanes;
  }
  /// Element i of a tile has a new mass_factor_.
  void take_mass_factor(std::size_t tile, std::size_t i);
  Place find(Index element) const;
  void count_deleted(std::size_t tile);
  void run_tile(std::size_t tile, const State& state, Scratch& scratch);
  [[noreturn]] void report_broken(const Model& model, const State& state, Index element, const std::string& fault) const;

  TileElementsInput input_;
  TileMesh mesh_;
  SlotSum slots_;
  std::vector<PartKernel> kernels_;           ///< by part of the model
  AlignedVector<double> history_;              ///< blocks of all tiles
  std::vector<std::size_t> history_begin_;    ///< by tile
  std::vector<AlignedVector<double>> step_factor_;  ///< by tile and [block][lane]; empty: 1
  std::vector<AlignedVector<double>> side_factor_;  ///< step_factor_ at t = 0; it goes with the root of mass_factor_
  AlignedVector<double> alive_, energy_;       ///< [block][lane]; empty where nothing can be deleted (energy_: and nobody keeps it)
  AlignedVector<double> watched_force_;        ///< TileWork::element_force of the watched tiles
  std::vector<double> node_values_;           ///< by local node of all tiles; empty: none
  AlignedVector<double> steps_, mass_factor_;  ///< [block][lane] stable step, mass over that of t = 0; empty: no mass scaling
  AlignedVector<double> damping_;              ///< [block][lane] beta of stiffness damping; empty: none
  double erode_below_ = 0;
  std::vector<std::size_t> watched_begin_;    ///< by tile, into watched_force_; npos = nobody asks; empty = of no tile
  std::vector<double> internal_, hourglass_;  ///< energies, by tile
  std::vector<double> eroded_;                ///< internal energies of deleted elements, likewise
  std::vector<std::int64_t> deleted_;
  std::vector<Outcome> outcome_;              ///< by tile
  std::vector<Scratch> scratch_;              ///< by thread
  Shares shares_;                              ///< of the tiles
  std::vector<Index> place_;                  ///< by element of the model: block * lanes + lane, or none
  std::vector<Index> tile_of_block_;
  Governing governing_;
};

}  // namespace kardan

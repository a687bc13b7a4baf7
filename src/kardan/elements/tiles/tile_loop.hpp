// The loop over the blocks of a tile, and how a kernel calls a law. Included by translation units that are compiled for one
// instruction set each.
#pragma once

#include "kardan/base/aligned.hpp"
#include "kardan/base/simd_math.hpp"
#include "kardan/elements/tiles/tile_nodes.hpp"
#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// A law known at compile time: its mathematics is inlined into the element's.
template <class Law>
struct Inlined {
  const Law& law;

  /// Whether the law tells by elastic_step() that nothing yields.
  static constexpr bool yields = requires { &Law::template elastic_step<Pack>; };
  KARDAN_INLINE explicit Inlined(const LawOfTile& of_tile) : law(*static_cast<const Law*>(of_tile.constants)) {}
  static constexpr std::size_t history() { return Law::history; }
  static constexpr std::size_t tensors() {
    if constexpr (requires { Law::tensors; }) return Law::tensors;
    return 0;
  }
  template <class Point>
  KARDAN_INLINE void update(Point& p, const StepTime& t, double* values) const {
    law.update(p, t, values);
  }
  template <class Point>
  KARDAN_INLINE bool elastic_step(Point& p, const double* values) const {
    return law.elastic_step(p, values);
  }
  /// Asks the memory for what elastic_step() will read of a point with these values.
  KARDAN_INLINE static void ask_for_elastic_step(const double* values) { ask_for(values + Law::elastic_step_reads * block_lanes, 1); }
};

/// Any law, called through its pointer.
struct Called {
  const LawOfTile& law;

  static constexpr bool yields = false;
  KARDAN_INLINE explicit Called(const LawOfTile& of_tile) : law(of_tile) {}
  KARDAN_INLINE std::size_t history() const { return law.history; }
  KARDAN_INLINE std::size_t tensors() const { return law.tensors; }
  template <class Point>
  KARDAN_INLINE void update(Point& p, const StepTime& t, double* values) const {
    law.update(law.constants, &p, t, values);
  }
};

/// What every block reports of its elements; a formulation's block derives from it.
struct alignas(cache_line) BlockReport {
  double internal[block_lanes], hourglass[block_lanes], time_step[block_lanes];
  double alive[block_lanes];  ///< 1 or 0: deleted, or an empty lane of the last block
};

/// What the blocks of a tile report, summed and searched lane by lane.
///
/// Stiffness damping shortens the stable step: with the viscous stress of the velocity before t_n, beta K v_{n-1/2}, a mode of frequency omega is
/// stable up to dt = 2/omega (sqrt(1 + xi^2) - xi), xi = beta omega/2 (Belytschko, Liu and Moran 2000, section 6.2); with the undamped
/// step 2/omega that is sqrt(step^2 + beta^2) - beta.
class TileReport {
 public:
  TileReport() {
    for (Pack& step : step_) step = Pack(__builtin_inf());
  }
  /// Takes the report of block b in, and gives to the arrays of the tile what they want to know of every element.
  KARDAN_INLINE void add(TileWork& work, std::size_t b, const BlockReport& block) {
    const Pack zero(0.0), infinity(__builtin_inf());
    for (std::size_t i = 0; i < packs; ++i) {
      const std::size_t l = i * Pack::lanes, place = b * block_lanes + l;
      const Pack own = Pack::load(block.internal + l);
      Pack alive = Pack::load(block.alive + l), step = Pack::load(block.time_step + l);
      if (work.alive && work.smallest_step > 0) alive = select(step < Pack(work.smallest_step), zero, alive);
      if (work.step_factor) step *= Pack::load(work.step_factor + place);
      if (work.damping) {
        const Pack beta = Pack::load(work.damping + place);
        step = sqrt(step * step + beta * beta) - beta;
      }
      if (work.alive && work.erode_below > 0) alive = select(step < Pack(work.erode_below), zero, alive);
      internal_[i] += own;
      hourglass_[i] += Pack::load(block.hourglass + l);
      if (work.energy) (Pack::load(work.energy + place) + own).store(work.energy + place);
      if (work.alive) alive.store(work.alive + place);
      if (Pack::any((alive > zero) & ~((step > zero) & (abs(own) < infinity)))) find_broken(work, b, block);
      step = select(alive > zero, step, infinity);
      if (work.steps) step.store(work.steps + place);
      const auto smaller = step < step_[i];
      step_[i] = select(smaller, step, step_[i]);
      block_[i] = select(smaller, Pack(static_cast<double>(b)), block_[i]);
    }
  }
  KARDAN_INLINE void finish(TileWork& work) const {
    double internal[block_lanes], hourglass[block_lanes], step[block_lanes], block[block_lanes];
    for (std::size_t i = 0; i < packs; ++i) {
      internal_[i].store(internal + i * Pack::lanes);
      hourglass_[i].store(hourglass + i * Pack::lanes);
      step_[i].store(step + i * Pack::lanes);
      block_[i].store(block + i * Pack::lanes);
    }
    work.internal_increment = work.hourglass_increment = 0;
    work.time_step = __builtin_inf();
    work.governing = 0;
    for (std::size_t l = 0; l < block_lanes; ++l) {
      work.internal_increment += internal[l];
      work.hourglass_increment += hourglass[l];
      const std::size_t element = static_cast<std::size_t>(block[l]) * block_lanes + l;
      if (step[l] > work.time_step || (step[l] == work.time_step && element >= work.governing)) continue;
      work.time_step = step[l];
      work.governing = element;
    }
  }

 private:
  static constexpr std::size_t packs = block_lanes / Pack::lanes;

  [[gnu::noinline]] static void find_broken(TileWork& work, std::size_t b, const BlockReport& block) {
    for (std::size_t l = 0; l < block_lanes; ++l) {
      if (!(block.alive[l] > 0)) continue;
      if (!(block.time_step[l] > 0) || !(block.internal[l] - block.internal[l] == 0)) work.broken = b * block_lanes + l + 1;
    }
  }

  Pack internal_[packs], hourglass_[packs];
  Pack step_[packs], block_[packs];
};

/// The forces of a block's elements as TileWork::element_force has them, zero of those that are deleted.
template <std::size_t Nodes, std::size_t Components>
KARDAN_INLINE void copy_forces(const NodalForces<Nodes, Components>& force, const double* alive, double* to) {
  for (std::size_t a = 0; a < Nodes; ++a) {
    for (std::size_t c = 0; c < Components; ++c) {
      for (std::size_t l = 0; l < block_lanes; ++l) {
        to[(a * Components + c) * block_lanes + l] = alive[l] > 0 ? force.value[a][l][c] : 0.0;
      }
    }
  }
}
template <std::size_t Nodes, std::size_t Components>
KARDAN_INLINE void copy_forces(const double (&force)[Nodes][Components][block_lanes], const double*, double* to) {
  std::memcpy(to, force, sizeof force);
}

/// Sets which of the first `lanes` lanes of a block are alive; `alive` null: all of them. By whole packs: a load of a pack would have to
/// wait until stores of its single lanes have left the processor.
KARDAN_INLINE void set_alive(std::size_t lanes, const double* alive, BlockReport& block) {
  Pack::Mask lane;
  for (std::size_t l = 0; l < Pack::lanes; ++l) lane[l] = static_cast<std::int64_t>(l);
  for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) {
    const Pack own = alive ? Pack::load(alive + l) : Pack(1.0);
    select(lane < static_cast<std::int64_t>(lanes) - static_cast<std::int64_t>(l), own, Pack(0.0)).store(block.alive + l);
  }
}

/// Asks the memory for the share of block b in the nodes ahead. Every second one: the vectors of two neighbours lie on one or two lines.
/// The shares are equal, so that the processor foresees the end of the loop.
KARDAN_INLINE void ask_for_nodes(const NodesAhead& ahead, std::size_t b, std::size_t blocks) {
  const std::size_t share = (ahead.count + 2 * blocks - 1) / (2 * blocks) * 2, begin = share * b;
  const std::size_t end = ahead.count < begin + share ? ahead.count : begin + share;
  for (std::size_t k = begin; k < end; k += 2) {
    for (const Vec3* vectors : ahead.vectors) {
      if (vectors) __builtin_prefetch(vectors + ahead.node[k], 0, 2);
    }
  }
}

/// One value into memory; past_caches: without asking the memory for the line first.
template <bool PastCaches>
KARDAN_INLINE void put(double value, double* to) {
#if defined(__x86_64__)
  if constexpr (PastCaches) {
    long long bits;
    std::memcpy(&bits, &value, sizeof bits);
    _mm_stream_si64(reinterpret_cast<long long*>(to), bits);
    return;
  }
#endif
  *to = value;
}

/// The sums of a tile's nodes into their slots; the sums are zero then, for the next tile.
template <std::size_t Components, bool PastCaches>
KARDAN_INLINE void fill_slots(const TileWork& work) {
  double *sum = work.sum, *slot = work.force;
  const double* const end = slot + Components * work.nodes;
  for (; slot != end; slot += Components, sum += sum_stride(Components)) {
    for (std::size_t c = 0; c < Components; ++c) put<PastCaches>(sum[c], slot + c);
    for (std::size_t c = 0; c < sum_stride(Components); c += 4) store_as(Four{}, sum + c);
  }
#if defined(__x86_64__)
  if constexpr (PastCaches) _mm_sfence();
#endif
}

/// Runs `element_block(connectivity, lanes, history)` over the blocks of a tile and gathers what the block reports. `block` is the
/// formulation's work space, which element_block fills; alive is set before, also 0 in the empty lanes of the last block.
template <std::size_t NodesPerElement, std::size_t Components, class Block, class F>
KARDAN_INLINE void for_each_block(TileWork& work, std::size_t history_size, Block& block, F&& element_block) {
  work.broken = 0;
  TileReport report;
  const std::size_t blocks = (work.elements + block_lanes - 1) / block_lanes;
  for (std::size_t first = 0, b = 0; first < work.elements; first += block_lanes, ++b) {
    const std::size_t lanes = work.elements - first < block_lanes ? work.elements - first : block_lanes;
    ask_for_nodes(work.ahead, b, blocks);
    set_alive(lanes, work.alive ? work.alive + first : nullptr, block);
    element_block(work.connectivity + b * NodesPerElement * block_lanes, lanes, work.history + b * history_size * block_lanes);
    if (work.element_force) {
      copy_forces(block.force, block.alive, work.element_force + b * NodesPerElement * Components * block_lanes);
    }
    report.add(work, b, block);
  }
  if (work.past_caches) {
    fill_slots<Components, true>(work);
  } else {
    fill_slots<Components, false>(work);
  }
  report.finish(work);
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

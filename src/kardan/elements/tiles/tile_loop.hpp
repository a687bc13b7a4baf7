// The loop over the blocks of a tile, and how a kernel calls a law. Included by translation units that are compiled for one
// instruction set each.
#pragma once

#include "kardan/base/simd_math.hpp"
#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// A law known at compile time: its mathematics is inlined into the element's.
template <class Law>
struct Inlined {
  const Law& law;

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
};

/// Any law, called through its pointer.
struct Called {
  const LawOfTile& law;

  KARDAN_INLINE explicit Called(const LawOfTile& of_tile) : law(of_tile) {}
  KARDAN_INLINE std::size_t history() const { return law.history; }
  KARDAN_INLINE std::size_t tensors() const { return law.tensors; }
  template <class Point>
  KARDAN_INLINE void update(Point& p, const StepTime& t, double* values) const {
    law.update(law.constants, &p, t, values);
  }
};

/// What every block reports of its elements; a formulation's block derives from it.
struct BlockReport {
  double internal[block_lanes], hourglass[block_lanes], time_step[block_lanes];
  double alive[block_lanes];  ///< 1 or 0: deleted, or an empty lane of the last block
};

/// Runs `element_block(connectivity, lanes, history)` over the blocks of a tile and gathers what the block reports. `block` is the
/// formulation's work space, which element_block fills.
template <std::size_t NodesPerElement, class Block, class F>
KARDAN_INLINE void for_each_block(TileWork& work, std::size_t components, std::size_t history_size, Block& block, F&& element_block) {
  std::memset(work.force, 0, work.nodes * components * sizeof(double));
  double internal[block_lanes] = {}, hourglass[block_lanes] = {};
  work.time_step = __builtin_inf();
  work.governing = work.broken = 0;
  for (std::size_t first = 0, b = 0; first < work.elements; first += block_lanes, ++b) {
    const std::size_t lanes = work.elements - first < block_lanes ? work.elements - first : block_lanes;
    double* const alive = work.alive ? work.alive + b * block_lanes : nullptr;
    for (std::size_t l = 0; l < block_lanes; ++l) block.alive[l] = l >= lanes ? 0.0 : alive ? alive[l] : 1.0;
    element_block(work.connectivity + b * NodesPerElement * block_lanes, lanes, work.history + b * history_size * block_lanes);
    for (std::size_t l = 0; l < block_lanes; ++l) {
      internal[l] += block.internal[l];
      hourglass[l] += block.hourglass[l];
    }
    if (work.element_force) {
      static_assert(sizeof(block.force) == NodesPerElement * sizeof(block.force[0]));
      std::memcpy(work.element_force + b * sizeof(block.force) / sizeof(double), block.force, sizeof(block.force));
    }
    if (work.energy) {
      for (std::size_t l = 0; l < lanes; ++l) work.energy[b * block_lanes + l] += block.internal[l];
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      if (alive) {
        const bool too_small = work.smallest_step > 0 && block.time_step[l] < work.smallest_step;
        alive[l] = too_small ? 0.0 : block.alive[l];
        if (!(alive[l] > 0)) block.time_step[l] = __builtin_inf();
      }
      const double step = work.step_factor ? work.step_factor[first + l] * block.time_step[l] : block.time_step[l];
      if (work.steps) work.steps[b * block_lanes + l] = step;
      if (!(step > 0) || !(block.internal[l] - block.internal[l] == 0)) work.broken = first + l + 1;
      if (step < work.time_step) {
        work.time_step = step;
        work.governing = first + l;
      }
    }
  }
  work.internal_increment = work.hourglass_increment = 0;
  for (std::size_t l = 0; l < block_lanes; ++l) {
    work.internal_increment += internal[l];
    work.hourglass_increment += hourglass[l];
  }
}

}  // namespace kardan::KARDAN_ISA_NAMESPACE

// One tile in one cycle: what a kernel reads and writes, whatever the formulation. Plain pointers, so that the file can be included by
// translation units of every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kardan/base/index.hpp"
#include "kardan/base/lanes.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/materials/law_entry.hpp"

namespace kardan {

/// Doubles of a tile's node: position at t_n and velocity at t_{n-1/2}, filled up to four each; with rotations also the angular
/// velocity.
constexpr std::size_t node_stride(std::size_t components) { return components == 6 ? 12 : 8; }

/// Doubles of a tile's node in the sums of its forces: a power of two, so that a node's never lie on two cache lines and those with
/// moments are one pack of eight.
constexpr std::size_t sum_stride(std::size_t components) { return components == 6 ? 8 : 4; }

/// Nodes that the same thread will gather next.
struct NodesAhead {
  const NodeIndex* node = nullptr;
  std::size_t count = 0;
  const Vec3* vectors[3] = {};  ///< by node of the model: positions, velocities, angular velocities (null: not gathered)
};

/// Local arrays are indexed by the tile's own nodes; history, alive, energy and steps by [block] … [lane].
struct TileWork {
  const void* properties = nullptr;             ///< of the part, of the type that the kernel knows
  const std::uint16_t* connectivity = nullptr;  ///< [block][node of the element][lane]
  std::size_t elements = 0;
  const double* node = nullptr;                 ///< [node][node_stride]
  std::size_t nodes = 0;
  NodesAhead ahead;
  StepTime step;
  double* history = nullptr;                    ///< [block][values of an element][lane]
  double smallest_step = 0;                     ///< elements whose stable step falls below it are deleted, where elements can be
  double erode_below = 0;                       ///< likewise of the step that counts for the run, with its step_factor; 0 = none
  double* alive = nullptr;                      ///< [block][lane] in and out: 1, or 0 if deleted; null where nothing can be deleted
  double* energy = nullptr;                     ///< [block][lane] internal energy of each element, added to; may be null
  const double* step_factor = nullptr;          ///< [block][lane] on the stable step; null: 1
  const double* damping = nullptr;              ///< [block][lane] factor beta of stiffness damping [time]; null: none
  double* steps = nullptr;                      ///< [block][lane] out: stable step of each element; may be null
  double* element_force = nullptr;              ///< [block][node of the element][component][lane] out: forces that the nodes exert on each
                                                ///< element; null where nobody asks
  double* sum = nullptr;                        ///< [node][sum_stride] work space at a cache line; zero before and after
  double* force = nullptr;                      ///< [node][3 or 6] force (and moment) on the nodes; overwritten
  bool past_caches = false;                     ///< the slots will have left the caches when they are read: write them past these
  double internal_increment = 0;                ///< out: work of the stresses over the step
  double hourglass_increment = 0;               ///< out
  double time_step = 0;                         ///< out: smallest stable step
  std::size_t governing = 0;                    ///< out: its element in the tile
  std::size_t broken = 0;                       ///< out: 1 + an element without size or with a value that is not finite; 0 = none
};

using TileKernel = void (*)(TileWork&);

/// A formulation compiled for one instruction set: with the laws that are worth inlining, and with a law that is called.
struct TileKernels {
  TileKernel elastic = nullptr;            ///< null: use `called`
  TileKernel piecewise_plastic = nullptr;  ///< likewise
  TileKernel called = nullptr;
};

/// The law of a part as a kernel's properties hold it.
struct LawOfTile {
  const void* constants = nullptr;
  PointUpdate update = nullptr;
  std::size_t history = 0, tensors = 0;
};

}  // namespace kardan

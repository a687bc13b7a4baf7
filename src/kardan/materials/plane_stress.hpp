// What the laws of shells have in common.
//
// A law of shells is a plain struct `Law` with
//   static constexpr std::size_t history;       values that a point keeps beside its five stresses
//   void start(double* values) const;           what they are at the start, values[0] to values[history - 1]
//   template <class R> void update(PlaneStress<R>& s, const PlaneStress<R>& d, double dt, double* history) const;
// s: stress at t_{n-1}, brought to t_n; d: strain increments of the step dt; history: the point's values of the lanes of R, value i at
// history + i * block_lanes. It must not branch on data other than "does any lane need this", must give each lane what it would get
// alone, and may not allocate. docs/adding-a-material.md shows how one is added.
#pragma once

namespace kardan {

/// Stress or strain increment of a shell at one point: xx, yy, xy, yz, zx; shear strains are engineering strains.
template <class R>
struct PlaneStress {
  R xx, yy, xy, yz, zx;
};

}  // namespace kardan

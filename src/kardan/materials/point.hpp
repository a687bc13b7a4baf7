// What a law of material sees: one integration point over one step, in axes that turn with the material.
//
// A law is a plain struct
//   static constexpr std::size_t history;       values that a point keeps beside its stress
//   static constexpr std::size_t tensors;       how many symmetric tensors (xx, yy, zz, xy, yz, zx) these begin with; the elements
//                                               turn them with the material, as they turn the stress. A law of which some materials
//                                               use fewer gives used_history() and used_tensors(); these are then the most
//   static constexpr bool finite_strain;        only in laws whose stress follows from these tensors, not from the stress before
//   void start(double* values) const;           values[0] to values[history - 1] at the start
//   double longitudinal() const, shear() const; lambda + 2 mu and mu of the start: time step, hourglass control, bulk viscosity
//   template <class R> void update(MaterialPoint<R>&, const StepTime&, double* history) const;
// and, where points may fail,
//   bool can_fail() const;  ElementDeletion deletion() const;
// R is a pack of doubles, value i of the pack's points lies at history + i * block_lanes. A law must not branch on data other than
// "does any lane need this", gives each lane what it would get alone, and does not allocate. docs/adding-a-material.md shows
// how one is added.
#pragma once

#include <cstddef>

#include "kardan/base/lanes.hpp"

namespace kardan {

/// A symmetric tensor: stress, or strain increment (shears are entries of the tensor, half the engineering strain).
template <class R>
struct SymmetricTensor {
  R xx{}, yy{}, zz{}, xy{}, yz{}, zx{};

  template <class F>
  [[gnu::always_inline]] void for_each(F&& f) {
    f(xx), f(yy), f(zz), f(xy), f(yz), f(zx);
  }
};

template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> load_tensor(const double* h) {
  return {R::load(h),
          R::load(h + block_lanes),
          R::load(h + 2 * block_lanes),
          R::load(h + 3 * block_lanes),
          R::load(h + 4 * block_lanes),
          R::load(h + 5 * block_lanes)};
}
template <class R>
[[gnu::always_inline]] inline void store_tensor(const SymmetricTensor<R>& s, double* h) {
  s.xx.store(h);
  s.yy.store(h + block_lanes);
  s.zz.store(h + 2 * block_lanes);
  s.xy.store(h + 3 * block_lanes);
  s.yz.store(h + 4 * block_lanes);
  s.zx.store(h + 5 * block_lanes);
}

/// a : b.
template <class R>
[[gnu::always_inline]] inline R contraction(const SymmetricTensor<R>& a, const SymmetricTensor<R>& b) {
  const R shear = a.xy * b.xy + a.yz * b.yz + a.zx * b.zx;
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + shear + shear;
}

/// When an element is deleted because of its material.
struct ElementDeletion {
  double points = 0;  ///< as soon as so many of its points have failed; 0: all of them; negative: per cent of them
  double step = 0;    ///< as soon as its stable step is smaller (TDEL); 0: never
};

/// The step that brings a point from t_{n-1} to t_n.
struct StepTime {
  double dt = 0;    ///< t_n - t_{n-1}; 0 in the first cycle
  double time = 0;  ///< t_n
};

/// A point in three dimensions.
template <class R>
struct MaterialPoint {
  SymmetricTensor<R> stress;  ///< in: at t_{n-1}, out: at t_n
  SymmetricTensor<R> strain;  ///< increment over the step
  R volume{1.0};              ///< V/V0 at t_n; 0 for a point of a shell, where the law finds it itself
  R viscosity{};              ///< pressure of bulk viscosity, mean of the step: heats a law with an equation of state
  R modulus{};                ///< in: longitudinal(); out: rho0 c^2 for the time step, larger where the material has stiffened
  R failed{};                 ///< out: 1 where the point has failed and its element is to be deleted
};

/// Stress or strain increment of a shell at one point; shear strains are engineering strains.
template <class R>
struct PlaneStress {
  R xx{}, yy{}, xy{}, yz{}, zx{};

  template <class F>
  [[gnu::always_inline]] void for_each(F&& f) {
    f(xx), f(yy), f(xy), f(yz), f(zx);
  }
};

/// Work of a stress on a strain increment.
template <class R>
[[gnu::always_inline]] inline R contraction(const PlaneStress<R>& s, const PlaneStress<R>& d) {
  return s.xx * d.xx + s.yy * d.yy + s.xy * d.xy + s.yz * d.yz + s.zx * d.zx;
}

/// A point of a shell: the stress normal to the shell vanishes.
template <class R>
struct ShellPoint {
  PlaneStress<R> stress;  ///< in: at t_{n-1}, out: at t_n
  PlaneStress<R> strain;  ///< increment over the step
  R spin{};               ///< angle that the material turns about the normal beside the element's axes in the step
  R thickness_strain{};   ///< out: increment of the normal strain
  R stiffening{1.0};      ///< out: factor on the square of the wave speed
  R failed{};             ///< out: 1 where the point has failed
};

/// Stress or strain increment of a beam at one point of its section: along the axis r, shears; shear strains are engineering strains.
template <class R>
struct BeamStress {
  R rr{}, rs{}, tr{};
};

/// A point of a beam: the stresses across the axis and the shear in the section vanish.
template <class R>
struct BeamPoint {
  BeamStress<R> stress;  ///< in: at t_{n-1}, out: at t_n
  BeamStress<R> strain;  ///< increment over the step
  R failed{};            ///< out: 1 where the point has failed
};

/// A point that has failed carries nothing, also where its element lives on.
template <class R, template <class> class Point>
[[gnu::always_inline]] inline void unload_failed(Point<R>& point) {
  const auto failed = point.failed > R(0.5);
  if (R::any(failed)) point.stress.for_each([&](R& s) { s = select(failed, R(0.0), s); });
}

}  // namespace kardan

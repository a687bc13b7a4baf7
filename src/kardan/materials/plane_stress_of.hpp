// A law of three dimensions as a law of shells: the increment of the normal strain is iterated until the normal stress vanishes.
//
// Start: the elastic increment, -lambda/(lambda + 2 mu) (e_xx + e_yy), and the one that keeps the volume, -(e_xx + e_yy); between
// them and after them the secant method (Hallquist, LS-DYNA Theory Manual 2006, "Structure of shell materials"). The normal stress of a step
// starts from zero. Every lane stops by itself, so its result does not depend on its neighbours. The transverse shear strains
// are multiplied by the shear correction factor (SHRF), so that the stresses are those of the resultants.
//
// The axes of a shell follow its side 1-2, not the material. A law of the whole deformation (Law::finite_strain) gets its tensors and
// stress turned by what the material turns beside them; others leave that out, as Belytschko and Tsay's formulation does.
#pragma once

#include <cstddef>
#include <cstring>

#include "kardan/materials/point.hpp"

namespace kardan {

/// s turned about z by an angle given as tan(angle/2).
template <class R>
[[gnu::always_inline]] inline SymmetricTensor<R> turned_in_plane(const SymmetricTensor<R>& s, const R& half_tangent) {
  const R f = R(1.0) / (R(1.0) + half_tangent * half_tangent);
  const R c = (R(1.0) - half_tangent * half_tangent) * f, n = (half_tangent + half_tangent) * f;
  const R xx = c * (c * s.xx - n * s.xy) - n * (c * s.xy - n * s.yy), yy = n * (n * s.xx + c * s.xy) + c * (n * s.xy + c * s.yy);
  return {xx, yy, s.zz, c * (n * s.xx + c * s.xy) - n * (n * s.xy + c * s.yy), n * s.zx + c * s.yz, c * s.zx - n * s.yz};
}

template <class Law>
struct PlaneStressOf {
  static constexpr std::size_t history = Law::history;
  static constexpr bool finite_strain = requires { Law::finite_strain; };
  static constexpr int iterations = 20;       ///< at most
  static constexpr double tolerance = 1e-11;  ///< of lambda + 2 mu times the size of the strain increment

  Law law;
  double shear_factor = 1;

  static PlaneStressOf from(const Law& law, double shear_factor) { return {law, shear_factor}; }
  void start(double* values) const { law.start(values); }
  std::size_t used_history() const {
    if constexpr (requires { law.used_history(); }) return law.used_history();
    return history;
  }

  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime& t, double* values) const {
    const R half_k(0.5 * shear_factor), modulus(law.longitudinal()), zero(0.0);
    const PlaneStress<R>&d = p.strain, &s = p.stress;
    MaterialPoint<R> start;
    start.stress = {s.xx, s.yy, zero, s.xy, s.yz, s.zx};
    start.strain = {d.xx, d.yy, zero, R(0.5) * d.xy, half_k * d.yz, half_k * d.zx};
    start.modulus = modulus;
    start.volume = zero;
    const R sum = d.xx + d.yy;
    const R limit = R(tolerance) * modulus * sqrt(contraction(start.strain, start.strain)) + R(1e-15) * (abs(s.xx) + abs(s.yy));

    const R turn = R(0.25) * p.spin;  // half of the spin before the step, half after it: tan(spin/4)
    if constexpr (finite_strain) turn_tensors(turn, values);
    alignas(64) double trial[(history > 0 ? history : 1) * block_lanes];
    MaterialPoint<R> point;
    const std::size_t used = used_history();
    const auto evaluate = [&](const R& normal) {
      for (std::size_t i = 0; i < used; ++i) R::load(values + i * block_lanes).store(trial + i * block_lanes);
      point = start;
      point.strain.zz = normal;
      law.update(point, t, trial);
    };
    R before = R(2.0 * law.shear() / law.longitudinal() - 1.0) * sum, now = before;
    evaluate(now);
    R stress_before = point.stress.zz;
    auto active = abs(stress_before) > limit;
    if (R::any(active)) {
      now = select(active, R(0.0) - sum, now);
      // Where both starts are the same (no change of area) one elastic step makes the second.
      now = select(active & (abs(now - before) * modulus < abs(stress_before) * R(1e-3)), before - stress_before / modulus, now);
      for (int i = 0; i < iterations; ++i) {
        evaluate(now);
        const R stress = point.stress.zz, rise = stress - stress_before;
        active = active & (abs(stress) > limit);
        if (!R::any(active)) break;
        const R secant = stress * (now - before) / select(abs(rise) > zero, rise, R(1.0));
        const R step = select(abs(rise) > zero, secant, stress / modulus);
        before = select(active, now, before);
        stress_before = select(active, stress, stress_before);
        now = select(active, now - step, now);
      }
    }
    for (std::size_t i = 0; i < used; ++i) R::load(trial + i * block_lanes).store(values + i * block_lanes);
    if constexpr (finite_strain) {
      turn_tensors(turn, values);
      point.stress = turned_in_plane(point.stress, turn);
      // A plate's stiffness 4 mu grows by no more than three times what the principal stiffness gains.
      p.stiffening = max(R(1.0), R(1.0) + (point.modulus - modulus) * R(0.75 / law.shear()));
    }
    p.stress = {point.stress.xx, point.stress.yy, point.stress.xy, point.stress.yz, point.stress.zx};
    p.thickness_strain = now;
    p.failed = point.failed;
  }

 private:
  template <class R>
  [[gnu::always_inline]] void turn_tensors(const R& half_tangent, double* values) const {
    std::size_t count = Law::tensors;
    if constexpr (requires { law.used_tensors(); }) count = law.used_tensors();
    for (std::size_t i = 0; i < count; ++i) {
      double* h = values + 6 * i * block_lanes;
      store_tensor(turned_in_plane(load_tensor<R>(h), half_tangent), h);
    }
  }
};

}  // namespace kardan

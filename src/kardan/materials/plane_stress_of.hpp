// A law of three dimensions as a law of shells: the increment of the normal strain is iterated until the normal stress vanishes.
//
// Start: the elastic increment, -lambda/(lambda + 2 mu) (e_xx + e_yy), and the one that keeps the volume, -(e_xx + e_yy); between
// them and after them the secant method (Hallquist, LS-DYNA Theory Manual 2006, "Structure of shell materials"). The normal stress of a step
// starts from zero. Every lane stops by itself, so its result does not depend on its neighbours. The transverse shear strains
// are multiplied by the shear correction factor (SHRF), so that the stresses are those of the resultants.
#pragma once

#include <cstddef>
#include <cstring>

#include "kardan/materials/point.hpp"

namespace kardan {

template <class Law>
struct PlaneStressOf {
  static constexpr std::size_t history = Law::history;
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
    p.stress = {point.stress.xx, point.stress.yy, point.stress.xy, point.stress.yz, point.stress.zx};
    p.thickness_strain = now;
    p.failed = point.failed;
  }
};

}  // namespace kardan

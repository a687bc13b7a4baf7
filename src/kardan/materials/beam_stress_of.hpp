// A law of three dimensions as a law of beams: the strains across the axis are iterated until the stress across vanishes.
//
// A beam's point has a stress along the axis and two shears; the stresses across the axis and the shear in the section are zero. The two
// strains across are taken equal, as they are for isotropic laws (the flow of von Mises' condition and its back stress are equal
// in both), and follow from  sigma_ss + sigma_tt = 0  by the secant method. Starts: the elastic increment, -nu d eps_rr, which is exact
// for an elastic step, and the one that keeps the volume, -d eps_rr/2. Every evaluation begins with the values of the last step, so the
// law itself stays exact. Every lane stops by itself, so its result does not depend on its neighbours.
// Source: as plane_stress_of.hpp; Hallquist, LS-DYNA Theory Manual 2006, "Hughes-Liu beam" (iteration to zero normal stress).
#pragma once

#include <cstddef>

#include "kardan/materials/point.hpp"

namespace kardan {

template <class Law>
struct BeamStressOf {
  static constexpr std::size_t history = Law::history;
  static constexpr int iterations = 20;       ///< at most
  static constexpr double tolerance = 1e-11;  ///< of lambda + 2 mu times the size of the strain increment

  Law law;

  static BeamStressOf from(const Law& law) { return {law}; }
  void start(double* values) const { law.start(values); }

  template <class R>
  [[gnu::always_inline]] void update(BeamPoint<R>& p, const StepTime& t, double* values) const {
    const R zero(0.0), half(0.5);
    const BeamStress<R>&d = p.strain, &s = p.stress;
    MaterialPoint<R> start;
    start.stress = {s.rr, zero, zero, s.rs, zero, s.tr};
    start.strain = {d.rr, zero, zero, half * d.rs, zero, half * d.tr};
    start.modulus = R(law.longitudinal());
    start.volume = zero;
    // Slope of (sigma_ss + sigma_tt)/2 over the strain across, lambda + mu, and nu = lambda/(2 (lambda + mu)).
    const double slope = law.longitudinal() - law.shear(), poisson = 0.5 - 0.5 * law.shear() / slope;
    const R limit = R(tolerance * law.longitudinal()) * sqrt(contraction(start.strain, start.strain)) + R(1e-15) * abs(s.rr);

    alignas(64) double trial[(history > 0 ? history : 1) * block_lanes];
    MaterialPoint<R> point;
    const auto evaluate = [&](const R& across) {
      for (std::size_t i = 0; i < history; ++i) R::load(values + i * block_lanes).store(trial + i * block_lanes);
      point = start;
      point.strain.yy = point.strain.zz = across;
      law.update(point, t, trial);
      return half * (point.stress.yy + point.stress.zz);
    };
    R before = R(-poisson) * d.rr, now = before;
    R stress_before = evaluate(now);
    auto active = abs(stress_before) > limit;
    if (R::any(active)) {
      now = select(active, R(-0.5) * d.rr, now);
      // Where both starts are the same (nu = 1/2, or no strain along) one elastic step makes the second.
      now = select(active & (abs(now - before) * R(slope) < abs(stress_before) * R(1e-3)), before - stress_before / R(slope), now);
      for (int i = 0; i < iterations; ++i) {
        const R stress = evaluate(now), rise = stress - stress_before;
        active = active & (abs(stress) > limit);
        if (!R::any(active)) break;
        const R secant = stress * (now - before) / select(abs(rise) > zero, rise, R(1.0));
        const R step = select(abs(rise) > zero, secant, stress / R(slope));
        before = select(active, now, before);
        stress_before = select(active, stress, stress_before);
        now = select(active, now - step, now);
      }
    }
    for (std::size_t i = 0; i < history; ++i) R::load(trial + i * block_lanes).store(values + i * block_lanes);
    p.stress = {point.stress.xx, point.stress.xy, point.stress.zx};
    p.failed = point.failed;
  }
};

}  // namespace kardan

// Springs and dampers of *ELEMENT_DISCRETE: *MAT_SPRING_..., *MAT_DAMPER_... (S01 to S08).
//
// d is the elongation (tension positive) [length] or the relative rotation [rad], v its rate, f the force or moment that
// resists it. Source of the laws: Hallquist, LS-DYNA Keyword User's Manual Vol. II, *MAT_S01 to *MAT_S08; where it leaves the
// law open, the choice stands at the law.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/curve.hpp"
#include "kardan/model/materials.hpp"

namespace kardan {

/// What a law remembers of one element; the meaning of `a`, `b`, `c` is the law's.
struct SpringHistory {
  double elongation = 0;  ///< at t_n
  double force = 0;       ///< at t_n, before scale and magnification
  double a = 0, b = 0, c = 0;
};

/// Largest stiffness and damping a law can show: what a stable step needs.
struct SpringBounds {
  double stiffness = 0, damping = 0;
};

/// History of an element that was never deformed.
SpringHistory initial_history(const SpringMaterial& law, double elongation);

/// Force at t_n of elongation d and rate v after a step dt; brings the history from t_{n-1} to t_n.
double spring_force(const SpringMaterial& law, const std::vector<Curve>& curves, double d, double v, double time, double dt,
                    SpringHistory& history);

SpringBounds spring_bounds(const SpringMaterial& law, const std::vector<Curve>& curves);

/// Complains about parameters the law cannot be computed with; `name` says which material it is.
void check_spring(const SpringMaterial& law, const std::vector<Curve>& curves, const std::string& name, Diagnostics& diagnostics);

}  // namespace kardan

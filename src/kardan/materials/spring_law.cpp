#include "kardan/materials/spring_law.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace kardan {

namespace {

const Curve* find(const SpringMaterial& law, const std::vector<Curve>& curves, std::size_t i) {
  return law.curve[i] == none ? nullptr : &curves[law.curve[i]];
}

double steepest(const Curve& curve) {
  double slope = 0;
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
    slope = std::max(slope, std::abs((curve.y[i + 1] - curve.y[i]) / (curve.x[i + 1] - curve.x[i])));
  }
  return slope;
}

double largest(const Curve& curve) {
  double value = 0;
  for (const double y : curve.y) value = std::max(value, std::abs(y));
  return value;
}

/// Abscissa at which a non-decreasing curve reaches y; its ends where it never does.
double inverse(const Curve& curve, double y) {
  if (y <= curve.y.front()) return curve.x.front();
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
    if (y <= curve.y[i + 1]) {
      return curve.x[i] + (curve.x[i + 1] - curve.x[i]) * (y - curve.y[i]) / (curve.y[i + 1] - curve.y[i]);
    }
  }
  return curve.x.back();
}

/// S03: K, KT, FY. Isotropic hardening: after each plastic increment dp the yield force grows by K KT/(K - KT) dp, so that the
/// loading branch has the slope KT. a: growth of the yield force so far.
double elastoplastic(const SpringMaterial& law, double d, SpringHistory& h) {
  const double k = law.p[0], kt = law.p[1], trial = h.force + k * (d - h.elongation), yield = law.p[2] + h.a;
  const double excess = std::abs(trial) - yield;
  if (excess <= 0) return trial;
  const double hardening = k * kt / (k - kt), plastic = excess / (k + hardening);
  h.a += hardening * plastic;
  return std::copysign(yield + hardening * plastic, trial);
}

/// S06 with BETA = 0: loading curve L, unloading curve U; tension and compression yield independently of each other.
/// a, b: plastic elongation from tension (>= 0) and from compression (<= 0). Between the yield lines the force follows U shifted
/// by a + b; the yield line in tension is L(d - b) for d > b, in compression L(d - a) for d < a.
double general_nonlinear(const Curve& loading, const Curve& unloading, double d, SpringHistory& h) {
  const double trial = unloading.value(d - h.a - h.b);
  if (d > h.b && trial > 0) {
    const double yield = loading.value(d - h.b);
    if (trial <= yield) return trial;
    h.a = std::max(h.a, d - h.b - inverse(unloading, yield));
    return yield;
  }
  if (d < h.a && trial < 0) {
    const double yield = loading.value(d - h.a);
    if (trial >= yield) return trial;
    h.b = std::min(h.b, d - h.a - inverse(unloading, yield));
    return yield;
  }
  return trial;
}

/// S07: f = KI d + integral of (K0 - KI) exp(-BETA (t - s)) d'(s) ds, the integral by the exact update for a rate that is
/// constant over the step. a: the integral. From TC on the force stays at FC, or where FC = 0 at what it was.
double maxwell(const SpringMaterial& law, double d, double time, double dt, SpringHistory& h) {
  const auto [k0, ki, beta, tc, fc, copt] = law.p;
  if (tc > 0 && time > tc) return fc != 0 ? fc : h.force;
  const double x = beta * dt;
  const double decay = std::exp(-x), mean = x > 1e-8 ? -std::expm1(-x) / x : 1.0 - 0.5 * x;
  h.a = decay * h.a + (k0 - ki) * mean * (d - h.elongation);
  return ki * d + h.a;
}

/// S08: LCFD in the first quadrant, unloading stiffness KU (at least the steepest slope of the curve), CTF = -1 tension only,
/// else compression only. a: plastic elongation in the sense of the force.
double inelastic(const SpringMaterial& law, const Curve& curve, double d, SpringHistory& h) {
  const double sense = law.p[1] < 0 ? 1.0 : -1.0, ku = std::max(law.p[0], steepest(curve));
  const double u = sense * d, trial = ku * (u - h.a);
  if (trial <= 0) return 0.0;
  const double yield = curve.value(u);
  if (trial <= yield) return sense * trial;
  h.a = u - yield / ku;
  return sense * yield;
}

}  // namespace

SpringHistory initial_history(const SpringMaterial& law, double elongation) {
  SpringHistory h;
  // The rate-type laws start from zero elongation, so that an initial offset loads them as it does the others.
  const bool rate_type = law.law == SpringLaw::elastoplastic_spring || law.law == SpringLaw::maxwell_spring;
  h.elongation = rate_type ? 0.0 : elongation;
  return h;
}

double spring_force(const SpringMaterial& law, const std::vector<Curve>& curves, double d, double v, double time, double dt,
                    SpringHistory& h) {
  const auto force = [&] {
    switch (law.law) {
      case SpringLaw::elastic_spring:
        return law.p[0] * d;
      case SpringLaw::viscous_damper:
        return law.p[0] * v;
      case SpringLaw::elastoplastic_spring:
        return elastoplastic(law, d, h);
      case SpringLaw::nonlinear_elastic_spring: {
        const Curve* scale = find(law, curves, 1);
        return curves[law.curve[0]].value(d) * (scale ? scale->value(v) : 1.0);
      }
      case SpringLaw::nonlinear_viscous_damper:
        return curves[law.curve[0]].value(v);
      case SpringLaw::general_nonlinear_spring:
        return general_nonlinear(curves[law.curve[0]], curves[law.curve[law.curve[1] == none ? 0 : 1]], d, h);
      case SpringLaw::maxwell_spring:
        return maxwell(law, d, time, dt, h);
      case SpringLaw::inelastic_spring:
        return inelastic(law, curves[law.curve[0]], d, h);
    }
    return 0.0;
  };
  h.force = force();
  h.elongation = d;
  return h.force;
}

SpringBounds spring_bounds(const SpringMaterial& law, const std::vector<Curve>& curves) {
  const Curve* first = find(law, curves, 0);
  const Curve* second = find(law, curves, 1);
  switch (law.law) {
    case SpringLaw::elastic_spring:
      return {law.p[0], 0};
    case SpringLaw::viscous_damper:
      return {0, law.p[0]};
    case SpringLaw::elastoplastic_spring:
      return {std::max(law.p[0], law.p[1]), 0};
    case SpringLaw::nonlinear_elastic_spring:
      return {steepest(*first) * (second ? largest(*second) : 1.0), second ? steepest(*second) * largest(*first) : 0.0};
    case SpringLaw::nonlinear_viscous_damper:
      return {0, steepest(*first)};
    case SpringLaw::general_nonlinear_spring:
      return {std::max(steepest(*first), second ? steepest(*second) : 0.0), 0};
    case SpringLaw::maxwell_spring:
      return {std::max(law.p[0], law.p[1]), 0};
    case SpringLaw::inelastic_spring:
      return {std::max(law.p[0], steepest(*first)), 0};
  }
  return {};
}

void check_spring(const SpringMaterial& law, const std::vector<Curve>& curves, const std::string& name,
                  Diagnostics& diagnostics) {
  const bool by_curve = law.law == SpringLaw::nonlinear_elastic_spring || law.law == SpringLaw::nonlinear_viscous_damper ||
                        law.law == SpringLaw::general_nonlinear_spring || law.law == SpringLaw::inelastic_spring;
  if (by_curve && law.curve[0] == none) {
    diagnostics.error(name + " has no curve", "give the number of its *DEFINE_CURVE");
  }
  switch (law.law) {
    case SpringLaw::elastoplastic_spring:
      if (!(law.p[0] > law.p[1])) {
        diagnostics.error(name + " has a tangent stiffness KT that is not below its elastic stiffness K", "give K > KT",
                          "*MAT_SPRING_ELASTOPLASTIC");
      }
      break;
    case SpringLaw::general_nonlinear_spring:
      if (law.p[0] != 0) {
        diagnostics.error(name + " has hardening BETA = " + std::to_string(law.p[0]) + "; this version computes BETA = 0 only",
                          "set BETA = 0 (tension and compression yield independently)", "*MAT_SPRING_GENERAL_NONLINEAR");
      } else if (law.curve[1] != none) {
        const std::vector<double>& y = curves[law.curve[1]].y;
        if (!std::is_sorted(y.begin(), y.end())) {
          diagnostics.error(name + " has an unloading curve that falls somewhere", "let the force of LCDU rise everywhere",
                            "*MAT_SPRING_GENERAL_NONLINEAR");
        }
      }
      break;
    case SpringLaw::maxwell_spring:
      if (law.p[5] != 0) {
        diagnostics.error(name + " has COPT = " + std::to_string(law.p[5]) + "; this version computes COPT = 0 only",
                          "set COPT = 0", "*MAT_SPRING_MAXWELL");
      }
      break;
    default:
      break;
  }
}

}  // namespace kardan

// Metals whose yield stress is a power of the plastic strain, on a number type R:
//   *MAT_ISOTROPIC_ELASTIC_PLASTIC (012)      Y = SIGY + E_p p,  E_p = E ETAN/(E - ETAN)
//   *MAT_POWER_LAW_PLASTICITY (018)           Y = K (e_y + p)^N f(r)
//   *MAT_SIMPLIFIED_JOHNSON_COOK (098)        Y = (A + B p^N) f(r)
// and the mechanical part of *MAT_JOHNSON_COOK (015, johnson_cook.hpp).
//
// Sources: Johnson and Cook 1983, Proc. 7th Int. Symp. Ballistics, 541-547; Hallquist, LS-DYNA Theory Manual 2006, Material Models 12, 15,
// 18, 98. Factors f over the rate r, with r* = r/EPS0, 1 at least:
//   Cowper and Symonds 1957   1 + (r/C)^(1/P)              Johnson and Cook    1 + C log r*
//   Huh and Kang 2002         1 + C log r* + C2 (log r*)^2 Allen, Rule and Jones 1997   (r*)^C
// r is that of the plastic strain where VP = 1; else of the total strain: sqrt(d:d) for MAT_018, sqrt(2/3 d':d') for Johnson and Cook's.
// A point fails when p reaches EPSF or PSFAIL.
#pragma once

#include "kardan/materials/hardening.hpp"
#include "kardan/materials/j2_flow.hpp"

namespace kardan {

struct FieldMaterial;

/// f(r) and its slope.
struct RateFactor {
  enum class Form { constant, cowper_symonds, logarithm, quadratic, power };
  Form form = Form::constant;
  CowperSymonds cowper_symonds;
  double c = 0, c2 = 0;
  double reference = 1;  ///< EPS0

  template <class R>
  [[gnu::always_inline]] ValueAndSlope<R> at(const R& rate) const {
    const R one(1.0), zero(0.0);
    if (form == Form::constant) return {one, zero};
    if (form == Form::cowper_symonds) {
      const R factor = cowper_symonds.factor_of_rate(rate);
      return {factor, (factor - one) * R(cowper_symonds.power) / max(rate, R(1e-300))};
    }
    const R relative = max(rate * R(1 / reference), one), l = log(relative);
    const R per_rate = select(relative > one, one / max(rate, R(1e-300)), zero);
    if (form == Form::power) {
      const R factor = exp(R(c) * l);
      return {factor, R(c) * factor * per_rate};
    }
    return {one + l * (R(c) + R(c2) * l), (R(c) + R(2 * c2) * l) * per_rate};
  }
};

/// A point keeps its effective plastic strain.
struct PowerYield {
  static constexpr std::size_t history = 1;
  static constexpr double unlimited = 1e300;

  double a = 0, b = 0, n = 1, offset = 0;  ///< Y = a + b (offset + p)^n
  RateFactor rate_factor;
  bool viscoplastic = false;               ///< VP = 1
  bool effective_rate = false;             ///< of the deviator with the factor 2/3
  double max_static = unlimited;           ///< SIGMAX: before the factor of the rate
  double saturation = unlimited;           ///< SIGSAT: after it
  double failure_strain = 0;               ///< 0 = none

  bool can_fail() const { return failure_strain > 0; }
  ElementDeletion deletion() const { return {}; }
  void start(double* values) const { values[0] = 0; }

  template <class R>
  struct Flow {
    R strain, rate;
    double per_time = 0;  ///< 1/dt
  };

  template <class R>
  [[gnu::always_inline]] Flow<R> begin(const StrainIncrement<R>& e, double dt, const double* values) const {
    Flow<R> f{R::load(values), R(0.0), dt > 0 ? 1 / dt : 0.0};
    if (rate_factor.form == RateFactor::Form::constant || viscoplastic) return f;
    const R deviator = max(e.square - e.volume * e.volume * R(1.0 / 3.0), R(0.0));
    f.rate = sqrt(effective_rate ? R(2.0 / 3.0) * deviator : e.square) * R(f.per_time);
    return f;
  }
  template <class R>
  [[gnu::always_inline]] R rate(const Flow<R>& f, const R& dp) const {
    return viscoplastic ? dp * R(f.per_time) : f.rate;
  }

  template <class R>
  [[gnu::always_inline]] ValueAndSlope<R> at(const Flow<R>& f, const R& dp) const {
    const R strain = f.strain + dp + R(offset), zero(0.0);
    R stress, slope;
    if (n == 1) {
      stress = R(a) + R(b) * strain;
      slope = R(b);
    } else {
      const R power = R(b) * pow(strain, n);
      stress = R(a) + power;
      slope = R(n) * power / max(strain, R(1e-200));
    }
    if (max_static < unlimited) {
      const auto capped = stress > R(max_static);
      stress = select(capped, R(max_static), stress);
      slope = select(capped, zero, slope);
    }
    if (rate_factor.form != RateFactor::Form::constant) {
      const ValueAndSlope<R> factor = rate_factor.at(rate(f, dp));
      slope = slope * factor.value + stress * factor.slope * R(viscoplastic ? f.per_time : 0.0);
      stress = stress * factor.value;
    }
    if (saturation < unlimited) {
      const auto capped = stress > R(saturation);
      stress = select(capped, R(saturation), stress);
      slope = select(capped, zero, slope);
    }
    return {max(stress, zero), slope};
  }

  template <class R>
  [[gnu::always_inline]] R finish(const Flow<R>& f, const R& dp, const R&, const R&, double* values) const {
    const R strain = f.strain + dp;
    strain.store(values);
    return failure_strain > 0 ? select(strain < R(failure_strain), R(0.0), R(1.0)) : R(0.0);
  }
};

/// From the deck's A, B, N, C, EPSO of the keywords of Johnson and Cook; complains where they make no sense.
PowerYield johnson_cook_yield(LawSource& source, const FieldMaterial& material);

using PowerPlastic = J2Flow<PowerYield>;
template <>
std::optional<PowerPlastic> PowerPlastic::make(LawSource& source);

}  // namespace kardan

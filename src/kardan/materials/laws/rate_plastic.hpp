// *MAT_PIECEWISE_LINEAR_PLASTICITY (024) and *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY (123) with everything: curves by strain rate, factors over
// the rate, the viscoplastic formulation, failure, yield stresses that fall. On a number type R. The plain law, which is faster, is
// piecewise_plastic.hpp with plastic_plane_stress.hpp; law_table.cpp takes this one where the deck asks for more.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 24; LS-DYNA keyword manual II, *MAT_024. With the effective plastic strain
// p and the strain rate r,
//   LCSS a table    Y = Y(p, r)                           between the curves linearly over r, or over log r
//   LCSR            Y = Y(p) f(r)
//   C, P            Y = Y(p) (1 + (r/C)^(1/P))            Cowper and Symonds 1957
//   VP = 1, SIGY    Y = Y(p) + SIGY (r/C)^(1/P)
// where r is, with the total strain rate d and its deviator d',
//   VP = 0   sqrt(d:d)        VP = 3   the same, averaged over the steps: r = a r_before + (1 - a) sqrt(d:d), a = RFILTF
//   VP = -1  sqrt(d':d')      VP = 1   the rate of p itself, which the return mapping iterates.
// A point fails when p reaches FAIL.
#pragma once

#include "kardan/materials/j2_flow.hpp"
#include "kardan/materials/yield_family.hpp"

namespace kardan {

enum class RateMeasure { total, deviatoric, plastic, filtered };

/// A point keeps its effective plastic strain and the strain rate of the last step.
struct RateYield {
  static constexpr std::size_t history = 2;

  YieldFamily family;
  RateMeasure measure = RateMeasure::total;
  double filter = 0;          ///< RFILTF
  CowperSymonds rate_law;
  double added_yield = 0;     ///< SIGY where its share of the rate is added; 0: the whole yield stress is multiplied
  RateCurve rate_curve;
  double failure_strain = 0;  ///< FAIL; 0 = none
  ElementDeletion when;

  bool can_fail() const { return failure_strain > 0 || when.step > 0; }
  ElementDeletion deletion() const { return when; }
  void start(double* values) const { values[0] = values[1] = 0; }
  bool rate_dependent() const { return family.curve_count > 1 || rate_law.active() || rate_curve.active(); }

  template <class R>
  struct Flow {
    R strain, rate;
    double per_time = 0;  ///< 1/dt
  };

  template <class R>
  [[gnu::always_inline]] Flow<R> begin(const StrainIncrement<R>& e, double dt, const double* values) const {
    Flow<R> f{R::load(values), R(0.0), dt > 0 ? 1 / dt : 0.0};
    if (!rate_dependent() || measure == RateMeasure::plastic) return f;
    R square = e.square;
    if (measure == RateMeasure::deviatoric) square = max(square - e.volume * e.volume * R(1.0 / 3.0), R(0.0));
    f.rate = sqrt(square) * R(f.per_time);
    if (measure == RateMeasure::filtered) f.rate = R(filter) * R::load(values + block_lanes) + R(1 - filter) * f.rate;
    return f;
  }

  template <class R>
  [[gnu::always_inline]] ValueAndSlope<R> at(const Flow<R>& f, const R& dp) const {
    const bool plastic = measure == RateMeasure::plastic;
    const R rate = plastic ? dp * R(f.per_time) : f.rate, over_dp(plastic ? f.per_time : 0.0);
    const auto y = family.at(f.strain + dp, rate);
    R stress = y.stress, slope = y.over_strain + y.over_rate * over_dp;
    if (rate_law.active()) {
      const R share = rate_law.factor_of_rate(rate) - R(1.0), share_slope = share * R(rate_law.power) / max(rate, R(1e-300)) * over_dp;
      if (added_yield > 0) {
        stress = stress + R(added_yield) * share;
        slope = slope + R(added_yield) * share_slope;
      } else {
        slope = slope * (R(1.0) + share) + stress * share_slope;
        stress = stress * (R(1.0) + share);
      }
    } else if (rate_curve.active()) {
      const ValueAndSlope<R> factor = rate_curve.at(rate);
      slope = slope * factor.value + stress * factor.slope * over_dp;
      stress = stress * factor.value;
    }
    return {max(stress, R(0.0)), slope};
  }

  template <class R>
  [[gnu::always_inline]] R finish(const Flow<R>& f, const R& dp, const R&, const R&, double* values) const {
    const R strain = f.strain + dp;
    strain.store(values);
    (measure == RateMeasure::plastic ? dp * R(f.per_time) : f.rate).store(values + block_lanes);
    return failure_strain > 0 ? select(strain < R(failure_strain), R(0.0), R(1.0)) : R(0.0);
  }
};

using RatePlastic = J2Flow<RateYield>;
template <>
std::optional<RatePlastic> RatePlastic::make(LawSource& source);

}  // namespace kardan

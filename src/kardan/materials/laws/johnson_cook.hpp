// *MAT_JOHNSON_COOK (015) on a number type R: a power of the plastic strain, rate, adiabatic heating, damage, spall. The pressure is linear,
// K = E/(3 (1 - 2 nu)).
//
// Sources: Johnson and Cook 1983, Proc. 7th Int. Symp. Ballistics, 541-547 (strength); 1985, Eng. Fract. Mech. 21, 31-48 (fracture);
// Hallquist, LS-DYNA Theory Manual 2006, Material Model 15. In solids whose part names an equation of state its pressure takes the place of
// the linear one; s* is then that of the pressure at the step's start. With the mechanical part of power_plastic.hpp, Y0(p, r),
//   Y = Y0 (1 - T*^M),   T* = (T - TR)/(TM - TR) from 0 to 1,   dT = q dp/(rho CP)         all plastic work is heat
//   dD = dp/e_f,   e_f = max((D1 + D2 exp(D3 s*)) (1 + D4 log r*) (1 + D5 T*), EFMIN),   s* = mean stress (tension positive)/q.
// The yield stress of a step is that of the temperature at its start. A point fails at D = 1; with EROD it keeps its pressure instead.
// SPALL, limit -PC of the tension:
//   1  the mean stress is cut off at -PC
//   2  where the largest principal stress reaches -PC the material has spalled     3  where the mean stress reaches it
// Spalled solids carry compression only, points of shells fail.
#pragma once

#include "kardan/materials/equation_of_state.hpp"
#include "kardan/materials/laws/power_plastic.hpp"
#include "kardan/materials/principal.hpp"

namespace kardan {

/// Of a point: effective plastic strain, temperature, damage.
struct HeatedYield {
  static constexpr std::size_t history = 3;

  PowerYield cold;
  double room = 0, per_span = 0, m = 1;  ///< TR, 1/(TM - TR), M
  double heat = 0;                       ///< 1/(rho CP); 0: no heating
  bool damages = false;
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0, least_strain = 0;
  ElementDeletion when;

  bool can_fail() const { return damages; }
  ElementDeletion deletion() const { return when; }
  void start(double* values) const {
    values[0] = values[2] = 0;
    values[1] = room;
  }

  template <class R>
  struct Flow {
    PowerYield::Flow<R> cold;
    R temperature, relative, softening;  ///< T, T*, 1 - T*^M
  };

  template <class R>
  [[gnu::always_inline]] Flow<R> begin(const StrainIncrement<R>& e, double dt, const double* values) const {
    const R temperature = R::load(values + block_lanes), one(1.0);
    const R relative = min(max((temperature - R(room)) * R(per_span), R(0.0)), one);
    return {cold.begin(e, dt, values), temperature, relative, heat > 0 ? one - pow(relative, m) : one};
  }
  template <class R>
  [[gnu::always_inline]] ValueAndSlope<R> at(const Flow<R>& f, const R& dp) const {
    const ValueAndSlope<R> y = cold.at(f.cold, dp);
    return {y.value * f.softening, y.slope * f.softening};
  }
  template <class R>
  [[gnu::always_inline]] R finish(const Flow<R>& f, const R& dp, const R& mean, const R& effective, double* values) const {
    const R zero(0.0), one(1.0);
    cold.finish(f.cold, dp, mean, effective, values);
    (f.temperature + effective * dp * R(heat)).store(values + block_lanes);
    if (!damages) return zero;
    const R before = R::load(values + 2 * block_lanes);
    R damage = before;
    if (R::any(dp > zero)) {
      const R ratio = mean / max(effective, R(1e-300)), exponent = min(max(R(d3) * ratio, R(-600.0)), R(600.0));
      const R rate = max(cold.rate(f.cold, dp) * R(1 / cold.rate_factor.reference), one);
      const R fracture = (R(d1) + R(d2) * exp(exponent)) * (one + R(d4) * log(rate)) * (one + R(d5) * f.relative);
      damage = select(dp > zero, before + dp / max(fracture, R(least_strain)), before);
      damage.store(values + 2 * block_lanes);
    }
    return select(damage < one, zero, one);
  }
};

enum class Spall { no, cut_off, principal_stress, mean_stress };

/// A point keeps what its yield stress needs, 1 if it has spalled, and what its equation of state needs.
struct JohnsonCook {
  static constexpr std::size_t equation_place = 4, history = equation_place + PressureLaw::history, tensors = 0, plastic_strain = 0;

  J2Flow<HeatedYield> flow;
  Spall spall = Spall::no;
  double tension = 0;  ///< -PC
  bool keeps = false;  ///< EROD: solids that have failed stay, with their pressure
  bool has_equation = false;
  PressureLaw equation;

  static std::optional<JohnsonCook> make(LawSource& source);
  double longitudinal() const { return flow.longitudinal(); }
  double shear() const { return flow.shear(); }
  bool can_fail() const { return flow.can_fail() || spall != Spall::no || flow.deletion().step > 0; }
  ElementDeletion deletion() const { return flow.deletion(); }
  void start(double* values) const {
    flow.start(values);
    values[3] = 0;
    if (has_equation) equation.start(values + equation_place);
  }
  std::size_t used_history() const { return has_equation ? history : equation_place; }

  /// The flow at the pressure of t_(n-1), then the pressure of t_n.
  template <class R>
  [[gnu::always_inline]] void update_with_equation(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    const R one(1.0), before = trace(p.stress) * R(-1.0 / 3.0);
    const SymmetricTensor<R> old = scaled(p.stress, one, before);
    p.strain = scaled(p.strain, one, trace(p.strain) * R(-1.0 / 3.0));
    flow.update(p, t, values);
    const SymmetricTensor<R> now = scaled(p.stress, one, trace(p.stress) * R(-1.0 / 3.0));
    const R work = R(0.5) * (contraction(old, p.strain) + contraction(now, p.strain));
    const auto state = equation.advance(p, work, before, spall == Spall::cut_off ? -tension : -1e300, values + equation_place * block_lanes);
    p.stress = scaled(now, one, -state.pressure);
    p.modulus = state.stiffness + R(4.0 / 3.0 * shear());
  }

  /// 1 where the point has spalled, now or before.
  template <class R>
  [[gnu::always_inline]] R spalled(const SymmetricTensor<R>& s, const R& mean, double* values) const {
    const R tested = spall == Spall::principal_stress ? principal_range(s).largest : mean;
    const R flag = max(R::load(values + 3 * block_lanes), select(tested < R(tension), R(0.0), R(1.0)));
    flag.store(values + 3 * block_lanes);
    return flag;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    if (has_equation)
      update_with_equation(p, t, values);
    else
      flow.update(p, t, values);
    if (spall == Spall::no && !keeps) return;
    SymmetricTensor<R>& s = p.stress;
    const R zero(0.0), mean = (s.xx + s.yy + s.zz) * R(1.0 / 3.0);
    R fluid = keeps ? p.failed : zero, kept_mean = mean;
    if (keeps) p.failed = zero;
    if (spall == Spall::cut_off) {
      kept_mean = min(mean, R(tension));
    } else if (spall != Spall::no) {
      const R flag = spalled(s, mean, values);
      fluid = max(fluid, flag);
      kept_mean = select(flag > zero, min(mean, zero), mean);
    }
    const auto melts = fluid > zero;
    const auto deviator = [&](const R& x) { return select(melts, zero, x - mean); };
    s = {kept_mean + deviator(s.xx), kept_mean + deviator(s.yy), kept_mean + deviator(s.zz), select(melts, zero, s.xy),
         select(melts, zero, s.yz),  select(melts, zero, s.zx)};
  }
};

/// The same in plane stress.
struct JohnsonCookShell {
  static constexpr std::size_t history = JohnsonCook::equation_place;

  JohnsonCook law;
  J2PlaneStress<HeatedYield> flow;

  static JohnsonCookShell from(const JohnsonCook& law, double shear_factor) {
    return {law, J2PlaneStress<HeatedYield>::from(law.flow, shear_factor)};
  }
  void start(double* values) const { law.start(values); }
  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime& t, double* values) const {
    flow.update(p, t, values);
    if (law.spall != Spall::principal_stress && law.spall != Spall::mean_stress) return;
    const PlaneStress<R>& s = p.stress;
    const R mean = (s.xx + s.yy) * R(1.0 / 3.0);
    p.failed = max(p.failed, law.spalled({s.xx, s.yy, R(0.0), s.xy, s.yz, s.zx}, mean, values));
  }
};

}  // namespace kardan

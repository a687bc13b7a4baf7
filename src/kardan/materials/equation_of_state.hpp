// Equations of state, on a number type R: the pressure of compression and internal energy, for laws that know only the deviator of the
// stress themselves (*MAT_NULL, *MAT_JOHNSON_COOK).
//
// mu = 1/V - 1, V = V/V0, E internal energy per initial volume, p = A(mu) + B(mu) E:
//   *EOS_LINEAR_POLYNOMIAL: A = C0 + C1 mu + C2 mu^2 + C3 mu^3, B = C4 + C5 mu + C6 mu^2, C2 and C6 only in compression;
//   *EOS_GRUNEISEN: A = rho0 C^2 mu [1 + (1 - g/2) mu - a/2 mu^2] / [1 - (S1 - 1) mu - S2 mu^2/(mu + 1) - S3 mu^3/(mu + 1)^2]^2 in
//     compression, rho0 C^2 mu in expansion, B = g + a mu (the shock velocity is C + S1 u_p + …).
// The energy is advanced with the pressure, implicitly and in closed form, with the work of the deviator and the bulk viscosity q:
//   E_n = E* - dV p_n/2,   E* = E_(n-1) + V_mid s_mid:de - dV (p_(n-1)/2 + q),   p_n = (A + B E*)/(1 + B dV/2).
// rho0 c^2 = A' + B' E + B p V^2 (isentropic). Sources: Hallquist, LS-DYNA Theory Manual 2006, "Equation of state models"; Wilkins 1964, Methods in
// Computational Physics 3, 211-263. Pressures, E [force/length^2].
#pragma once

#include <cstddef>
#include <optional>

#include "kardan/materials/point.hpp"

namespace kardan {

struct LawSource;

struct PressureLaw {
  static constexpr std::size_t history = 2;  ///< E, V

  bool gruneisen = false;
  double c[7] = {};         ///< C0 … C6; or rho0 C^2, S1, S2, S3, gamma0, a
  double initial_energy = 0;  ///< E0

  /// From the EOSID of the part; complains where there is none, or one that cannot be computed.
  static std::optional<PressureLaw> make(LawSource& source);
  void start(double* values) const {
    values[0] = initial_energy;
    values[1] = 1;
  }
  /// rho0 c^2 and pressure at the start.
  double initial_bulk() const { return gruneisen ? c[0] + c[5] * initial_energy + c[4] * initial_pressure() : c[1] + c[5] * initial_energy + c[4] * initial_pressure(); }
  double initial_pressure() const { return gruneisen ? c[4] * initial_energy : c[0] + c[4] * initial_energy; }

  template <class R>
  struct Coefficients {
    R a, b, slope_a, slope_b;  ///< A, B and their derivatives by mu
  };
  template <class R>
  [[gnu::always_inline]] Coefficients<R> coefficients(const R& mu) const {
    const R zero(0.0), one(1.0), two(2.0), squeezed = max(mu, zero);
    if (!gruneisen) {
      const R q2 = R(c[2]) * squeezed, q6 = R(c[6]) * squeezed;
      return {R(c[0]) + mu * (R(c[1]) + q2 + R(c[3]) * mu * mu), R(c[4]) + mu * (R(c[5]) + q6),
              R(c[1]) + two * q2 + R(3.0 * c[3]) * mu * mu, R(c[5]) + two * q6};
    }
    const R m = squeezed, f = R(c[0]), density = one + m, x = m / density;
    const R top = one + m * (R(1.0 - 0.5 * c[4]) - R(0.5 * c[5]) * m), top_slope = R(1.0 - 0.5 * c[4]) - R(c[5]) * m;
    const R root = max(one - R(c[1] - 1.0) * m - R(c[2]) * m * x - R(c[3]) * m * x * x, R(1e-2));
    const R root_slope = R(1.0 - c[1]) - R(c[2]) * x * (two - x) - R(c[3]) * x * x * (R(3.0) - two * x);
    const R over = one / (root * root);
    const R a = f * m * top * over, slope = f * over * (top + m * top_slope - two * m * top * root_slope / root);
    return {select(mu > zero, a, f * mu), R(c[4]) + R(c[5]) * mu, select(mu > zero, slope, f), R(c[5])};
  }

  template <class R>
  struct State {
    R pressure, stiffness;  ///< p and rho0 c^2 at t_n
  };
  /// The pressure at t_n, not below `cutoff`. @param deviator_work s_mid:de over the step; @param before the pressure at t_(n-1)
  template <class R>
  [[gnu::always_inline]] State<R> advance(const MaterialPoint<R>& p, const R& deviator_work, const R& before, double cutoff,
                                          double* values) const {
    const R half(0.5), one(1.0), v_old = R::load(values + block_lanes), v = p.volume, dv = v - v_old;
    const Coefficients<R> k = coefficients(one / v - one);
    const R energy = R::load(values) + half * (v + v_old) * deviator_work - dv * (half * before + p.viscosity);
    const R pressure = max((k.a + k.b * energy) / (one + half * k.b * dv), R(cutoff));
    const R energy_now = energy - half * dv * pressure;
    energy_now.store(values);
    v.store(values + block_lanes);
    // 1e-3: a lower bound in tension, where the polynomial may flatten out.
    return {pressure, max(k.slope_a + k.slope_b * energy_now + k.b * pressure * v * v, R(1e-3 * initial_bulk()))};
  }
};

}  // namespace kardan

// *MAT_OGDEN_RUBBER (077_O), on a number type R.
//
// Source: Ogden 1972, Proc. Roy. Soc. A 326, 565-584; Hallquist, LS-DYNA Theory Manual 2006, Material Model 77: with the isochoric
// principal stretches l_i = J^(-1/3) lambda_i,
//   W = sum_j (mu_j/alpha_j) (l_1^alpha_j + l_2^alpha_j + l_3^alpha_j - 3) + K (J - 1 - log J),
//   tau_i = J sigma_i = sum_j mu_j (l_i^alpha_j - S_j/3) + K (J - 1),   S_j = sum_k l_k^alpha_j,
// mu = 1/2 sum_j mu_j alpha_j, K = 2 mu (1 + nu)/(3 (1 - 2 nu)), beside it the Prony series of prony.hpp. Principal stiffness:
//   lambda_i^2 d2W/dlambda_i^2 = sum_j [mu_j alpha_j (l_i^alpha_j/3 + S_j/9) - mu_j (l_i^alpha_j - S_j/3)] + K.
// mu_j [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/principal.hpp"
#include "kardan/materials/prony.hpp"

namespace kardan {

struct LawSource;

struct Ogden {
  static constexpr std::size_t history = 6 * (1 + PronySeries::most), tensors = 1 + PronySeries::most;  ///< at most: b, h_i
  static constexpr bool finite_strain = true;
  static constexpr std::size_t most = 8;

  std::size_t terms = 0;
  double mu[most] = {}, alpha[most] = {}, bulk = 0;
  PronySeries prony;

  /// From *MAT_OGDEN_RUBBER; complains where it cannot be computed.
  static std::optional<Ogden> make(LawSource& source);
  double longitudinal() const { return bulk + 4.0 / 3.0 * shear(); }
  double shear() const { return elastic_shear() + prony.instantaneous(); }
  double elastic_shear() const {
    double sum = 0;
    for (std::size_t j = 0; j < terms; ++j) sum += 0.5 * mu[j] * alpha[j];
    return sum;
  }
  std::size_t used_tensors() const { return 1 + prony.terms; }
  std::size_t used_history() const { return 6 * used_tensors(); }
  void start(double* values) const {
    start_deformation(values);
    for (std::size_t i = 6; i < used_history(); ++i) values[i] = 0;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    const auto now = Deformation<R>::advance(p, values);
    const Principal<R> main = principal(now.b);
    const R j = now.volume, third(1.0 / 3.0), mean_log = log(j) * third;
    R logarithm[3], tau[3], stiffness[3];
    for (int i = 0; i < 3; ++i) {
      logarithm[i] = R(0.5) * log(max(main.value[i], R(1e-200))) - mean_log;
      tau[i] = R(bulk) * (j - R(1.0));
      stiffness[i] = R(bulk);
    }
    for (std::size_t k = 0; k < terms; ++k) {
      R power[3];
      for (int i = 0; i < 3; ++i) power[i] = exp(R(alpha[k]) * logarithm[i]);
      const R sum = power[0] + power[1] + power[2];
      for (int i = 0; i < 3; ++i) {
        const R own = R(mu[k]) * (power[i] - third * sum);
        tau[i] += own;
        stiffness[i] += R(mu[k] * alpha[k]) * (third * power[i] + R(1.0 / 9.0) * sum) - own;
      }
    }
    const R over_j = R(1.0) / j;
    const R sigma[3] = {tau[0] * over_j, tau[1] * over_j, tau[2] * over_j};
    p.stress = main.assemble(sigma);
    prony.add(p, t, values + 6 * block_lanes);
    p.modulus = max(max(stiffness[0], stiffness[1]), stiffness[2]) + R(4.0 / 3.0 * prony.instantaneous());
  }
};

}  // namespace kardan

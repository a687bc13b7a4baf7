// *MAT_LOW_DENSITY_FOAM (057), on a number type R: highly compressible urethane foam without Poisson's effect.
//
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 57. Principal stretches lambda_i of b, nominal stresses each of its own
// stretch, tau_i = -f(1 - lambda_i) in compression by the curve LCID, E (lambda_i - 1) but not above TC in tension, and
//   sigma_i = tau_i lambda_i/J.
// Unloading, as the Keyword User's Manual gives it for *MAT_FU_CHANG_FOAM: tau_i (1 - d) in compression,
//   d = (1 - HU) [1 - (W/W_max)^SHAPE],   W = sum_i int f over the compressed stretches, W_max the largest W so far.
// Stiffness for the time step: lambda_i^2 (dtau_i/dlambda_i + tau_i^2 (1 - HU) SHAPE/W_max). Stresses [force/length^2].
#pragma once

#include <optional>

#include "kardan/materials/curve_table.hpp"
#include "kardan/materials/finite_strain.hpp"
#include "kardan/materials/principal.hpp"

namespace kardan {

struct LawSource;

struct LowDensityFoam {
  static constexpr std::size_t history = 7, tensors = 1, largest_energy = 6;  ///< b; W_max
  static constexpr bool finite_strain = true;

  CurveTable curve;
  double youngs_modulus = 0, cutoff = 0;  ///< E of tension, TC
  double steepest = 0;                    ///< of E and the slopes of the curve
  double dissipated = 0, shape = 1;       ///< 1 - HU, SHAPE

  /// From *MAT_LOW_DENSITY_FOAM; complains where it cannot be computed.
  static std::optional<LowDensityFoam> make(LawSource& source);
  double longitudinal() const { return steepest; }
  double shear() const { return 0.5 * steepest; }
  void start(double* values) const {
    start_deformation(values);
    values[largest_energy] = 0;
  }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime&, double* values) const {
    const auto now = Deformation<R>::advance(p, values);
    const Principal<R> main = principal(now.b);
    const R zero(0.0), one(1.0);
    R stretch[3], tau[3], slope[3], energy(0.0);
    for (int i = 0; i < 3; ++i) {
      stretch[i] = sqrt(main.value[i]);
      const R squeeze = one - stretch[i];
      const auto in = curve.at(squeeze);
      const auto compressed = squeeze > zero;
      energy += select(compressed, in.integral, zero);
      tau[i] = select(compressed, -in.y, min(R(-youngs_modulus) * squeeze, R(cutoff)));
      slope[i] = select(compressed, abs(in.slope), R(youngs_modulus));
    }
    R factor = one, steeper = zero;
    if (dissipated > 0) {
      const R largest = max(R::load(values + largest_energy * block_lanes), energy);
      largest.store(values + largest_energy * block_lanes);
      const R share = energy / max(largest, R(1e-300));
      const R power = shape == 1.0 ? share : exp(R(shape) * log(max(share, R(1e-30))));
      const auto squeezed = largest > R(1e-12 * steepest);
      factor = select(squeezed, one - R(dissipated) * (one - power), one);
      steeper = select(squeezed, R(dissipated * (shape > 1.0 ? shape : 1.0)) / largest, zero);
    }
    R sigma[3], stiffest = R(0.0);
    for (int i = 0; i < 3; ++i) {
      const auto compressed = tau[i] < zero;
      stiffest = max(stiffest, main.value[i] * (slope[i] + select(compressed, steeper * tau[i] * tau[i], zero)));
      sigma[i] = select(compressed, factor * tau[i], tau[i]) * stretch[i] / now.volume;
    }
    p.stress = main.assemble(sigma);
    p.modulus = max(stiffest, R(1e-2 * steepest));
  }
};

}  // namespace kardan

// *MAT_NULL (009), on a number type R: a fluid. Its pressure is that of the equation of state, not below PC; its deviator is viscous,
//   s = 2 MU e',   e' the deviator of the strain rate.
// Source: Hallquist, LS-DYNA Theory Manual 2006, Material Model 9, and the Keyword User's Manual for the factor 2. Shells of it weigh and
// carry nothing. MU [stress x time].
#pragma once

#include <optional>

#include "kardan/materials/equation_of_state.hpp"
#include "kardan/materials/finite_strain.hpp"

namespace kardan {

struct NullMaterial {
  static constexpr std::size_t history = PressureLaw::history, tensors = 0;

  PressureLaw pressure_law;
  double cutoff = 0;     ///< PC
  double viscosity = 0;  ///< MU

  /// From *MAT_NULL and the part's equation of state; complains where it cannot be computed.
  static std::optional<NullMaterial> make(LawSource& source);
  double longitudinal() const { return pressure_law.initial_bulk(); }
  double shear() const { return 0; }
  void start(double* values) const { pressure_law.start(values); }

  template <class R>
  [[gnu::always_inline]] void update(MaterialPoint<R>& p, const StepTime& t, double* values) const {
    const R before = trace(p.stress) * R(-1.0 / 3.0);
    const SymmetricTensor<R> old = scaled(p.stress, R(1.0), before);
    const R rate(t.dt > 0 ? 2 * viscosity / t.dt : 0.0);
    const SymmetricTensor<R> now = scaled(p.strain, rate, trace(p.strain) * rate * R(-1.0 / 3.0));
    const R work = R(0.5) * (contraction(old, p.strain) + contraction(now, p.strain));
    const auto state = pressure_law.advance(p, work, before, cutoff, values);
    p.stress = scaled(now, R(1.0), -state.pressure);
    p.modulus = state.stiffness;
  }
};

/// Shells of *MAT_NULL.
struct NullShell {
  static constexpr std::size_t history = 0;

  static NullShell from(const NullMaterial&, double) { return {}; }
  void start(double*) const {}
  template <class R>
  [[gnu::always_inline]] void update(ShellPoint<R>& p, const StepTime&, double*) const {
    p.stress = {};
  }
};

}  // namespace kardan

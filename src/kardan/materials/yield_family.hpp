// Yield stress over effective plastic strain by curves for several strain rates, as the kernels read it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kardan/base/lanes.hpp"
#include "kardan/materials/bracketed_root.hpp"
#include "kardan/materials/hardening.hpp"

namespace kardan {

/// Between the curves of two rates the stress is interpolated linearly, over the rate or over its natural logarithm; outside the rates the
/// first and the last curve hold.
struct YieldFamily {
  const double* rows = nullptr;   ///< of curve after curve, row_count each (hardening_columns)
  std::size_t row_count = 0;      ///< a power of two
  const double* rates = nullptr;  ///< [rate_count], or their logarithms; a power of two, infinity after the last one
  std::size_t rate_count = 0;
  std::size_t curve_count = 0;
  bool logarithmic = false;

  double initial() const { return rows[1] - rows[2] * rows[0]; }

  /// Yield stress of one curve; `offset` is where its rows begin.
  template <class R, class Mask>
  [[gnu::always_inline]] ValueAndSlope<R> on_curve(const Mask& offset, const R& p) const {
    Mask row = offset;
    for (std::size_t half = row_count / 2; half > 0; half /= 2) {
      const Mask next = row + static_cast<std::int64_t>(half * hardening_columns);
      row = R::gather(rows, next) > p ? row : next;
    }
    const R slope = R::gather(rows + 2, row);
    return {R::gather(rows + 1, row) + slope * (p - R::gather(rows, row)), slope};
  }

  template <class R>
  struct Point {
    R stress, over_strain, over_rate;  ///< yield stress and its derivatives
  };
  template <class R>
  [[gnu::always_inline]] Point<R> at(const R& p, const R& rate) const {
    using Mask = typename R::Mask;
    const R zero(0.0);
    if (curve_count == 1) {
      const ValueAndSlope<R> y = on_curve<R>(Mask{}, p);
      return {y.value, y.slope, zero};
    }
    const R positive = max(rate, R(1e-300)), place = logarithmic ? log(positive) : rate;
    Mask lower{};
    for (std::size_t half = rate_count / 2; half > 0; half /= 2) {
      const Mask next = lower + static_cast<std::int64_t>(half);
      lower = R::gather(rates, next) > place ? lower : next;
    }
    const auto last = static_cast<std::int64_t>(curve_count - 1);
    const Mask upper = lower < last ? lower + 1 : lower;
    const auto stride = static_cast<std::int64_t>(row_count * hardening_columns);
    const ValueAndSlope<R> low = on_curve<R>(lower * stride, p), high = on_curve<R>(upper * stride, p);
    const R from = R::gather(rates, lower), width = R::gather(rates, upper) - from;
    const auto between = (width > zero) & (place > from);
    const R share = select(between, (place - from) / select(between, width, R(1.0)), zero);
    R over_rate = select(between, (high.value - low.value) / select(between, width, R(1.0)), zero);
    if (logarithmic) over_rate = over_rate / positive;
    return {low.value + share * (high.value - low.value), low.slope + share * (high.slope - low.slope), over_rate};
  }
};

/// A factor over the rate by a curve; outside the curve its end values hold.
struct RateCurve {
  HardeningCurve curve;

  bool active() const { return curve.row_count > 0; }
  template <class R>
  [[gnu::always_inline]] ValueAndSlope<R> at(const R& rate) const {
    const auto piece = curve.piece(rate);
    return {piece.stress + piece.slope * (rate - piece.from), piece.slope};
  }
};

}  // namespace kardan

// Load curves and tables (*DEFINE_CURVE, *DEFINE_TABLE).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"

namespace kardan {

/// A piecewise linear function y(x) with strictly ascending abscissae, scale factors and offsets already applied:
/// x = SFA (A + OFFA), y = SFO (O + OFFO). Outside its range the end value holds.
struct Curve {
  UserId id = 0;
  std::string title;
  std::vector<double> x, y;
  std::vector<double> area;  ///< integral from x.front() to x[i], by prepare(); integral() sums afresh where it is empty
  /// SIDR: the phase of a run that the curve belongs to, where it is one of time.
  enum class Phase : std::uint8_t { transient, relaxation, both } phase = Phase::transient;

  /// Fills `area`, which makes integral() as cheap as value().
  void prepare();
  /// y at `abscissa`. The curve has at least one point.
  double value(double abscissa) const;
  /// Slope of the segment that holds `abscissa` (0 outside the range).
  double slope(double abscissa) const;
  /// Integral of y from 0 to `abscissa`.
  double integral(double abscissa) const;
};

/// A family of curves over a parameter (*DEFINE_TABLE): value(v, x) interpolates linearly between the curves next to v.
struct Table {
  UserId id = 0;
  std::string title;
  std::vector<double> parameter;   ///< ascending
  std::vector<CurveIndex> curve;   ///< one for each parameter
};

}  // namespace kardan

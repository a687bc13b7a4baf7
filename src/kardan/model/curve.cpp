#include "kardan/model/curve.hpp"

#include <algorithm>
#include <cstddef>

namespace kardan {

namespace {

/// Index i of the segment [x_i, x_{i+1}] that holds `abscissa`; the caller has excluded the outside.
std::size_t segment(const std::vector<double>& x, double abscissa) {
  const auto upper = std::upper_bound(x.begin(), x.end(), abscissa);
  return static_cast<std::size_t>(upper - x.begin()) - 1;
}

}  // namespace

double Curve::value(double abscissa) const {
  if (abscissa <= x.front()) return y.front();
  if (abscissa >= x.back()) return y.back();
  const std::size_t i = segment(x, abscissa);
  return y[i] + (y[i + 1] - y[i]) * ((abscissa - x[i]) / (x[i + 1] - x[i]));
}

double Curve::slope(double abscissa) const {
  if (abscissa < x.front() || abscissa >= x.back()) return 0.0;
  const std::size_t i = segment(x, abscissa);
  return (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
}

void Curve::prepare() {
  area.assign(x.size(), 0.0);
  for (std::size_t i = 1; i < x.size(); ++i) area[i] = area[i - 1] + 0.5 * (y[i - 1] + y[i]) * (x[i] - x[i - 1]);
}

double Curve::integral(double abscissa) const {
  // Antiderivative that vanishes at x.front(), the end values held outside the range.
  const auto from_first = [this](double to) {
    if (to <= x.front()) return y.front() * (to - x.front());
    if (area.size() == x.size()) {
      if (to >= x.back()) return area.back() + y.back() * (to - x.back());
      const std::size_t i = segment(x, to);
      return area[i] + 0.5 * (y[i] + value(to)) * (to - x[i]);
    }
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      if (to <= x[i + 1]) return sum + 0.5 * (y[i] + value(to)) * (to - x[i]);
      sum += 0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]);
    }
    return sum + y.back() * (to - x.back());
  };
  return from_first(abscissa) - from_first(0.0);
}

}  // namespace kardan

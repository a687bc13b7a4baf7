// A curve of a material (stress over strain) as the kernels read it: straight pieces, the first and the last of which go on.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "kardan/model/curve.hpp"

namespace kardan {

struct CurveTable {
  static constexpr std::size_t columns = 4;  ///< x, y, slope, integral of y from 0 to x

  const double* rows = nullptr;  ///< owned by the caller; their number is a power of two, those past the last begin at infinity
  std::size_t row_count = 0;

  /// Rows of a curve with at least two points.
  static std::vector<double> rows_of(const Curve& curve) {
    std::vector<double> rows;
    const std::size_t pieces = curve.x.size() - 1, count = std::bit_ceil(pieces);
    double area = 0;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double x = curve.x[i], y = curve.y[i], slope = (curve.y[i + 1] - y) / (curve.x[i + 1] - x);
      area = i == 0 ? x * (y - 0.5 * slope * x) : area + 0.5 * (y + curve.y[i - 1]) * (x - curve.x[i - 1]);
      rows.insert(rows.end(), {x, y, slope, area});
    }
    for (std::size_t i = pieces; i < count; ++i) rows.insert(rows.end(), {std::numeric_limits<double>::infinity(), 0, 0, 0});
    return rows;
  }
  static CurveTable from(const std::vector<double>& rows) { return {rows.data(), rows.size() / columns}; }

  template <class R>
  struct Value {
    R y, slope, integral;
  };
  template <class R>
  [[gnu::always_inline]] Value<R> at(const R& x) const {
    typename R::Mask row{};
    for (std::size_t half = row_count / 2; half > 0; half /= 2) {
      const typename R::Mask next = row + static_cast<std::int64_t>(half * columns);
      const typename R::Mask below = R::gather(rows, next) > x;
      row = below ? row : next;
    }
    const R d = x - R::gather(rows, row), y = R::gather(rows + 1, row), slope = R::gather(rows + 2, row);
    return {y + slope * d, slope, R::gather(rows + 3, row) + d * (y + R(0.5) * slope * d)};
  }
};

}  // namespace kardan

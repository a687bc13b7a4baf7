// Yield stress over effective plastic strain as a table of straight pieces, and its dependence on the rate, as the kernels read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kardan {

/// Rows of a hardening table: from which strain, yield stress there, slope, to which strain.
inline constexpr std::size_t hardening_columns = 4;

/// The table as the kernels read it.
struct HardeningCurve {
  const double* rows = nullptr;  ///< owned by the caller
  std::size_t row_count = 0;

  explicit HardeningCurve() = default;
  explicit HardeningCurve(const std::vector<double>& table) : rows(table.data()), row_count(table.size() / hardening_columns) {}

  /// Yield stress at no plastic strain.
  double initial() const { return rows[1] - rows[2] * rows[0]; }

  template <class R>
  struct Piece {
    R from, stress, slope, to;
  };
  /// The piece that holds the plastic strain p: in a short table the pieces below it are counted, a long one is searched in halves.
  template <class R>
  [[gnu::always_inline]] Piece<R> piece(const R& p) const {
    if (row_count == 1) return {R(rows[0]), R(rows[1]), R(rows[2]), R(rows[3])};
    typename R::Mask row{};
    if (row_count <= counted_rows) {
      for (std::size_t k = 1; k < row_count; ++k) {
        row = R::choose(p < R(rows[k * hardening_columns]), row, row + static_cast<std::int64_t>(hardening_columns));
      }
    } else {
      for (std::size_t half = row_count / 2; half > 0; half /= 2) {
        const typename R::Mask next = row + static_cast<std::int64_t>(half * hardening_columns);
        row = R::choose(R::gather(rows, next) > p, row, next);
      }
    }
    return {R::gather(rows, row), R::gather(rows + 1, row), R::gather(rows + 2, row), R::gather(rows + 3, row)};
  }

 private:
  static constexpr std::size_t counted_rows = 16;
};

/// 1 + (rate/C)^(1/P) of Cowper and Symonds 1957; C = 0: no rate effect.
struct CowperSymonds {
  double constant = 0, power = 0;  ///< C [1/time], 1/P

  static CowperSymonds from(double c, double p) { return c > 0 && p > 0 ? CowperSymonds{c, 1 / p} : CowperSymonds{}; }
  bool active() const { return constant > 0; }
  /// @param square of the increment of strain, e_ij e_ij
  template <class R>
  [[gnu::always_inline]] R factor(const R& square, double dt) const {
    const double scale = dt > 0 ? 1 / (dt * constant) : 0.0;
    return factor_of_relative(sqrt(square) * R(scale));
  }
  template <class R>
  [[gnu::always_inline]] R factor_of_rate(const R& rate) const {
    return factor_of_relative(rate * R(1 / constant));
  }

 private:
  template <class R>
  [[gnu::always_inline]] R factor_of_relative(const R& relative) const {
    return R(1.0) + exp(log(max(relative, R(1e-200))) * R(power));  // the logarithm wants more than 0
  }
};

}  // namespace kardan

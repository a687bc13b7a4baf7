#include "kardan/rigid/block_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

/// Fill-reducing elimination order of the block graph (approximate minimum degree).
std::vector<int> elimination_order(int count, const std::vector<std::pair<int, int>>& pairs) {
  using Sparse = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : pairs) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Sparse graph(count, count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), permutation);
  return {permutation.indices().data(), permutation.indices().data() + count};
}

}  // namespace

void BlockCholesky::analyse(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& pairs) {
  const int count = static_cast<int>(sizes.size());
  size_ = sizes;
  first_row_.assign(sizes.size(), 0);
  row_count_ = 0;
  uniform_ = count > 0 ? sizes[0] : 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    KARDAN_ASSERT(sizes[i] >= 1 && sizes[i] <= 6);
    if (sizes[i] != uniform_) uniform_ = 0;
    first_row_[i] = row_count_;
    row_count_ += static_cast<std::size_t>(sizes[i]);
  }

  const std::vector<int> order = count > 0 ? elimination_order(count, pairs) : std::vector<int>{};
  std::vector<int> position(sizes.size());
  for (int k = 0; k < count; ++k) position[order[k]] = k;

  // Elimination graph: neighbours of each block that are eliminated after it, in positions.
  std::vector<std::set<int>> later(sizes.size());
  for (const auto& [i, j] : pairs) later[std::min(position[i], position[j])].insert(std::max(position[i], position[j]));
  for (int k = 0; k < count; ++k)
    if (!later[k].empty()) {
      const int parent = *later[k].begin();
      for (auto it = std::next(later[k].begin()); it != later[k].end(); ++it) later[parent].insert(*it);
    }

  std::size_t offset = 0;
  const auto allocate = [&](int rows, int columns) {
    const std::size_t at = offset;
    offset += static_cast<std::size_t>(rows * columns);
    return at;
  };
  diagonal_.assign(sizes.size(), 0);
  std::vector<std::map<int, std::size_t>> block_at(sizes.size());  // [column position][row position]
  columns_.clear();
  below_.clear();
  for (int k = 0; k < count; ++k) {
    const int block = order[k];
    diagonal_[block] = allocate(sizes[block], sizes[block]);
    Column column{block, sizes[block], diagonal_[block], first_row_[block], below_.size(), 0, 0, 0};
    for (int row : later[k]) {
      block_at[k][row] = allocate(sizes[order[row]], sizes[block]);
      below_.push_back({sizes[order[row]], first_row_[order[row]], block_at[k][row]});
    }
    column.end_below = below_.size();
    columns_.push_back(column);
  }
  updates_.clear();
  for (int k = 0; k < count; ++k) {
    columns_[k].first_update = updates_.size();
    for (const auto& [i, left] : block_at[k])
      for (const auto& [j, right] : block_at[k]) {
        if (j > i) continue;
        const std::size_t target = i == j ? diagonal_[order[i]] : block_at[j].at(i);
        updates_.push_back({left, right, target, sizes[order[i]], sizes[order[j]]});
      }
    columns_[k].end_update = updates_.size();
  }
  coupling_.clear();
  for (const auto& [i, j] : pairs) {
    const bool i_later = position[i] > position[j];
    const int row = i_later ? i : j, column = i_later ? j : i;
    coupling_.push_back({block_at[position[column]].at(position[row]), row, column});
  }
  values_.assign(offset, 0.0);
  original_diagonal_.assign(row_count_, 0.0);
}

void BlockCholesky::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

namespace {

/// Cholesky factor of the m x m block `a` (lower triangle, in place); the reciprocals of the pivots replace the diagonal.
/// A row whose pivot falls to `drop` times its diagonal entry or below is made inactive and reported to `on_drop(row)`.
template <class OnDrop>
inline void factor_diagonal(double* a, int m, double drop, const double* original, OnDrop on_drop) {
  for (int r = 0; r < m; ++r) {
    for (int c = 0; c < r; ++c) {
      double s = a[r * m + c];
      for (int k = 0; k < c; ++k) s -= a[r * m + k] * a[c * m + k];
      a[r * m + c] = s * a[c * m + c];
    }
    double d = a[r * m + r];
    for (int k = 0; k < r; ++k) d -= a[r * m + k] * a[r * m + k];
    if (!(d > drop * original[r])) {
      on_drop(r);
      for (int k = 0; k < r; ++k) a[r * m + k] = 0;
      a[r * m + r] = 0;  // reciprocal pivot 0: the row takes no part and its solution is 0
    } else {
      a[r * m + r] = 1.0 / std::sqrt(d);
    }
  }
}

/// b (rows x m) := b L^-T with the factor (reciprocal pivots) of the diagonal block.
inline void solve_below(double* b, int rows, const double* l, int m) {
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < m; ++c) {
      double s = b[r * m + c];
      for (int k = 0; k < c; ++k) s -= b[r * m + k] * l[c * m + k];
      b[r * m + c] = s * l[c * m + c];
    }
}

inline void update_block(double* target, const double* left, const double* right, int rows, int inner, int columns) {
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      double s = target[r * columns + c];
      for (int k = 0; k < inner; ++k) s -= left[r * inner + k] * right[c * inner + k];
      target[r * columns + c] = s;
    }
}

}  // namespace

template <int M>
void BlockCholesky::factor_blocks(double drop) {
  double* const v = values_.data();
  for (const Column& c : columns_)
    for (int r = 0; r < c.size; ++r)
      original_diagonal_[c.first_row + static_cast<std::size_t>(r)] = v[c.diagonal + static_cast<std::size_t>(r * (c.size + 1))];
  for (const Column& column : columns_) {
    const int m = M > 0 ? M : column.size;
    double* const l = v + column.diagonal;
    factor_diagonal(l, m, drop, original_diagonal_.data() + column.first_row,
                    [&](int r) { dropped_.emplace_back(column.block, r); });
    for (std::size_t b = column.first_below; b < column.end_below; ++b)
      solve_below(v + below_[b].offset, M > 0 ? M : below_[b].size, l, m);
    for (std::size_t i = column.first_update; i < column.end_update; ++i) {
      const Update& u = updates_[i];
      update_block(v + u.target, v + u.left, v + u.right, M > 0 ? M : u.rows, m, M > 0 ? M : u.columns);
    }
  }
}

void BlockCholesky::factor(double drop) {
  dropped_.clear();
  if (uniform_ == 3) {
    factor_blocks<3>(drop);
  } else if (uniform_ == 5) {
    factor_blocks<5>(drop);
  } else {
    factor_blocks<0>(drop);
  }
}

template <int M>
void BlockCholesky::solve_blocks(double* b) const {
  const double* const v = values_.data();
  for (const Column& column : columns_) {
    const int m = M > 0 ? M : column.size;
    double* const x = b + column.first_row;
    const double* const l = v + column.diagonal;
    for (int r = 0; r < m; ++r) {
      for (int c = 0; c < r; ++c) x[r] -= l[r * m + c] * x[c];
      x[r] *= l[r * m + r];
    }
    for (std::size_t i = column.first_below; i < column.end_below; ++i) {
      double* const y = b + below_[i].first_row;
      const double* const w = v + below_[i].offset;
      const int rows = M > 0 ? M : below_[i].size;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < m; ++c) y[r] -= w[r * m + c] * x[c];
    }
  }
  for (auto column = columns_.rbegin(); column != columns_.rend(); ++column) {
    const int m = M > 0 ? M : column->size;
    double* const x = b + column->first_row;
    const double* const l = v + column->diagonal;
    for (std::size_t i = column->first_below; i < column->end_below; ++i) {
      const double* const y = b + below_[i].first_row;
      const double* const w = v + below_[i].offset;
      const int rows = M > 0 ? M : below_[i].size;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < m; ++c) x[c] -= w[r * m + c] * y[r];
    }
    for (int r = m - 1; r >= 0; --r) {
      for (int c = r + 1; c < m; ++c) x[r] -= l[c * m + r] * x[c];
      x[r] *= l[r * m + r];
    }
  }
}

void BlockCholesky::solve(double* b) const {
  if (uniform_ == 3) {
    solve_blocks<3>(b);
  } else if (uniform_ == 5) {
    solve_blocks<5>(b);
  } else {
    solve_blocks<0>(b);
  }
}

}  // namespace kardan

// Sparse Cholesky factorisation A = L L^T of a symmetric positive definite matrix made of small dense blocks.
//
// The exact joints need it every cycle on the same pattern (one block row a joint, a coupling block for every pair of
// joints that share a body), so the symbolic part - fill-reducing order, fill, list of updates - is done once, and the
// numeric part walks flat arrays. General sparse libraries spend most of the time of such a solve on index look-ups:
// blocks of 1 to 6 rows are what they do worst.
//
// Source: George and Liu 1981, "Computer Solution of Large Sparse Positive Definite Systems", chapter 5 (symbolic
// factorisation by elimination graph); right-looking numeric phase.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace kardan {

class BlockCholesky {
 public:
  /// The block that couples the two block rows of a pair given to analyse(): row-major, rows of `row_block` by rows of
  /// `column_block` (the pair's two blocks, in the order of elimination).
  struct Coupling {
    std::size_t offset = 0;
    int row_block = 0, column_block = 0;
  };

  /// Fixes the pattern: sizes[i] in 1..6 is the number of rows of block i; `pairs` holds each coupled pair (i != j) once.
  void analyse(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& pairs);

  std::size_t rows() const { return row_count_; }
  int block_size(int block) const { return size_[static_cast<std::size_t>(block)]; }
  /// First row of a block in the right-hand side.
  std::size_t first_row(int block) const { return first_row_[static_cast<std::size_t>(block)]; }

  /// Sets every entry (fill included) to zero before the caller writes its blocks.
  void clear();
  /// Diagonal block, row-major size x size; the lower triangle is read.
  double* diagonal(int block) { return values_.data() + diagonal_[static_cast<std::size_t>(block)]; }
  std::size_t coupling_count() const { return coupling_.size(); }
  const Coupling& coupling(std::size_t pair) const { return coupling_[pair]; }
  double* values(const Coupling& c) { return values_.data() + c.offset; }

  /// Numeric factorisation in place. A row whose pivot falls to `drop` times its diagonal entry, or below, depends on the
  /// rows before it: it is made inactive (its solution is 0) and listed in dropped().
  void factor(double drop = 0.0);
  /// (block, row in the block) of every row that the last factor() made inactive.
  const std::vector<std::pair<int, int>>& dropped() const { return dropped_; }

  /// Solves A x = b in place; b has rows() entries in the order of the blocks.
  void solve(double* b) const;

 private:
  // M is the common block size, or 0 where sizes differ and are read from the columns.
  template <int M>
  void factor_blocks(double drop);
  template <int M>
  void solve_blocks(double* b) const;

  struct Update {  ///< target -= left right^T
    std::size_t left, right, target;
    int rows, columns;
  };
  struct Column {  ///< one eliminated block column
    int block, size;
    std::size_t diagonal, first_row;
    std::size_t first_below, end_below;    ///< into below_
    std::size_t first_update, end_update;  ///< into updates_
  };
  struct Below {
    int size;
    std::size_t first_row, offset;
  };

  int uniform_ = 0;  ///< common block size, 0 if sizes differ
  std::vector<int> size_;
  std::vector<std::size_t> first_row_, diagonal_;
  std::vector<Coupling> coupling_;
  std::vector<Column> columns_;  ///< in order of elimination
  std::vector<Below> below_;
  std::vector<Update> updates_;
  std::vector<double> values_;
  std::vector<double> original_diagonal_;  ///< scratch of factor(), by row
  std::vector<std::pair<int, int>> dropped_;
  std::size_t row_count_ = 0;
};

}  // namespace kardan

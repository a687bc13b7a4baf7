// The block factorisation against dense algebra.
#include "kardan/rigid/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>
#include <random>
#include <string>

namespace kardan::test {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs chain(int n) {
  Pairs pairs;
  for (int i = 0; i + 1 < n; ++i) pairs.emplace_back(i, i + 1);
  return pairs;
}
Pairs star(int n) {
  Pairs pairs;
  for (int i = 1; i < n; ++i) pairs.emplace_back(i, 0);
  return pairs;
}
/// A ring with two chords: elimination fills.
Pairs loop(int n) {
  Pairs pairs = chain(n);
  pairs.emplace_back(n - 1, 0);
  pairs.emplace_back(0, n / 2);
  pairs.emplace_back(n - 2, 1);
  return pairs;
}

struct Case {
  std::string name;
  std::vector<int> sizes;
  Pairs pairs;
};

std::vector<Case> cases() {
  const std::vector<int> mixed{1, 6, 3, 2, 5, 4, 1, 3, 6, 2, 5, 1};
  const int n = static_cast<int>(mixed.size());
  std::vector<Case> all;
  for (const auto& [shape, pairs] : {std::pair{"chain", chain(n)}, {"star", star(n)}, {"loop", loop(n)}, {"apart", Pairs{}}})
    for (const auto& [block, sizes] : {std::pair{"mixed", mixed}, {"three", std::vector<int>(mixed.size(), 3)},
                                       {"five", std::vector<int>(mixed.size(), 5)}, {"one", std::vector<int>(mixed.size(), 1)}})
      all.push_back({std::string(shape) + "_" + block, sizes, pairs});
  return all;
}

/// Copies a dense symmetric matrix of the pattern into the blocks.
void fill(const Eigen::MatrixXd& dense, const std::vector<int>& sizes, BlockCholesky& matrix) {
  const auto block = [&](int i, int j) {
    return dense.block(static_cast<Eigen::Index>(matrix.first_row(i)), static_cast<Eigen::Index>(matrix.first_row(j)),
                       sizes[static_cast<std::size_t>(i)], sizes[static_cast<std::size_t>(j)]);
  };
  const auto write = [](double* to, const Eigen::MatrixXd& b) {
    for (Eigen::Index r = 0; r < b.rows(); ++r)
      for (Eigen::Index c = 0; c < b.cols(); ++c) *to++ = b(r, c);
  };
  matrix.clear();
  for (int i = 0; i < static_cast<int>(sizes.size()); ++i) write(matrix.diagonal(i), block(i, i));
  for (std::size_t p = 0; p < matrix.coupling_count(); ++p) {
    const BlockCholesky::Coupling& c = matrix.coupling(p);
    write(matrix.values(c), block(c.row_block, c.column_block));
  }
}

/// J J^T of random rows in which the blocks of a pair share `width` columns: of the pattern, and of full rank if every block
/// has as many columns of its own as rows.
Eigen::MatrixXd random_matrix(const Case& c, const BlockCholesky& matrix, std::mt19937& random, int repeated_block = -1) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const int width = 6;
  const auto blocks = static_cast<Eigen::Index>(c.sizes.size());
  const auto rows = static_cast<Eigen::Index>(matrix.rows());
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows, width * (blocks + static_cast<Eigen::Index>(c.pairs.size())));
  const auto randomise = [&](int block, Eigen::Index column) {
    for (int r = 0; r < c.sizes[static_cast<std::size_t>(block)]; ++r)
      for (int k = 0; k < width; ++k) j(static_cast<Eigen::Index>(matrix.first_row(block)) + r, column + k) = uniform(random);
  };
  for (int b = 0; b < blocks; ++b) randomise(b, width * b);
  for (std::size_t p = 0; p < c.pairs.size(); ++p) {
    const Eigen::Index column = width * (blocks + static_cast<Eigen::Index>(p));
    randomise(c.pairs[p].first, column);
    randomise(c.pairs[p].second, column);
  }
  if (repeated_block >= 0) {  // its last row repeats a combination of the others
    const auto first = static_cast<Eigen::Index>(matrix.first_row(repeated_block));
    const Eigen::Index last = first + c.sizes[static_cast<std::size_t>(repeated_block)] - 1;
    j.row(last).setZero();
    for (Eigen::Index r = first; r < last; ++r) j.row(last) += uniform(random) * j.row(r);
  }
  return j * j.transpose();
}

class BlockCholeskyLaw : public testing::TestWithParam<int> {
 protected:
  Case test_case() const { return cases()[static_cast<std::size_t>(GetParam())]; }
};

TEST_P(BlockCholeskyLaw, SolvesAsTheDenseMatrix) {
  const Case c = test_case();
  BlockCholesky matrix;
  matrix.analyse(c.sizes, c.pairs);
  ASSERT_EQ(matrix.rows(), static_cast<std::size_t>(std::accumulate(c.sizes.begin(), c.sizes.end(), 0)));
  ASSERT_EQ(matrix.coupling_count(), c.pairs.size());
  std::mt19937 random(7);
  for (int repetition = 0; repetition < 3; ++repetition) {  // the pattern serves again and again
    Eigen::MatrixXd dense = random_matrix(c, matrix, random);
    dense.diagonal() *= 1.05;
    fill(dense, c.sizes, matrix);
    matrix.factor();
    EXPECT_TRUE(matrix.dropped().empty());
    const Eigen::VectorXd right = Eigen::VectorXd::Random(dense.rows());
    Eigen::VectorXd x = right;
    matrix.solve(x.data());
    const Eigen::VectorXd expected = dense.ldlt().solve(right);
    EXPECT_LT((x - expected).norm() / expected.norm(), 1e-11) << c.name;
  }
}

TEST_P(BlockCholeskyLaw, DropsAsManyRowsAsTheRankLacks) {
  const Case c = test_case();
  BlockCholesky matrix;
  matrix.analyse(c.sizes, c.pairs);
  std::mt19937 random(11);
  const int repeated = 4;  // mixed: size 5
  if (c.sizes[repeated] == 1) {
    Eigen::MatrixXd dense = random_matrix(c, matrix, random);
    dense.diagonal() *= 1.05;
    const auto row = static_cast<Eigen::Index>(matrix.first_row(repeated));
    dense.row(row).setZero();
    dense.col(row).setZero();
    fill(dense, c.sizes, matrix);
    matrix.factor(1e-10);
    EXPECT_EQ(matrix.dropped(), (Pairs{{repeated, 0}}));
    return;
  }
  const Eigen::MatrixXd dense = random_matrix(c, matrix, random, repeated);
  Eigen::FullPivLU<Eigen::MatrixXd> lu(dense);
  lu.setThreshold(1e-10);
  const auto lacking = static_cast<std::size_t>(dense.rows() - lu.rank());
  ASSERT_EQ(lacking, 1u);
  fill(dense, c.sizes, matrix);
  matrix.factor(1e-10);
  ASSERT_EQ(matrix.dropped().size(), lacking);
  EXPECT_EQ(matrix.dropped()[0].first, repeated);
  // A right-hand side in the range of A: the rows that are left solve it, dropped rows have the solution 0.
  const Eigen::VectorXd right = dense * Eigen::VectorXd::Random(dense.rows());
  Eigen::VectorXd x = right;
  matrix.solve(x.data());
  EXPECT_LT((dense * x - right).norm() / right.norm(), 1e-9);
  EXPECT_EQ(x[static_cast<Eigen::Index>(matrix.first_row(repeated)) + matrix.dropped()[0].second], 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, BlockCholeskyLaw, testing::Range(0, 16),
                         [](const testing::TestParamInfo<int>& p) { return cases()[static_cast<std::size_t>(p.param)].name; });

TEST(BlockCholesky, DependentBlocksOfAClosedLoop) {
  // Three blocks of three rows over six columns: rank 6 of 9, three rows must go.
  const std::vector<int> sizes(3, 3);
  const Pairs pairs{{0, 1}, {1, 2}, {2, 0}};
  BlockCholesky matrix;
  matrix.analyse(sizes, pairs);
  std::srand(3);
  const Eigen::MatrixXd j = Eigen::MatrixXd::Random(9, 6);
  const Eigen::MatrixXd dense = j * j.transpose();
  fill(dense, sizes, matrix);
  matrix.factor(1e-10);
  EXPECT_EQ(matrix.dropped().size(), 3u);
  const Eigen::VectorXd right = dense * Eigen::VectorXd::Random(9);
  Eigen::VectorXd x = right;
  matrix.solve(x.data());
  EXPECT_LT((dense * x - right).norm() / right.norm(), 1e-8);
}

}  // namespace
}  // namespace kardan::test

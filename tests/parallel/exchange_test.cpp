// What pieces put into buckets comes out complete and in the order of one loop, whoever did the pieces.
#include "kardan/parallel/exchange.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <vector>

namespace kardan {
namespace {

TEST(Pieces, CoverAllNumbersOnceAndAreAtMostSixtyFour) {
  for (const std::size_t count : {0, 1, 511, 512, 513, 32'768, 32'769, 1'000'003}) {
    const Pieces pieces(count);
    ASSERT_LE(pieces.count(), Pieces::most);
    std::size_t next = 0;
    for (std::size_t p = 0; p < pieces.count(); ++p) {
      ASSERT_EQ(pieces.begin(p), next);
      ASSERT_GT(pieces.end(p), pieces.begin(p));
      ASSERT_EQ(pieces.of(pieces.begin(p)), p);
      ASSERT_EQ(pieces.of(pieces.end(p) - 1), p);
      next = pieces.end(p);
    }
    ASSERT_EQ(next, count);
  }
}

/// Numbers of 5,000 that fall into each bucket, twice with the same exchange: what was in it before must be gone.
std::vector<std::vector<std::size_t>> exchanged(int threads) {
  const Pieces from(5'000), to(3'000);
  std::vector<std::vector<std::size_t>> out(to.count());
  Exchange<std::size_t> exchange;
  omp_set_num_threads(threads);
  for (int round = 0; round < 2; ++round) {
    exchange.start(from.count(), to.count());
    for_each_piece(from, [&](std::size_t piece, std::size_t begin, std::size_t end) {
      exchange.open(piece);
      for (std::size_t i = begin; i < end; ++i) exchange.put(piece, to.of(i * 7'919 % 3'000), i);
    });
    for_each_piece(to, [&](std::size_t bucket, std::size_t, std::size_t) {
      out[bucket].clear();
      exchange.each(bucket, [&](std::size_t i) { out[bucket].push_back(i); });
      EXPECT_EQ(out[bucket].size(), exchange.size(bucket));
    });
  }
  omp_set_num_threads(1);
  return out;
}

TEST(Exchange, GivesBackTheOrderOfOneLoopForAnyNumberOfThreads) {
  const Pieces to(3'000);
  std::vector<std::vector<std::size_t>> expected(to.count());
  for (std::size_t i = 0; i < 5'000; ++i) expected[to.of(i * 7'919 % 3'000)].push_back(i);
  for (const int threads : {1, 2, 3}) EXPECT_EQ(exchanged(threads), expected) << threads << " threads";
}

}  // namespace
}  // namespace kardan

#include "kardan/parallel/shares.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace kardan {
namespace {

TEST(Shares, EveryNumberIsMetOnceByWhomeverAndOwnOnesInOrder) {
  Shares shares;
  for (const std::size_t threads : {1u, 3u, 2u}) {
    shares.start(10, threads);
    std::vector<std::size_t> first, others;
    bool stopped = false;
    shares.run(0, [&](std::size_t i) {
      if (!stopped) first.push_back(i);
      stopped = first.size() == 3;
      if (stopped && first.size() == 3 && others.empty()) shares.run(threads - 1, [&](std::size_t k) { others.push_back(k); });
    });
    std::vector<int> met(10, 0);
    for (const std::size_t i : first) ++met[i];
    for (const std::size_t i : others) ++met[i];
    EXPECT_EQ(first, (std::vector<std::size_t>{0, 1, 2}));
    for (const int count : met) EXPECT_EQ(count, 1);
    EXPECT_EQ(others.front(), threads == 1 ? 3u : 10 * (threads - 1) / threads);  // its own share first, then what is left
  }
}

TEST(Shares, FewerNumbersThanThreads) {
  Shares shares;
  shares.start(2, 5);
  int met = 0;
  for (std::size_t t = 0; t < 5; ++t) shares.run(t, [&](std::size_t) { ++met; });
  EXPECT_EQ(met, 2);
}

TEST(Shares, CutByWeightGivesEachAboutTheSame) {
  std::vector<double> weights(100, 1.0);
  for (std::size_t i = 0; i < 10; ++i) weights[i] = 50;  // 590 in all
  EXPECT_EQ(cut_by_weight(weights, 2), (std::vector<std::size_t>{6, 100}));
  EXPECT_EQ(cut_by_weight(weights, 1), (std::vector<std::size_t>{100}));
  EXPECT_EQ(cut_by_weight({}, 3), (std::vector<std::size_t>{0, 0, 0}));
  Shares shares;
  shares.start(cut_by_weight(weights, 3));
  std::vector<int> met(100, 0);
  for (std::size_t t = 0; t < 3; ++t) shares.run(t, [&](std::size_t i) { ++met[i]; });
  for (const int count : met) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace kardan

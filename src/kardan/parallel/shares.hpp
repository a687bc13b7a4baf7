// Work shared out among threads so that each does the same part of it in every cycle, whose data its core then has or has asked for.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <numeric>
#include <vector>

#include "kardan/base/aligned.hpp"

namespace kardan {

/// The numbers 0 ... weights.size() - 1 in contiguous shares of about equal weight: their ends.
inline std::vector<std::size_t> cut_by_weight(const std::vector<double>& weights, std::size_t shares) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> ends;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {  // a number goes to the share that holds its middle
    const double middle = sum + 0.5 * weights[i];
    while (ends.size() + 1 < shares && middle * static_cast<double>(shares) > total * static_cast<double>(ends.size() + 1)) ends.push_back(i);
    sum += weights[i];
  }
  ends.resize(shares, weights.size());
  return ends;
}

/// The numbers 0 ... count - 1 in contiguous shares. A thread goes through its own in order; then it takes from the others' what they have
/// not come to, so nobody waits long where the work is uneven.
class Shares {
 public:
  /// By one thread, before the others run().
  void start(std::size_t count, std::size_t threads) {
    hold(threads);
    for (std::size_t t = 0; t < threads; ++t) {
      shares_[t].next.store(count * t / threads, std::memory_order_relaxed);
      shares_[t].end = count * (t + 1) / threads;
    }
  }
  /// Likewise with the ends of the shares, one for each thread: where the work is uneven and known to be.
  void start(const std::vector<std::size_t>& ends) {
    hold(ends.size());
    for (std::size_t t = 0; t < threads_; ++t) {
      shares_[t].next.store(t == 0 ? 0 : ends[t - 1], std::memory_order_relaxed);
      shares_[t].end = ends[t];
    }
  }
  /// By every thread: f(number) for those it gets. All numbers are met once, however many threads take part.
  template <class F>
  void run(std::size_t thread, F&& f) {
    for (std::size_t k = 0; k < threads_; ++k) {
      Share& share = shares_[(thread + k) % threads_];
      for (std::size_t i; (i = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;) f(i);
    }
  }

 private:
  struct alignas(cache_line) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  void hold(std::size_t threads) {
    if (threads != threads_) shares_ = std::make_unique<Share[]>(threads);
    threads_ = threads;
  }

  std::unique_ptr<Share[]> shares_;
  std::size_t threads_ = 0;
};

}  // namespace kardan

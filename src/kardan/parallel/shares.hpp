// Work shared out among threads so that each does the same part of it in every cycle, whose data its core then has or has asked for.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include "kardan/base/aligned.hpp"

namespace kardan {

/// The numbers 0 ... count - 1 in contiguous shares. A thread goes through its own in order; then it takes from the others' what they have
/// not come to, so nobody waits long where the work is uneven.
class Shares {
 public:
  /// By one thread, before the others run().
  void start(std::size_t count, std::size_t threads) {
    if (threads != threads_) shares_ = std::make_unique<Share[]>(threads);
    threads_ = threads;
    for (std::size_t t = 0; t < threads; ++t) {
      shares_[t].next.store(count * t / threads, std::memory_order_relaxed);
      shares_[t].end = count * (t + 1) / threads;
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
  std::unique_ptr<Share[]> shares_;
  std::size_t threads_ = 0;
};

}  // namespace kardan

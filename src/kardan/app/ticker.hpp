// Wall time for what happens now and then, without a look at the clock in every cycle.
#pragma once

#include <cstdint>

#include "kardan/base/timer.hpp"

namespace kardan::app {

class Ticker {
 public:
  explicit Ticker(double interval) : interval_(interval) {}

  /// To be called once a cycle: true about every `interval` seconds.
  bool due();

 private:
  double interval_;
  Stopwatch watch_;
  double last_seconds_ = 0;
  std::int64_t cycle_ = 0, last_cycle_ = 0, check_every_ = 1, next_check_ = 1;
};

}  // namespace kardan::app

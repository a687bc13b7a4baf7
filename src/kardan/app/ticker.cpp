#include "kardan/app/ticker.hpp"

#include <algorithm>

namespace kardan::app {

bool Ticker::due() {
  if (++cycle_ < next_check_) return false;
  const double now = watch_.seconds(), since = now - last_seconds_;
  // The clock is read some fifty times an interval, however long a cycle takes.
  check_every_ = since > 0 ? std::clamp<std::int64_t>(static_cast<std::int64_t>(static_cast<double>(cycle_ - last_cycle_) * interval_ / since / 50),
                                                      1, 100'000)
                           : 2 * check_every_;
  next_check_ = cycle_ + check_every_;
  if (since < interval_) return false;
  last_seconds_ = now;
  last_cycle_ = cycle_;
  return true;
}

}  // namespace kardan::app

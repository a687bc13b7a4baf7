#include "kardan/app/ticker.hpp"

#include <algorithm>

namespace kardan::app {

bool Ticker::due() {
  if (++cycle_ < next_check_) return false;
  const double now = watch_.seconds(), since = now - last_seconds_;
  // The clock is read some fifty times an interval, however long a cycle takes. At most twice as seldom as before: the first cycles may be quick.
  const double cycles = static_cast<double>(cycle_ - last_cycle_) * interval_ / std::max(since, 1e-9) / 50;
  check_every_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(cycles, 2.0 * static_cast<double>(check_every_))));
  next_check_ = cycle_ + check_every_;
  if (since < interval_) return false;
  last_seconds_ = now;
  last_cycle_ = cycle_;
  return true;
}

}  // namespace kardan::app

#include "kardan/base/isa.hpp"

#include <algorithm>

namespace kardan {

namespace {
int wanted_level = 0;
}

int native_level() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("x86-64-v4")) return 4;
  if (__builtin_cpu_supports("x86-64-v3")) return 3;
  if (__builtin_cpu_supports("x86-64-v2")) return 2;
#endif
  return 1;
}

int kernel_level() {
  const int highest = std::clamp(native_level(), lowest_kernel_level, highest_kernel_level);
  return wanted_level == 0 ? highest : std::clamp(wanted_level, lowest_kernel_level, highest);
}

void set_kernel_level(int level) { wanted_level = level; }

}  // namespace kardan

// What the machine itself can do, measured: the yardstick beside the figures of the kernels.
#pragma once

#include <cstddef>
#include <string>

namespace kardan::bench {

/// "model name" of /proc/cpuinfo.
std::string processor();

/// Bandwidth [bytes/ns] of the triad a = b + s c (McCalpin 1995, STREAM: three arrays, the fetch of a before it is written is not
/// counted) over arrays of `bytes` in all; the best of several passes. Run it on as many bytes as the program works on: what the
/// caches hold of them is then the same.
double triad(std::size_t bytes, int threads);

/// Flops a nanosecond of one core: multiplications and additions in equal number on vectors of the level's width (2, 3, 4: 2, 4, 8
/// doubles), never fused, because Kardan's kernels do not fuse either (docs/architecture.md, Determinism).
double peak_arithmetic(int level);

/// Memory that this process has resident, and the most it ever had [bytes].
struct Memory {
  double now = 0, peak = 0;
};
Memory memory();

}  // namespace kardan::bench

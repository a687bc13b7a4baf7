#include "machine.hpp"

#include <omp.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

#include "kardan/base/timer.hpp"
#include "options.hpp"

namespace kardan::bench {

namespace {

/// 16 chains of a <- a m + c: enough to hide the latency of both operations. The attributes let the compiler use the level's
/// registers here alone.
template <int Lanes>
[[gnu::always_inline]] inline double chains(std::size_t turns) {
  typedef double Vector __attribute__((vector_size(Lanes * sizeof(double))));
  constexpr int count = 16;
  Vector a[count];
  for (int k = 0; k < count; ++k) a[k] = Vector{} + (1.0 + 0.01 * k);
  Vector m = Vector{} + 0.999999, c = Vector{} + 1e-6;
  for (std::size_t i = 0; i < turns; ++i) {
    asm volatile("" : "+x"(m), "+x"(c));
#pragma GCC unroll 16
    for (int k = 0; k < count; ++k) a[k] = a[k] * m + c;
  }
  double total = 0, lanes[Lanes];
  for (const Vector& v : a) {
    std::memcpy(lanes, &v, sizeof lanes);
    total += lanes[0];
  }
  return total;
}

double chains_2(std::size_t turns) { return chains<2>(turns); }
#if defined(__x86_64__)
[[gnu::target("arch=x86-64-v3")]] double chains_4(std::size_t turns) { return chains<4>(turns); }
[[gnu::target("arch=x86-64-v4")]] double chains_8(std::size_t turns) { return chains<8>(turns); }
#else
double chains_4(std::size_t turns) { return chains<4>(turns); }
double chains_8(std::size_t turns) { return chains<8>(turns); }
#endif

}  // namespace

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

double triad(std::size_t bytes, int threads) {
  const auto n = static_cast<std::ptrdiff_t>(bytes / (3 * sizeof(double)));
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  const int passes = static_cast<int>(std::clamp<std::ptrdiff_t>(50'000'000 / n, 2, 1000));
  double best = 0;
  for (int sample = 0; sample < 7; ++sample) {
    const Stopwatch wall;
    const double start = thread_seconds();
    for (int pass = 0; pass < passes; ++pass) {
      const double s = 0.5 + pass;
#pragma omp parallel for simd schedule(static) num_threads(threads)
      for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    }
    const double seconds = threads == 1 ? thread_seconds() - start : wall.seconds();
    best = std::max(best, static_cast<double>(n) * 3 * sizeof(double) * passes / (1e9 * seconds));
  }
  return best;
}

double peak_arithmetic(int level) {
  double (*const run)(std::size_t) = level >= 4 ? chains_8 : (level == 3 ? chains_4 : chains_2);
  const double flops_a_turn = 16.0 * 2 * (level >= 4 ? 8 : (level == 3 ? 4 : 2));
  constexpr std::size_t turns = 4'000'000;
  double best = 0, sink = 0;
  for (int sample = 0; sample < 5; ++sample) {
    const double start = thread_seconds();
    sink += run(turns);
    best = std::max(best, flops_a_turn * turns / (1e9 * (thread_seconds() - start)));
  }
  return sink > 0 ? best : 0;
}

Memory memory() {
  Memory m;
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmRSS:")) m.now = 1024 * std::stod(line.substr(6));
    if (line.starts_with("VmHWM:")) m.peak = 1024 * std::stod(line.substr(6));
  }
  return m;
}

}  // namespace kardan::bench

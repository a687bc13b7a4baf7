#include "step_bench.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "kardan/base/isa.hpp"
#include "kardan/base/timer.hpp"
#include "kardan/solver/solver.hpp"
#include "machine.hpp"

namespace kardan::bench {

namespace {

constexpr int warm_up = 30;  ///< cycles: until every point yields, and memory and threads are there

double median(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  return samples[samples.size() / 2];
}

PiecewisePlasticMaterial steel(double yield) {
  PiecewisePlasticMaterial m;
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.points = 8;
  m.strain = {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
  for (std::size_t i = 0; i < 8; ++i) m.stress[i] = yield * (1 + 0.1 * static_cast<double>(i));
  return m;
}

}  // namespace

std::vector<std::pair<std::string, MaterialLaw>> laws() {
  return {{"MAT_001", ElasticMaterial{7.8e-6, 210, 0.3, 0, 0}}, {"MAT_024 elastic", steel(10)}, {"MAT_024 yielding", steel(0.05)}};
}

StepFigures time_step(const StepCase& c, int threads, double seconds) {
  Diagnostics diagnostics;
  Solver solver(c.model, {.threads = threads}, diagnostics);
  for (int i = 0; i < warm_up; ++i) solver.step();
  const int cycles = static_cast<int>(std::max<std::size_t>(1, 400'000 / c.elements));  // a sample: some 30 ms
  std::vector<double> samples;
  const Stopwatch all;
  while (samples.size() < 5 || all.seconds() < seconds) {
    const Stopwatch wall;
    const double start = thread_seconds();
    for (int i = 0; i < cycles; ++i) solver.step();
    const double spent = threads == 1 ? thread_seconds() - start : wall.seconds();
    samples.push_back(1e9 * spent / cycles / static_cast<double>(c.elements));
  }
  return {median(samples), *std::min_element(samples.begin(), samples.end())};
}

/// One line. The bound is the larger of the two times that the machine's arithmetic and its memory would need for the counted work.
struct StepReport::Row {
  const StepCase& c;
  int threads;
  StepFigures figures;
  double speedup, bytes_per_element, triad, bound;
};

StepReport::StepReport(const Options& options) : options_(options), peak_(peak_arithmetic(kernel_level())) {
  csv_.push_back("case,variant,isa,threads,elements,ns_per_element_cycle,ns_best,bytes_per_element,flops,bytes_moved,"
                 "peak_flops_per_ns,triad_bytes_per_ns,bound_ns,fraction_of_bound,speedup");
  if (options_.json) return;
  fmt::print("{}, kernels for x86-64-v{}, peak of unfused arithmetic {:.1f} flops/ns a core\n", processor(), kernel_level(), peak_);
  fmt::print("{:<8}{:<18}{:>8}{:>10}{:>9}{:>9}{:>10}{:>8}{:>8}{:>10}{:>10}{:>10}{:>10}\n", "case", "variant", "threads", "elements",
             "ns/el.c.", "fastest", "speed-up", "flops", "bytes", "triad B/ns", "bound ns", "fraction", "B/element");
}

StepReport::~StepReport() {
  if (options_.csv.empty()) return;
  std::ofstream file(options_.csv);
  for (const std::string& line : csv_) file << line << '\n';
}

void StepReport::add(const StepCase& c, double seconds) {
  if (fmt::format("{}, {}, {}", c.name, c.variant, c.elements).find(options_.only) == std::string::npos) return;
  const double before = memory().now;
  double one = 0;
  for (int threads = 1; threads <= std::min(options_.threads, omp_get_num_procs()); ++threads) {
    Row row{c, threads, time_step(c, threads, seconds), 1, 0, 0, 0};
    if (threads == 1) one = row.figures.best;
    row.speedup = one / row.figures.best;
    row.triad = triad(static_cast<std::size_t>(c.work.bytes * static_cast<double>(c.elements)), threads);
    row.bound = std::max(c.work.flops / (peak_ * threads), c.work.bytes / row.triad);
    row.bytes_per_element = std::max(0.0, (memory().peak - before) / static_cast<double>(c.elements));
    print(row);
  }
}

void StepReport::print(const Row& row) {
  const auto& [c, threads, figures, speedup, bytes_per_element, triad, bound] = row;
  const double fraction = bound / figures.ns;
  csv_.push_back(fmt::format("{},{},x86-64-v{},{},{},{:.1f},{:.1f},{:.0f},{:.0f},{:.0f},{:.2f},{:.2f},{:.1f},{:.3f},{:.2f}", c.name,
                             c.variant, kernel_level(), threads, c.elements, figures.ns, figures.best, bytes_per_element,
                             c.work.flops, c.work.bytes, peak_, triad, bound, fraction, speedup));
  if (options_.json) {
    fmt::print(
        "{{\"case\":\"{}\",\"variant\":\"{}\",\"isa\":\"x86-64-v{}\",\"threads\":{},\"elements\":{},"
        "\"ns_per_element_cycle\":{:.1f},\"ns_best\":{:.1f},\"bytes_per_element\":{:.0f},\"flops\":{:.0f},\"bytes_moved\":{:.0f},"
        "\"peak_flops_per_ns\":{:.2f},\"triad_bytes_per_ns\":{:.2f},\"bound_ns\":{:.1f},\"fraction_of_bound\":{:.3f},"
        "\"speedup\":{:.2f}}}\n",
        c.name, c.variant, kernel_level(), threads, c.elements, figures.ns, figures.best, bytes_per_element, c.work.flops,
        c.work.bytes, peak_, triad, bound, fraction, speedup);
  } else {
    fmt::print("{:<8}{:<18}{:>8}{:>10}{:>9.1f}{:>9.1f}{:>10.2f}{:>8.0f}{:>8.0f}{:>10.2f}{:>10.1f}{:>10.2f}{:>10.0f}\n", c.name,
               c.variant, threads, c.elements, figures.ns, figures.best, speedup, c.work.flops, c.work.bytes, triad, bound, fraction,
               bytes_per_element);
  }
  std::fflush(stdout);
}

}  // namespace kardan::bench

// Cost of contact in the whole step: a square tube of some 10,000 shells folds until its plate has gone 225 of 600 mm; then one and two threads are timed in
// the folded state, and copies of it side by side show what a segment costs in large models.
// usage: kardan_bench_tube [--json] [--quick] [--threads N]
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "kardan/base/isa.hpp"
#include "kardan/base/timer.hpp"
#include "kardan/solver/solver.hpp"
#include "machine.hpp"
#include "options.hpp"
#include "tube_model.hpp"

namespace {

using namespace kardan;

struct Figures {
  double whole = 0, contact = 0;  ///< ns per shell-cycle
};

/// Some samples of cycles: the median of the whole step (one thread: processor time) and the contact's part of it, by the solver's own timers.
Figures time_cycles(Solver& solver, std::size_t shells, int threads, int samples, int cycles) {
  omp_set_num_threads(threads);
  std::vector<Figures> all;
  for (int s = 0; s < samples; ++s) {
    const double contact = solver.timers().seconds(Phase::contact), total = solver.timers().total(), start = bench::thread_seconds();
    const Stopwatch wall;
    for (int i = 0; i < cycles; ++i) solver.step();
    const double spent = threads == 1 ? bench::thread_seconds() - start : wall.seconds();
    const double whole = 1e9 * spent / cycles / static_cast<double>(shells);
    const double share = (solver.timers().seconds(Phase::contact) - contact) / (solver.timers().total() - total);
    all.push_back({whole, share * whole});
  }
  std::sort(all.begin(), all.end(), [](const Figures& a, const Figures& b) { return a.whole < b.whole; });
  return all[all.size() / 2];
}

void print(const bench::Options& options, const char* variant, int threads, std::size_t shells, const Figures& f, double bytes) {
  if (options.json) {
    fmt::print("{{\"case\":\"tube_contact\",\"variant\":\"{}\",\"isa\":\"x86-64-v{}\",\"threads\":{},\"elements\":{},"
               "\"ns_per_element_cycle\":{:.1f},\"contact_ns\":{:.1f},\"contact_share\":{:.3f},\"bytes_per_element\":{:.0f}}}\n",
               variant, kernel_level(), threads, shells, f.whole, f.contact, f.contact / f.whole, bytes);
  } else {
    fmt::print("{:<16}{:>8}{:>10}{:>10.1f}{:>10.1f}{:>10.0f}\n", variant, threads, shells, f.whole, f.contact, bytes);
  }
  std::fflush(stdout);
}

void time_copies(const bench::Options& options, const Model& tube, const std::vector<Vec3>& x, int count) {
  const double before = bench::memory().now;
  const Model model = bench::folded_copies(tube, x, count);
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  for (int i = 0; i < 5; ++i) solver.step();
  const double bytes = (bench::memory().now - before) / static_cast<double>(model.shells.size());
  for (int threads = 1; threads <= std::min(options.threads, omp_get_num_procs()); ++threads)
    print(options, "folded copies", threads, model.shells.size(), time_cycles(solver, model.shells.size(), threads, 3, count > 10 ? 20 : 60), bytes);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options(argc, argv);
  const Model tube = bench::crush_tube(options.quick ? 13 : 26);
  const std::size_t shells = tube.shells.size();
  if (!options.json)
    fmt::print("{}\n{:<16}{:>8}{:>10}{:>10}{:>10}{:>10}\n", bench::processor(), "state", "threads", "shells", "ns/el.c.", "contact", "B/element");
  const double before = bench::memory().now;
  Diagnostics diagnostics;
  Solver solver(tube, {}, diagnostics);
  const int most = std::min(options.threads, omp_get_num_procs());
  omp_set_num_threads(most);
  while (solver.state().clock.time < 15) solver.step();  // 225 mm
  const double bytes = (bench::memory().now - before) / static_cast<double>(shells);
  for (int threads = 1; threads <= most; ++threads)
    print(options, "folded", threads, shells, time_cycles(solver, shells, threads, 5, 100), bytes);
  for (const int count : {1, 10, 100}) {
    if (options.quick && count > 10) break;
    time_copies(options, tube, solver.state().nodes.x, count);
  }
}

// Start of a large run: a plate of 1,000,000 shells (a quarter of that with --quick) read from a deck, checked, cut into tiles and
// taken through its first cycle, and the memory that it needs then and at the most.
// usage: kardan_bench_startup [--json] [--quick] [--csv FILE]
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "kardan/base/isa.hpp"
#include "kardan/base/timer.hpp"
#include "kardan/io/deck/load.hpp"
#include "kardan/solver/solver.hpp"
#include "machine.hpp"
#include "options.hpp"

namespace {

namespace fs = std::filesystem;
using namespace kardan;

/// In pieces, so that the text does not count as memory of the run.
void write_deck(const fs::path& path, int side) {
  std::ofstream file(path, std::ios::binary);
  std::string text =
      "*KEYWORD\n*CONTROL_TERMINATION\n       1.0\n*PART\nplate\n         1         1         1\n"
      "*SECTION_SHELL\n         1         2    0.8333         3\n       1.2       1.2       1.2       1.2\n"
      "*MAT_PIECEWISE_LINEAR_PLASTICITY\n         1   7.8E-06     210.0       0.3      0.25       1.0\n";
  const auto flush = [&](std::size_t limit) {
    if (text.size() <= limit) return;
    file << text;
    text.clear();
  };
  text += "*NODE\n";
  for (int j = 0; j <= side; ++j) {
    for (int i = 0; i <= side; ++i) {
      fmt::format_to(std::back_inserter(text), "{:8d}{:16.8f}{:16.8f}{:16.8f}\n", j * (side + 1) + i + 1, 2.0 * i, 2.0 * j, 0.001 * i);
      flush(1 << 16);
    }
  }
  text += "*ELEMENT_SHELL\n";
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const int n = j * (side + 1) + i + 1;
      fmt::format_to(std::back_inserter(text), "{:8d}{:8d}{:8d}{:8d}{:8d}{:8d}\n", j * side + i + 1, 1, n, n + 1, n + side + 2,
                     n + side + 1);
      flush(1 << 16);
    }
  }
  text += "*END\n";
  flush(0);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options(argc, argv);
  const int side = options.quick ? 500 : 1000, threads = 2;
  const double shells = static_cast<double>(side) * side;
  const fs::path deck = fs::temp_directory_path() / fmt::format("kardan_startup_{}.k", getpid());
  write_deck(deck, side);
  const double before = bench::memory().now;

  const Stopwatch watch;
  Diagnostics diagnostics;
  const Model model = deck::load_model(deck, {}, diagnostics);
  const double read = watch.seconds();
  fs::remove(deck);
  if (!diagnostics.ok()) return EXIT_FAILURE;
  Solver solver(model, {.threads = threads}, diagnostics);
  const double set_up = watch.seconds() - read;
  solver.step();
  const double first = watch.seconds() - read - set_up, all = watch.seconds();
  const bench::Memory memory = bench::memory();
  const double now = (memory.now - before) / shells, peak = (memory.peak - before) / shells;

  if (!options.csv.empty()) {
    std::ofstream(options.csv) << "case,isa,threads,elements,seconds_read,seconds_set_up,seconds_first_cycle,seconds,bytes_per_element,"
                                  "peak_bytes_per_element\n"
                               << fmt::format("startup,x86-64-v{},{},{:.0f},{:.3f},{:.3f},{:.3f},{:.3f},{:.0f},{:.0f}\n", kernel_level(),
                                              threads, shells, read, set_up, first, all, now, peak);
  }
  if (options.json) {
    fmt::print(
        "{{\"case\":\"startup\",\"isa\":\"x86-64-v{}\",\"threads\":{},\"elements\":{:.0f},\"seconds_read\":{:.3f},\"seconds_set_up\":{:.3f},"
        "\"seconds_first_cycle\":{:.3f},\"seconds\":{:.3f},\"ns_per_element_cycle\":{:.1f},\"bytes_per_element\":{:.0f},"
        "\"peak_bytes_per_element\":{:.0f}}}\n",
        kernel_level(), threads, shells, read, set_up, first, all, 1e9 * first / shells, now, peak);
  } else {
    fmt::print("{}\n{:.0f} shells, {} threads, wall clock: read {:.2f} s, check and cut {:.2f} s, first cycle {:.2f} s, together {:.2f} s\n"
               "memory of the process: {:.0f} bytes a shell, at the most {:.0f}\n",
               bench::processor(), shells, threads, read, set_up, first, all, now, peak);
  }
}

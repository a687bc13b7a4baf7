// The options of the benches: --json (one object a row), --quick (smaller problem, fewer repetitions); where the bench has several rows,
// --csv FILE (all of them for a spreadsheet), --threads N (at most so many; 2 otherwise) and --only TEXT (the rows in whose
// "case, variant, elements" it is, of shell and solid).
#pragma once

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

namespace kardan::bench {

struct Options {
  bool json = false, quick = false;
  std::string csv, only;
  int threads = 2;

  Options(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
      json |= std::strcmp(argv[i], "--json") == 0;
      quick |= std::strcmp(argv[i], "--quick") == 0;
      if (std::strcmp(argv[i], "--csv") == 0 && i + 1 < argc) csv = argv[++i];
      if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) only = argv[++i];
      if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) threads = std::atoi(argv[++i]);
    }
  }
};

/// Processor time of this thread: other processes on the machine do not count.
inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace kardan::bench

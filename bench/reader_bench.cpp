// Reads a shell deck of 1.2 million nodes, made in a temporary folder, in fixed columns and in free format, and prints
// MB/s. The goal (issue 1) is 150 MB/s on one core for reading and decoding every field.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "options.hpp"

#include "kardan/io/deck/deck.hpp"

namespace {

namespace fs = std::filesystem;
using kardan::Diagnostics;
using kardan::deck::Block;
using kardan::deck::Card;

struct NodeRow {
  std::int64_t id;
  double x, y, z;
};
struct ShellRow {
  std::int64_t id, part, n[4];
};

void write_deck(const fs::path& path, int columns, int rows, bool free_format) {
  std::string text = "*KEYWORD\n*NODE\n";
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int id = j * columns + i + 1;
      const double x = 1.234567 * i, y = 0.987654 * j, z = 1e-3 * ((i * 7919 + j) % 1000);
      text += free_format ? fmt::format("{},{:.9e},{:.9e},{:.9e}\n", id, x, y, z)
                          : fmt::format("{:8d}{:16.9e}{:16.9e}{:16.9e}{:8d}{:8d}\n", id, x, y, z, 0, 0);
    }
  text += "*ELEMENT_SHELL\n";
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int id = j * (columns - 1) + i + 1, n = j * columns + i + 1;
      text += free_format
                  ? fmt::format("{},{},{},{},{},{}\n", id, 1, n, n + 1, n + columns + 1, n + columns)
                  : fmt::format("{:8d}{:8d}{:8d}{:8d}{:8d}{:8d}\n", id, 1, n, n + 1, n + columns + 1, n + columns);
    }
  text += "*END\n";
  std::ofstream(path, std::ios::binary) << text;
}

/// Seconds of this thread's core, so that what else the machine does is left out.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool measure(const fs::path& path, const char* label, std::size_t expected_nodes, bool json) {
  double best_split = 1e9, best_all = 1e9;
  std::size_t bytes = 0, nodes_read = 0, shells_read = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    Diagnostics diagnostics;
    const std::clock_t start = std::clock();
    auto deck = kardan::deck::read_deck(path, {}, diagnostics);
    best_split = std::min(best_split, seconds_since(start));
    std::vector<NodeRow> nodes;
    std::vector<ShellRow> shells;
    for (Block& block : deck.blocks) {
      if (block.keyword == "NODE") {
        nodes.reserve(block.lines_left());
        block.for_each("card0", [&](const Card& c) {
          nodes.push_back({c.integer(0), c.real(1), c.real(2), c.real(3)});
        });
      } else {
        shells.reserve(block.lines_left());
        block.for_each("card0", [&](const Card& c) {
          shells.push_back({c.integer(0), c.integer(1), {c.integer(2), c.integer(3), c.integer(4), c.integer(5)}});
        });
      }
    }
    best_all = std::min(best_all, seconds_since(start));
    bytes = deck.bytes;
    nodes_read = nodes.size();
    shells_read = shells.size();
    if (!diagnostics.ok()) return false;
  }
  const double megabytes = static_cast<double>(bytes) / 1e6;
  if (json) {
    fmt::print("{{\"case\":\"reader\",\"deck\":\"{}\",\"megabytes\":{:.1f},\"nodes\":{},\"shells\":{},\"split_mb_per_s\":{:.0f},"
               "\"decoded_mb_per_s\":{:.0f}}}\n", label, megabytes, nodes_read, shells_read, megabytes / best_split,
               megabytes / best_all);
    return nodes_read == expected_nodes;
  }
  fmt::print(
      "{:14} {:8.1f} MB  {} nodes, {} shells  split {:6.0f} MB/s  split and decoded {:6.0f} MB/s  ({:.2f} s of one "
      "core)\n",
      label, megabytes, nodes_read, shells_read, megabytes / best_split, megabytes / best_all, best_all);
  return nodes_read == expected_nodes;
}

}  // namespace

int main(int argc, char** argv) {
  const kardan::bench::Options options(argc, argv);
  const bool json = options.json, quick = options.quick;
  const fs::path folder = fs::temp_directory_path() / fmt::format("kardan_reader_bench_{}", std::rand());
  fs::create_directories(folder);
  const int columns = quick ? 300 : 1200, rows = 1000;
  bool ok = true;
  for (const bool free_format : {false, true}) {
    const fs::path path = folder / "plate.k";
    write_deck(path, columns, rows, free_format);
    ok = measure(path, free_format ? "free format" : "fixed columns", static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), json) && ok;
  }
  fs::remove_all(folder);
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}

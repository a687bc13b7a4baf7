// libFuzzer target over the keyword reader and the model builder; see run.sh.
// Includes are confined to the folder of the seeds, so that no input reaches outside.
#include <cstddef>
#include <cstdint>
#include <string>

#include "consume.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kardan;
  using namespace kardan::deck;
  ReadOptions options;
  options.confine_to = KARDAN_FUZZ_SEEDS;
  options.max_include_depth = 4;
  options.max_files = 16;
  options.max_bytes = std::size_t{1} << 20;
  if (size % 2 == 0) options.without = {"contact"};
  Diagnostics diagnostics;
  std::string text(reinterpret_cast<const char*>(data), size);
  Deck deck = read_deck_text(std::move(text), "fuzz.k", KARDAN_FUZZ_SEEDS, options, diagnostics);
  test::consume(deck, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) to_string(d);
  return 0;
}

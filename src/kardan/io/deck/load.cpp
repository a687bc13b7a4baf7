#include "kardan/io/deck/load.hpp"

namespace kardan::deck {

Model load_model(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  Deck deck = read_deck(path, options.read, diagnostics);
  return build_model(deck, options.build, diagnostics);
}

}  // namespace kardan::deck

#include "kardan/io/deck/load.hpp"

namespace kardan::deck {

Model load_model(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics, std::vector<DeckFile>* files) {
  Deck deck = read_deck(path, options.read, diagnostics);
  if (files) *files = deck.files;
  return build_model(deck, options.build, diagnostics);
}

}  // namespace kardan::deck

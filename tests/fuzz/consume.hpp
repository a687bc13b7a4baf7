// Reads everything that a deck holds: what the fuzzer, the replay of its seeds and the corpus test have in common.
#pragma once

#include <cstddef>
#include <utility>

#include "kardan/io/deck/build/build.hpp"
#include "kardan/io/deck/deck.hpp"

namespace kardan::deck::test {

/// Reads every field of every line in every way, the lines going round the cards of the keyword; then builds the model.
inline std::size_t consume(Deck& deck, Diagnostics& diagnostics) {
  std::size_t fields = 0;
  for (Block& block : deck.blocks) {
    std::size_t line = 0;
    const std::vector<CardLayout>& cards = block.info->cards;
    while (!cards.empty() && !block.at_end()) {
      const Card card = block.next(cards[line++ % cards.size()].name);
      const int count = static_cast<int>(card.field_count());
      for (int i = 0; i < count; ++i) {
        if (!card.blank(i)) ++fields;
        card.integer(i);
        card.real(i, dimension::stress);
        card.text(i);
        card.id(i, IdKind::node);
        card.where(i);
      }
    }
    block.rewind();
  }
  BuildOptions options;
  options.max_curve_points = 1000;  // sampling is slow and no matter of the reader's
  build_model(deck, options, diagnostics);
  return fields;
}

}  // namespace kardan::deck::test

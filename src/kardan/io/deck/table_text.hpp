// The text of schema/keywords.tsv, put into the program when it is built (cmake/EmbedText.cmake).
#pragma once

#include <span>
#include <string_view>

namespace kardan::deck {

/// The table in pieces that end at line ends.
std::span<const std::string_view> keyword_table_text();

}  // namespace kardan::deck

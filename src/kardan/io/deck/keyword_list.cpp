#include <fmt/format.h>

#include <string>

#include "kardan/io/deck/schema.hpp"

namespace kardan::deck {

namespace {

void list(std::string& text, KeywordStatus status) {
  std::string family;
  for (const KeywordInfo& info : Schema::instance().keywords()) {
    if (info.status != status || info.name == "*") continue;
    text += fmt::format("| `*{}`", info.name);
    for (const std::string& option : info.options) text += fmt::format(" `_{}`", option);
    text += fmt::format(" | {} |\n", info.note);
  }
}

}  // namespace

std::string keyword_table_markdown() {
  std::string text =
      "# Keywords\n\n"
      "Made by `kardan keywords --markdown` from the program's own table, `src/kardan/io/deck/schema/keywords.tsv`.\n"
      "Every keyword takes `_TITLE` or `_ID` where LS-DYNA allows it; the options of its own stand behind it.\n"
      "A keyword that is in none of the three lists is an error.\n\n"
      "## Honoured\n\n| keyword | what it does |\n|---|---|\n";
  list(text, KeywordStatus::honoured);
  text += "\n## Read and not needed\n\nThe run is the same without them; each is named once in the log.\n\n| keyword | why |\n|---|---|\n";
  list(text, KeywordStatus::not_needed);
  text += "\n## Stops a run\n\nLeaving these out would change the physics, so a deck that has one is refused.\n\n| keyword | why |\n|---|---|\n";
  list(text, KeywordStatus::stops);
  return text;
}

}  // namespace kardan::deck

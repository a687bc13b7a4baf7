#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kardan/io/deck/schema.hpp"

namespace kardan::deck {

namespace {

std::string with_options(const KeywordInfo& info) {
  std::string text = fmt::format("`*{}`", info.name);
  for (const std::string& option : info.options) text += fmt::format(" `_{}`", option);
  return text;
}

/// The keywords of one status under their notes, which many of them share.
void list_by_note(std::string& text, KeywordStatus status) {
  std::vector<std::pair<std::string, std::string>> groups;
  for (const KeywordInfo& info : Schema::instance().keywords()) {
    if (info.status != status || info.name == "*") continue;
    const std::string note =
        info.note + (info.stops_if.empty() ? "" : fmt::format(" (stops only where {} is not 0)", info.stops_if));
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == note; });
    if (group == groups.end()) group = groups.insert(group, {note, ""});
    group->second += (group->second.empty() ? "" : ",\n") + with_options(info);
  }
  for (const auto& [note, names] : groups) text += fmt::format("**{}**:\n{}\n\n", note, names);
}

}  // namespace

std::string keyword_table_markdown() {
  std::string text =
      "# Keywords\n\n"
      "Made by `kardan keywords --markdown` from the program's own table, `src/kardan/io/deck/schema/keywords.tsv`.\n"
      "Every keyword takes `_TITLE` or `_ID` where LS-DYNA allows it; the options of its own stand behind it.\n"
      "A keyword that is in none of the three lists is an error.\n\n"
      "## How a deck is read\n\n"
      "* Columns of 8, 10, 16 and 20 as the manual gives them; `LONG=Y` and `I10=Y` on `*KEYWORD`; `%` (I10), `+` "
      "(long) and `-`\n"
      "  (standard) behind a keyword. A line with a comma is free format. A tab goes to the next multiple of eight "
      "columns.\n"
      "* Reals may have Fortran's exponents (`1.5-3`, `1.d5`); integers may be written as `12.`.\n"
      "* Includes are searched beside the including file, beside the main deck, then in the folders of "
      "`*INCLUDE_PATH`.\n"
      "* `&name`, `-&name` and `<expression>` stand for a whole field. Integers divide as in Fortran (2/5 is 0), "
      "angles are radians.\n"
      "  A parameter holds from its definition on. A second, different definition is ignored with a warning, which is "
      "the default\n"
      "  of `*PARAMETER_DUPLICATION`; `_LOCAL` keeps a parameter to its file and what that includes.\n"
      "* `*INCLUDE_TRANSFORM` converts units first, then applies the steps of `*DEFINE_TRANSFORMATION` in their "
      "order.\n\n"
      "## Honoured\n\n| keyword | what it does |\n|---|---|\n";
  for (const KeywordInfo& info : Schema::instance().keywords())
    if (info.status == KeywordStatus::honoured && info.name != "*")
      text += fmt::format("| {} | {} |\n", with_options(info), info.note);
  text += "\n## Read and not needed\n\nThe run is the same without them; each is named once in the log.\n\n";
  list_by_note(text, KeywordStatus::not_needed);
  text += "\n## Stops a run\n\nLeaving these out would change the physics, so a deck that has one is refused.\n\n";
  list_by_note(text, KeywordStatus::stops);
  text.pop_back();
  return text;
}

}  // namespace kardan::deck

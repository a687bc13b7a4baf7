// The project's table of LS-DYNA keywords (schema/keywords.tsv, embedded in the program): status, options, card
// layouts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kardan::deck {

/// What Kardan does with a keyword.
enum class KeywordStatus {
  honoured,    ///< its data act on the run
  not_needed,  ///< read past: output or another solver's tuning only; the physics is the same without it
  stops        ///< leaving it out would change the physics, so it stops the run
};

/// The three widths a deck may be written in: 8/10/16/20 columns; `%` or I10=Y (8-wide integers become 10); LONG=Y (all
/// 20).
enum class CardFormat : std::uint8_t { standard, i10, long_format };

/// One field of a card. Columns count from 0.
struct FieldLayout {
  std::string name;                      ///< lower case, e.g. "n1"
  char type = 'F';                       ///< 'I' integer, 'F' real, 'A' text
  int position = 0;                      ///< which comma-separated value it is in free format
  std::array<int, 3> column{}, width{};  ///< by CardFormat
  std::string default_text;              ///< empty: no default (0 or "")
  double default_real = 0;
  std::int64_t default_integer = 0;
};

/// One card (data line) of a keyword.
struct CardLayout {
  std::string name;  ///< "card0", "id", "local", …
  std::vector<FieldLayout> fields;
  int index_of(std::string_view field) const;  ///< -1 where there is none
};

/// One row of the table.
struct KeywordInfo {
  std::string name;  ///< without the asterisk, upper case
  KeywordStatus status = KeywordStatus::stops;
  std::vector<std::string> options;  ///< suffixes beyond TITLE and ID that it takes, e.g. LOCAL, FAILURE
  std::string stops_if;              ///< it stops a run only where this field of card0 is not zero; empty: always
  std::string note;  ///< one line: what it does here, or what leaving it out would change and what to do
  /// Its own card of this name, else that of its family (CONTACT_*) or of all keywords (*); asserts that there is one.
  const CardLayout& card(std::string_view card_name) const;
  const CardLayout* find_card(std::string_view card_name) const;  ///< nullptr where it is not
  std::vector<CardLayout> cards;
};

/// A keyword line taken apart.
struct KeywordMatch {
  const KeywordInfo* info = nullptr;  ///< nullptr: unknown
  std::vector<std::string> options;   ///< e.g. {"ID", "LOCAL"}
  std::string bad_option;             ///< an option that the keyword does not take; empty if all is well
};

/// The whole table; parsed once, on first use, thread-safe.
class Schema {
 public:
  static const Schema& instance();

  /// Splits e.g. "CONSTRAINED_JOINT_REVOLUTE_ID_LOCAL" (upper case, no asterisk) into keyword and options.
  KeywordMatch match(std::string_view name) const;
  const KeywordInfo* find(std::string_view name) const;
  /// The known keyword nearest to a misspelt one; empty if none is near.
  std::string nearest(std::string_view name) const;
  const std::vector<KeywordInfo>& keywords() const { return keywords_; }

 private:
  Schema();
  void add_keyword(std::string_view line);
  std::vector<KeywordInfo> keywords_;
  std::map<std::string, std::size_t, std::less<>> by_name_;  // names and aliases -> row
  struct Guess {
    std::string_view name;     // of by_name_
    std::uint64_t characters;  // those that occur in it
    std::size_t row;
  };
  std::vector<Guess> guesses_;  // what a misspelt name is compared with, in the order of the names
};

/// docs/keywords.md: the honoured keywords, those read and not needed, those that stop a run.
std::string keyword_table_markdown();

}  // namespace kardan::deck

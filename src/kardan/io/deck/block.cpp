#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "kardan/io/deck/deck.hpp"
#include "kardan/io/deck/source.hpp"

namespace kardan::deck {

namespace {

// Tabs stand for blanks up to the next multiple of eight columns, as terminals and editors show them.
std::string expand_tabs(std::string_view line) {
  std::string expanded;
  for (const char c : line)
    if (c == '\t')
      expanded.append(8 - expanded.size() % 8, ' ');
    else
      expanded += c;
  return expanded;
}

// A line is in free format if a comma stands in it outside of <expressions>.
bool has_separating_comma(std::string_view line) {
  int brackets = 0;
  for (const char c : line) {
    if (c == '<') ++brackets;
    if (c == '>' && brackets > 0) --brackets;
    if (c == ',' && brackets == 0) return true;
  }
  return false;
}

// A heading in fixed columns may hold a comma: such a line is free format only if its first value ends at a comma.
bool comma_is_of_heading(const CardLayout& layout, std::string_view line) {
  const FieldLayout& last = layout.fields.back();
  if (layout.fields.size() < 2 || last.type != 'A' || last.width[0] < 60) return false;
  const std::string_view first = trimmed(line.substr(0, line.find(',')));
  return !first.empty() && first[0] != '&' && parse_integer(first).state == NumberState::malformed;
}

}  // namespace

// The next line that is no comment, from `cursor` on; `next_number` is the line number at the cursor.
bool Block::scan(std::size_t& cursor, int& next_number, std::string_view& line, int& number) const {
  while (cursor < text_.size()) {
    const char* begin = text_.data() + cursor;
    const std::size_t rest = text_.size() - cursor;
    const void* newline = std::memchr(begin, '\n', rest);
    const std::size_t length =
        newline == nullptr ? rest : static_cast<std::size_t>(static_cast<const char*>(newline) - begin);
    cursor += length + 1;
    number = next_number++;
    if (*begin == '$') continue;
    line = {begin, length};
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
  }
  cursor = text_.size();
  return false;
}

bool Block::take_line(std::string_view& line, int& number) {
  return scan(cursor_, cursor_line_, line, number);
}

void Block::open(Card& card, std::string_view line, int number) const {
  card.line_ = line;
  card.line_number_ = number;
  card.present_ = true;
  card.free_ = has_commas_ && has_separating_comma(line) && !comma_is_of_heading(*card.layout_, line);
  card.free_position_ = 0;
  card.free_start_ = 0;
  if (!has_tabs_) return;
  card.expanded_.clear();
  if (!card.free_ && line.find('\t') != std::string_view::npos) card.expanded_ = expand_tabs(line);
}

Card Block::absent(std::string_view card_name) const {
  Card card;
  card.block_ = this;
  card.layout_ = &info->card(card_name);
  card.format_ = format_;
  card.has_references_ = has_references_;
  return card;
}

bool Block::advance(Card& card) {
  std::string_view line;
  int number = 0;
  while (take_line(line, number)) {
    if (trimmed(line).empty()) continue;
    open(card, line, number);
    return true;
  }
  return false;
}

bool Block::at_end() const {
  std::size_t cursor = cursor_;
  int next_number = cursor_line_, number = 0;
  std::string_view line;
  while (scan(cursor, next_number, line, number))
    if (!trimmed(line).empty()) return false;
  return true;
}

std::size_t Block::lines_left() const {
  std::size_t cursor = cursor_, count = 0;
  int next_number = cursor_line_, number = 0;
  std::string_view line;
  while (scan(cursor, next_number, line, number)) ++count;
  return count;
}

Card Block::next_optional(std::string_view card_name) {
  Card card = absent(card_name);
  std::string_view line;
  int number = 0;
  if (take_line(line, number)) open(card, line, number);
  return card;
}

Card Block::next(std::string_view card_name) {
  Card card = next_optional(card_name);
  if (!card.present()) {
    std::string fields;
    for (const FieldLayout& f : card.layout_->fields) fields += (fields.empty() ? "" : " ") + f.name;
    error(fmt::format("the card with {} is missing", fields), "a card of defaults is a blank line");
  }
  return card;
}

Card Block::next(const CardLayout& layout) {
  Card card = absent("title");
  card.layout_ = &layout;
  std::string_view line;
  int number = 0;
  if (take_line(line, number)) open(card, line, number);
  return card;
}

Card Block::peek(std::string_view card_name) const {
  Card card = absent(card_name);
  std::size_t cursor = cursor_;
  int next_number = cursor_line_, number = 0;
  std::string_view line;
  if (scan(cursor, next_number, line, number)) open(card, line, number);
  return card;
}

std::string Block::next_title() {
  std::string_view line;
  int number = 0;
  return take_line(line, number) ? std::string(trimmed(line)) : std::string();
}

void Block::error(std::string message, std::string cure) const {
  diagnostics_->error(std::move(message), std::move(cure), as_written_, where);
}

void Block::warning(std::string message, std::string cure) const {
  diagnostics_->warning(std::move(message), std::move(cure), as_written_, where);
}

}  // namespace kardan::deck

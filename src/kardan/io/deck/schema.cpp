#include "kardan/io/deck/schema.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <utility>

#include "kardan/base/diagnostics.hpp"
#include "kardan/io/deck/number.hpp"
#include "kardan/io/deck/table_text.hpp"

namespace kardan::deck {

namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

int to_int(std::string_view digits) {
  return static_cast<int>(parse_integer(digits).value);
}

// "name:TypeColumn+Width[=default]"
FieldLayout parse_field(std::string_view text) {
  FieldLayout field;
  const std::size_t colon = text.find(':'), plus = text.find('+', colon), equals = text.find('=', colon);
  KARDAN_ASSERT(colon != std::string_view::npos && plus != std::string_view::npos);
  field.name = text.substr(0, colon);
  field.type = text[colon + 1];
  KARDAN_ASSERT(field.type == 'I' || field.type == 'F' || field.type == 'A');
  field.column[0] = to_int(text.substr(colon + 2, plus - colon - 2));
  field.width[0] = to_int(text.substr(plus + 1, std::min(equals, text.size()) - plus - 1));
  if (equals == std::string_view::npos) return field;
  field.default_text = text.substr(equals + 1);
  if (field.type != 'A') field.default_real = parse_real(field.default_text).value;
  if (field.type == 'I') field.default_integer = parse_integer(field.default_text).value;
  return field;
}

// Columns of the two wider formats and places in free format follow from the standard columns: I10 widens every field
// narrower than 10 columns to 10; LONG gives every number 20. A gap counts as fields of the width of its neighbour.
void add_wider_formats(CardLayout& card) {
  int end = 0, shift_i10 = 0, end_long = 0, position = 0;
  for (FieldLayout& field : card.fields) {
    const int column = field.column[0], width = field.width[0];
    if (column > end) {
      const int unit = std::min(width, 10), skipped = (column - end + unit - 1) / unit;
      position += skipped;
      end_long += 20 * skipped;
      if (unit < 10) shift_i10 += skipped * (10 - unit);
    }
    const bool whole_line = field.type == 'A' && width > 20;
    field.position = position++;
    field.column[1] = column + shift_i10;
    field.width[1] = std::max(width, 10);
    field.column[2] = end_long;
    field.width[2] = whole_line ? width : 20;
    shift_i10 += field.width[1] - width;
    end_long += field.width[2];
    end = column + width;
  }
}

CardLayout parse_card(std::string_view line) {
  const auto columns = split(line, '\t');
  KARDAN_ASSERT(columns.size() >= 3);
  CardLayout card;
  card.name = columns[1];
  for (const std::string_view text : split(columns[2], ' '))
    if (!text.empty()) card.fields.push_back(parse_field(text));
  add_wider_formats(card);
  return card;
}

KeywordStatus to_status(std::string_view text) {
  if (text == "honoured") return KeywordStatus::honoured;
  if (text == "not_needed") return KeywordStatus::not_needed;
  KARDAN_ASSERT(text == "stops");
  return KeywordStatus::stops;
}

/// One bit for each character that occurs (letters, digits and the underscore differ in their lowest six bits).
std::uint64_t characters_of(std::string_view name) {
  std::uint64_t bits = 0;
  for (const char c : name) bits |= std::uint64_t{1} << (static_cast<unsigned char>(c) & 63u);
  return bits;
}

/// Not more than Levenshtein's distance: an edit brings in at most one character and takes out at most one.
std::size_t least_edits(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::size_t>(std::max(std::popcount(a & ~b), std::popcount(b & ~a)));
}

/// Levenshtein's distance, given up beyond `limit`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t difference = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (difference > limit) return limit + 1;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i), least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
      least = std::min(least, row[j]);
    }
    if (least > limit) return limit + 1;
  }
  return row[b.size()];
}

}  // namespace

int CardLayout::index_of(std::string_view field) const {
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == field) return static_cast<int>(i);
  return -1;
}

const CardLayout* KeywordInfo::find_card(std::string_view card_name) const {
  for (const CardLayout& c : cards)
    if (c.name == card_name) return &c;
  return nullptr;
}

const CardLayout& KeywordInfo::card(std::string_view card_name) const {
  if (const CardLayout* own = find_card(card_name)) return *own;
  const CardLayout* shared = nullptr;
  for (const std::string& row : {name.substr(0, name.find('_') + 1) + "*", std::string("*")}) {
    const KeywordInfo* common = Schema::instance().find(row);
    if (common != nullptr && shared == nullptr) shared = common->find_card(card_name);
  }
  KARDAN_ASSERT(shared != nullptr);
  return *shared;
}

Schema::Schema() {
  for (const std::string_view chunk : keyword_table_text())
    for (const std::string_view line : split(chunk, '\n')) {
      if (line.empty() || line[0] == '#') continue;
      if (line[0] == '\t')
        keywords_.back().cards.push_back(parse_card(line));
      else
        add_keyword(line);
    }
  for (const auto& [name, row] : by_name_) guesses_.push_back({name, characters_of(name), row});
}

void Schema::add_keyword(std::string_view line) {
  const auto columns = split(line, '\t');
  KARDAN_ASSERT(columns.size() >= 4);
  KeywordInfo info;
  const auto names = split(columns[0], '=');
  info.name = names[0];
  std::string_view status = columns[1];
  if (constexpr std::string_view conditional = "stops_if:"; status.starts_with(conditional)) {
    info.stops_if = status.substr(conditional.size());
    status = "stops";
  }
  info.status = to_status(status);
  for (const std::string_view option : split(columns[2], ' '))
    if (!option.empty()) info.options.emplace_back(option);
  info.note = columns[3];
  for (const std::string_view name : names) by_name_.emplace(name, keywords_.size());
  keywords_.push_back(std::move(info));
}

const Schema& Schema::instance() {
  static const Schema schema;
  return schema;
}

const KeywordInfo* Schema::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &keywords_[found->second];
}

KeywordMatch Schema::match(std::string_view name) const {
  KeywordMatch match;
  // The longest known name that ends at an underscore or at the end; what follows are options.
  std::size_t end = name.size();
  while (end > 0 && (match.info = find(name.substr(0, end))) == nullptr) {
    end = name.rfind('_', end - 1);
    if (end == std::string_view::npos) end = 0;
  }
  if (match.info == nullptr || name == "*") {
    match.info = nullptr;
    // A whole family, e.g. AIRBAG_*.
    for (end = name.rfind('_'); end != std::string_view::npos && end > 0 && match.info == nullptr;
         end = name.rfind('_', end - 1))
      match.info = find(std::string(name.substr(0, end + 1)) + "*");
    return match;
  }
  std::string_view rest = name.substr(end);
  while (!rest.empty()) {
    rest.remove_prefix(1);  // the underscore
    std::string_view best;
    const auto offer = [&](std::string_view option) {
      const bool fits = rest.starts_with(option) && (rest.size() == option.size() || rest[option.size()] == '_');
      if (fits && option.size() > best.size()) best = option;
    };
    for (const std::string& option : match.info->options) offer(option);
    offer("TITLE");
    offer("ID");
    if (best.empty()) {
      match.bad_option = rest;
      return match;
    }
    match.options.emplace_back(best);
    rest.remove_prefix(best.size());
  }
  return match;
}

std::string Schema::nearest(std::string_view name) const {
  const std::size_t limit = std::min<std::size_t>(3, name.size() / 4);
  std::size_t best = limit + 1;
  std::string found;
  const std::uint64_t characters = characters_of(name);
  for (const auto& [known, known_characters, row] : guesses_) {
    if (least_edits(characters, known_characters) > std::min(limit, best)) continue;
    const std::size_t distance = edit_distance(name, known, std::min(limit, best));
    // Of equally near ones, one that works is the better guess.
    if (distance < best || (distance == best && best <= limit && keywords_[row].status == KeywordStatus::honoured)) {
      best = distance;
      found = known;
    }
  }
  return found;
}

}  // namespace kardan::deck

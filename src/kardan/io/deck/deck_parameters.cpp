// *PARAMETER and *PARAMETER_EXPRESSION.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "kardan/io/deck/deck_reader.hpp"

namespace kardan::deck {

namespace {

bool is_name(std::string_view text) {
  if (text.empty() || !(std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '_')) return false;
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// "Rterm", "r term" -> 'r' and "term"; '\0' if it is no such thing.
char split_typed_name(std::string_view text, std::string_view& name) {
  if (text.empty()) return '\0';
  const char type = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  name = trimmed(text.substr(1));
  return (type == 'r' || type == 'i' || type == 'c') && is_name(name) ? type : '\0';
}

}  // namespace

void DeckReader::read_parameters(FileState& state, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    for (int i = 0; i < 8; i += 2) {
      int column = 0, value_column = 0;
      const std::string_view name = card.field_text(i, column);
      const std::string_view value =
          card.free_ ? card.free_field(i + 1, false, value_column) : card.field_text(i + 1, value_column);
      if (name.empty() && value.empty()) continue;
      define(state, card, column > 0 ? column : value_column, name, value, value_column, false);
    }
  });
}

void DeckReader::read_parameter_expressions(FileState& state, Block& block) {
  // An expression may go on in lines whose first ten columns are blank, so each is defined when the next one begins.
  std::string pending_name, pending_value;
  Card pending;
  int name_column = 0, value_column = 0;
  const auto finish = [&] {
    if (pending.present()) define(state, pending, name_column, pending_name, pending_value, value_column, true);
    pending = Card();
  };
  block.for_each("expression", [&](const Card& card) {
    const std::string_view line = card.expanded_.empty() ? card.line_ : std::string_view(card.expanded_);
    const std::size_t comma = line.find(',');
    std::string_view unused;
    const bool is_free =
        comma != std::string_view::npos && split_typed_name(trimmed(line.substr(0, comma)), unused) != '\0';
    const std::size_t split =
        is_free ? comma + 1 : std::min<std::size_t>(card.format_ == CardFormat::long_format ? 20 : 10, line.size());
    const std::string_view name = trimmed(line.substr(0, is_free ? comma : split)), value = trimmed(line.substr(split));
    if (name.empty() && pending.present()) {
      if (pending_value.size() < 8192) pending_value += std::string(value);
      return;
    }
    finish();
    pending = card;
    pending_name = name;
    pending_value = value;
    name_column = name.empty() ? 1 : static_cast<int>(name.data() - line.data()) + 1;
    value_column = value.empty() ? name_column : static_cast<int>(value.data() - line.data()) + 1;
  });
  finish();
}

void DeckReader::define(const FileState& state, const Card& card, int column, std::string_view typed_name,
                        std::string_view value_text, int value_column, bool is_expression) {
  std::string_view name;
  const char type = split_typed_name(typed_name, name);
  if (type == '\0') {
    card.report(Severity::error, "PRMR", column,
                fmt::format("found '{}', expected R, I or C followed by the name of the parameter", typed_name),
                "the first letter is the type: real, integer or character");
    return;
  }
  const std::string key = lower(name);
  if (value_text.empty()) {
    card.report(Severity::error, "VAL", column, fmt::format("parameter '{}' has no value", name), {});
    return;
  }
  const bool local = card.block_->has("LOCAL");
  if (type == 'c') return store(state, card, key, std::string(value_text), local, column);

  // Definitions in one block see those before them, hence the moment of now.
  const ParameterView view{parameters_, parameters_->now(), state.scope};
  ParameterValue value;
  const bool reference = value_text.find_first_of("&<") != std::string_view::npos;
  const RealResult plain = parse_real(value_text);
  if (!is_expression && !reference) {
    const IntegerResult integer = parse_integer(value_text);
    if (plain.state != NumberState::ok) {
      card.report(Severity::error, "VAL", value_column,
                  fmt::format("found '{}', expected {} for parameter '{}'", value_text,
                              type == 'i' ? "an integer" : "a real number", name),
                  "*PARAMETER_EXPRESSION computes");
      return;
    }
    value =
        type == 'i' && integer.state == NumberState::ok ? ParameterValue(integer.value) : ParameterValue(plain.value);
  } else {
    std::string_view expression = value_text;
    if (expression.starts_with('<') && expression.ends_with('>') && expression.size() > 1)
      expression = expression.substr(1, expression.size() - 2);
    ExpressionResult result = evaluate_expression(expression, view);
    if (!result.value) {
      card.report(Severity::error, "EXPRESSION", value_column + static_cast<int>(result.offset),
                  fmt::format("parameter '{}': {}", name, result.problem), {});
      return;
    }
    value = *result.value;
  }
  // The type of the parameter decides: an integer parameter is cut to an integer as Fortran does.
  if (type == 'r') {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) value = static_cast<double>(*integer);
  } else if (const auto* real = std::get_if<double>(&value)) {
    if (!(std::abs(*real) < 9e18)) {
      card.report(Severity::error, "VAL", value_column,
                  fmt::format("{} is too large for the integer parameter '{}'", value_text, name), {});
      return;
    }
    value = static_cast<std::int64_t>(*real);
  }
  store(state, card, key, std::move(value), local, column);
}

// A second definition follows *PARAMETER_DUPLICATION DFLAG: 1 (default) keeps the first with a warning, 2 takes the new
// one with a warning, 3 is an error, 4 takes the new one, 5 keeps the first.
void DeckReader::store(const FileState& state, const Card& card, const std::string& name, ParameterValue value,
                       bool local, int column) {
  const Parameters::Definition* first = parameters_->existing(name, local, state.scope);
  const bool is_mutable = card.block_->has("MUTABLE");
  if (first != nullptr && !is_mutable && first->value != value) {
    const bool keep = duplication_ == 1 || duplication_ == 3 || duplication_ == 5;
    if (duplication_ <= 3)
      card.report(
          duplication_ == 3 ? Severity::error : Severity::warning, "PRMR", column,
          fmt::format("parameter '{}' is defined again as {}; {} ({}:{}) {}", name, to_string(value),
                      to_string(first->value), first->where.file, first->where.line, keep ? "stays" : "is replaced"),
          "*PARAMETER_DUPLICATION decides, *PARAMETER_LOCAL keeps a parameter to its file");
    if (keep) return;
  }
  SourceLocation where = card.where();
  where.column = column;
  parameters_->define(name, std::move(value), local, state.scope, std::move(where));
}

}  // namespace kardan::deck

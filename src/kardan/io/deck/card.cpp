#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kardan/io/deck/deck.hpp"
#include "kardan/io/deck/source.hpp"

namespace kardan::deck {

namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

bool refers(std::string_view text) {
  return text.find_first_of("&<") != std::string_view::npos;
}

/// The comma that ends the value at `start`, or the end of the line.
std::size_t end_of_value(std::string_view line, std::size_t start) {
  int brackets = 0;
  for (std::size_t i = start; i < line.size(); ++i) {
    if (line[i] == '<') ++brackets;
    if (line[i] == '>' && brackets > 0) --brackets;
    if (line[i] == ',' && brackets == 0) return i;
  }
  return line.size();
}

/// What a user sees of a field in a message: short, printable.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 60)) result += static_cast<unsigned char>(c) < 32 ? '?' : c;
  return result + (text.size() > 60 ? "…'" : "'");
}

}  // namespace

int Card::index_of(std::string_view field) const {
  const int index = layout_->index_of(field);
  KARDAN_ASSERT(index >= 0);
  return index;
}

// The text of a field without the blanks around it; `column` becomes that of its first character, from 1.
std::string_view Card::field_text(int field, int& column) const {
  column = 0;
  if (!present_) return {};
  const FieldLayout& f = layout_->fields[static_cast<std::size_t>(field)];
  const bool to_end = f.type == 'A' && static_cast<std::size_t>(field) + 1 == layout_->fields.size();
  if (free_) return free_field(f.position, to_end, column);
  const std::string_view line = expanded_.empty() ? line_ : std::string_view(expanded_);
  const auto format = static_cast<std::size_t>(format_);
  const auto first = static_cast<std::size_t>(f.column[format]);
  if (first >= line.size()) return {};
  const std::string_view raw = line.substr(first, static_cast<std::size_t>(f.width[format]));
  const std::string_view text = trimmed(raw);
  if (!text.empty()) column = static_cast<int>(text.data() - line.data()) + 1;
  return text;
}

// Value number `position` of a comma-separated line; commas within <…> do not separate. Fields are mostly read from
// left to right, so the place of the last one found is kept.
std::string_view Card::free_field(int position, bool to_end, int& column) const {
  if (position < free_position_) {
    free_position_ = 0;
    free_start_ = 0;
  }
  std::size_t end = 0;
  for (;; ++free_position_, free_start_ = end + 1) {
    if (free_start_ > line_.size()) return {};
    end = has_references_ ? end_of_value(line_, free_start_) : std::min(line_.find(',', free_start_), line_.size());
    if (free_position_ == position) break;
  }
  const std::string_view text =
      trimmed(to_end ? line_.substr(free_start_) : line_.substr(free_start_, end - free_start_));
  if (!text.empty()) column = static_cast<int>(text.data() - line_.data()) + 1;
  return text;
}

bool Card::blank(int field) const {
  int column = 0;
  return field_text(field, column).empty();
}

bool Card::all_blank() const {
  return !present_ || trimmed(line_).empty();
}

std::optional<ParameterValue> Card::evaluated(std::string_view text, const FieldLayout& field, int column) const {
  std::string_view body = text;
  bool minus = false;
  if (body.size() > 1 && (body[0] == '-' || body[0] == '+')) {
    minus = body[0] == '-';
    body = trimmed(body.substr(1));
  }
  std::string_view expression;
  if (body.starts_with('&')) {
    expression = body;
    if (body.find_first_of(" \t+-*/()<>", 1) != std::string_view::npos || body.size() == 1) {
      report(Severity::error, upper(field.name), column,
             fmt::format("found {}, expected &name and nothing else", in_quotes(text)),
             "write <expression> to compute with parameters");
      return std::nullopt;
    }
  } else if (body.starts_with('<')) {
    if (!body.ends_with('>')) {
      report(Severity::error, upper(field.name), column,
             fmt::format("the expression {} does not end with '>' in its field", in_quotes(text)),
             "a field has its width: write a long expression in free format, with commas");
      return std::nullopt;
    }
    expression = body.substr(1, body.size() - 2);
  } else {
    report(Severity::error, upper(field.name), column,
           fmt::format("found {}, expected a number or &name at the start of the field", in_quotes(text)),
           "check the columns of this line");
    return std::nullopt;
  }
  // A parameter alone may be a text; everything else is a number.
  if (body.starts_with('&')) {
    const ParameterValue* value = block_->parameters_.find(body.substr(1));
    if (value != nullptr && std::holds_alternative<std::string>(*value)) {
      const std::string& content = std::get<std::string>(*value);
      const std::string_view number = trimmed(content);
      const RealResult real = number.empty() ? RealResult{0, NumberState::malformed} : parse_real(number);
      if (field.type == 'A') return *value;
      if (real.state == NumberState::ok) return ParameterValue(minus ? -real.value : real.value);
      report(Severity::error, upper(field.name), column,
             fmt::format("parameter {} is the text {}, expected a number", in_quotes(body), in_quotes(content)), {});
      return std::nullopt;
    }
  }
  const ExpressionResult result = evaluate_expression(expression, block_->parameters_);
  if (!result.value) {
    const int offset = static_cast<int>(expression.data() - text.data() + static_cast<std::ptrdiff_t>(result.offset));
    report(
        Severity::error, upper(field.name), column + offset, fmt::format("{}: {}", in_quotes(text), result.problem),
        result.problem.find("not defined") != std::string::npos ? "define it with *PARAMETER before it is used" : "");
    return std::nullopt;
  }
  ParameterValue value = *result.value;
  if (minus) {
    if (auto* integer = std::get_if<std::int64_t>(&value)) *integer = *integer == INT64_MIN ? INT64_MAX : -*integer;
    if (auto* real = std::get_if<double>(&value)) *real = -*real;
  }
  return value;
}

namespace {

/// What shifted columns leave of a number where there is no doubt about its value: several zeros, or an exponent cut off before its digits.
std::optional<double> unambiguous_slip(std::string_view text) {
  if (text.find_first_of("123456789") == std::string_view::npos && text.find(' ') != std::string_view::npos) {
    for (std::string_view rest = text; !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      if (end > 0 && parse_real(rest.substr(0, end)).state != NumberState::ok) return std::nullopt;
      rest = trimmed(rest.substr(end));
    }
    return 0.0;
  }
  if (text.find_last_of("eEdD") != text.size() - 1 || text.size() < 2) return std::nullopt;
  const RealResult mantissa = parse_real(text.substr(0, text.size() - 1));
  return mantissa.state == NumberState::ok ? std::optional(mantissa.value) : std::nullopt;
}

}  // namespace

void Card::malformed(const FieldLayout& field, int column, std::string_view found, NumberState state) const {
  const char* expected = field.type == 'I' ? "an integer" : "a real number";
  if (state == NumberState::too_large)
    report(Severity::error, upper(field.name), column,
           fmt::format("{} is too large for {}", in_quotes(found), expected), {});
  else
    report(Severity::error, upper(field.name), column, fmt::format("found {}, expected {}", in_quotes(found), expected),
           found.find(' ') != std::string_view::npos ? "check the columns of this line" : "");
}

std::int64_t Card::integer(int field) const {
  const FieldLayout& f = layout_->fields[static_cast<std::size_t>(field)];
  int column = 0;
  const std::string_view text = field_text(field, column);
  if (text.empty()) return f.default_integer;
  if (has_references_ && refers(text)) {
    const auto value = evaluated(text, f, column);
    if (!value) return f.default_integer;
    if (const auto* integer = std::get_if<std::int64_t>(&*value)) return *integer;
    const double* real = std::get_if<double>(&*value);
    if (real != nullptr && std::floor(*real) == *real && std::abs(*real) <= 9e15)
      return static_cast<std::int64_t>(*real);
    report(Severity::error, upper(f.name), column,
           fmt::format("found {} = {}, expected an integer", in_quotes(text), to_string(*value)), {});
    return f.default_integer;
  }
  const IntegerResult result = parse_integer(text);
  if (result.state == NumberState::ok) return result.value;
  malformed(f, column, text, result.state);
  return f.default_integer;
}

double Card::real(int field) const {
  const FieldLayout& f = layout_->fields[static_cast<std::size_t>(field)];
  int column = 0;
  const std::string_view text = field_text(field, column);
  if (text.empty()) return f.default_real;
  if (has_references_ && refers(text)) {
    const auto value = evaluated(text, f, column);
    if (!value) return f.default_real;
    if (const auto* integer = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*integer);
    if (const auto* real = std::get_if<double>(&*value)) return *real;
    malformed(f, column, text, NumberState::malformed);
    return f.default_real;
  }
  const RealResult result = parse_real(text);
  if (result.state == NumberState::ok) return result.value;
  if (const std::optional<double> meant = free_ ? std::nullopt : unambiguous_slip(text)) {
    report(Severity::warning, upper(f.name), column, fmt::format("found {}, taken as {:g}", in_quotes(text), *meant), "check the columns of this line");
    return *meant;
  }
  malformed(f, column, text, result.state);
  return f.default_real;
}

double Card::real(int field, Dimension d) const {
  const double value = real(field);
  return block_->context_->trivial ? value : value * block_->context_->factor(d);
}

std::string Card::text(int field) const {
  const FieldLayout& f = layout_->fields[static_cast<std::size_t>(field)];
  int column = 0;
  const std::string_view text = field_text(field, column);
  if (text.empty()) return f.default_text;
  if (has_references_ && text.starts_with('&') && text.size() > 1)
    if (const ParameterValue* value = block_->parameters_.find(text.substr(1)))
      return std::string(trimmed(to_string(*value)));
  return std::string(text);
}

std::int64_t Card::id(int field, IdKind kind) const {
  const std::int64_t value = integer(field);
  if (value == 0 || block_->context_->trivial) return value;
  const std::int64_t offset = block_->context_->offset[static_cast<std::size_t>(kind)];
  std::int64_t shifted = 0;
  if (!__builtin_add_overflow(value, value < 0 ? -offset : offset, &shifted)) return shifted;
  int column = 0;
  const std::string_view found = field_text(field, column);
  malformed(layout_->fields[static_cast<std::size_t>(field)], column, found, NumberState::too_large);
  return 0;
}

Vec3 Card::direction(std::string_view first_field, Dimension d) const {
  const int i = index_of(first_field);
  return block_->context_->affine.direction({real(i, d), real(i + 1, d), real(i + 2, d)});
}

Vec3 Card::point(std::string_view first_field) const {
  const int i = index_of(first_field);
  return block_->context_->affine.point(
      {real(i, dimension::length), real(i + 1, dimension::length), real(i + 2, dimension::length)});
}

SourceLocation Card::where() const {
  if (!present_) return block_->where;
  return {block_->where.file, line_number_, 0};
}

SourceLocation Card::where(int field) const {
  SourceLocation location = where();
  if (present_) field_text(field, location.column);
  return location;
}

void Card::error(std::string_view field, std::string message, std::string cure) const {
  report(Severity::error, upper(field), where(field).column, std::move(message), std::move(cure));
}

void Card::error_on_card(std::string message, std::string cure) const {
  report(Severity::error, {}, 0, std::move(message), std::move(cure));
}

void Card::warning(std::string_view field, std::string message, std::string cure) const {
  report(Severity::warning, upper(field), where(field).column, std::move(message), std::move(cure));
}

void Card::report(Severity severity, std::string field, int column, std::string message, std::string cure) const {
  SourceLocation location = where();
  location.column = column;
  Diagnostics& diagnostics = block_->diagnostics();
  // A field that is read twice is reported once.
  if (!diagnostics.all().empty()) {
    const Diagnostic& last = diagnostics.all().back();
    if (last.where.line == location.line && last.where.column == column && last.where.file == location.file &&
        last.message == message)
      return;
  }
  diagnostics.add(
      {severity, std::move(location), block_->as_written(), std::move(field), std::move(message), std::move(cure)});
}

double IncludeContext::factor(Dimension d) const {
  return std::pow(mass, d.mass) * std::pow(length, d.length) * std::pow(time, d.time);
}

}  // namespace kardan::deck

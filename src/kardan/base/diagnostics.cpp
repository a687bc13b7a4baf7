#include "kardan/base/diagnostics.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace kardan {

namespace {

std::string summary(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) return to_string(d);
  return "bad input";
}

}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string text;
  if (!d.where.file.empty()) {
    text += d.where.file;
    if (d.where.line > 0) text += fmt::format(":{}", d.where.line);
    if (d.where.line > 0 && d.where.column > 0) text += fmt::format(":{}", d.where.column);
    text += ": ";
  }
  text += d.severity == Severity::error ? "error: " : d.severity == Severity::warning ? "warning: " : "notice: ";
  if (!d.keyword.empty()) text += d.keyword + (d.field.empty() ? ": " : ", ");
  if (!d.field.empty()) text += "field " + d.field + ": ";
  text += d.message;
  if (!d.cure.empty()) text += "\n    -> " + d.cure;
  return text;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error && ++errors_ > error_limit) return;
  if (diagnostic.severity == Severity::warning) ++warnings_;
  entries_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string message, std::string cure, std::string keyword, SourceLocation where) {
  add({Severity::error, std::move(where), std::move(keyword), {}, std::move(message), std::move(cure)});
}

void Diagnostics::warning(std::string message, std::string cure, std::string keyword, SourceLocation where) {
  add({Severity::warning, std::move(where), std::move(keyword), {}, std::move(message), std::move(cure)});
}

void Diagnostics::notice(std::string message, std::string keyword, SourceLocation where) {
  add({Severity::notice, std::move(where), std::move(keyword), {}, std::move(message), {}});
}

InputError::InputError(Diagnostics diagnostics)
    : std::runtime_error(summary(diagnostics)), diagnostics_(std::move(diagnostics)) {}

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "kardan: internal contradiction at %s:%d: %s\n", file, line, condition);
  std::abort();
}

}  // namespace kardan

#include "kardan/io/deck/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace kardan::deck {

std::string to_string(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  return fmt::format("{}", std::get<double>(value));
}

int Parameters::open_scope(int parent) {
  parent_.push_back(parent);
  has_locals_.push_back(false);
  return static_cast<int>(parent_.size()) - 1;
}

void Parameters::define(const std::string& name, ParameterValue value, bool local, int scope, SourceLocation where) {
  if (local) has_locals_[static_cast<std::size_t>(scope)] = true;
  definitions_[key(name, local ? scope : global)].push_back({std::move(value), ++moment_, std::move(where)});
}

const Parameters::Definition* Parameters::latest(const std::string& key, std::uint32_t moment) const {
  const auto found = definitions_.find(key);
  if (found == definitions_.end()) return nullptr;
  const auto later = std::upper_bound(found->second.begin(), found->second.end(), moment,
                                      [](std::uint32_t m, const Definition& d) { return m < d.moment; });
  return later == found->second.begin() ? nullptr : &*(later - 1);
}

const Parameters::Definition* Parameters::existing(const std::string& name, bool local, int scope) const {
  return latest(key(name, local ? scope : global), moment_);
}

const Parameters::Definition* Parameters::find(const std::string& name, int scope, std::uint32_t moment) const {
  for (int s = scope; s >= 0; s = parent_[static_cast<std::size_t>(s)])
    if (has_locals_[static_cast<std::size_t>(s)])
      if (const Definition* d = latest(key(name, s), moment)) return d;
  return latest(key(name, global), moment);
}

const ParameterValue* ParameterView::find(std::string_view name) const {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const Parameters::Definition* d = parameters ? parameters->find(lower, scope, moment) : nullptr;
  return d == nullptr ? nullptr : &d->value;
}

}  // namespace kardan::deck

// *PARAMETER: numbers and texts by name, with the scopes of include files, and the expressions made of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "kardan/base/diagnostics.hpp"

namespace kardan::deck {

/// An integer, a real or a text. Integer and real are kept apart because expressions divide integers as Fortran does.
using ParameterValue = std::variant<std::int64_t, double, std::string>;
std::string to_string(const ParameterValue& value);

/// Every definition made while a deck is read, with the moment it was made: a block that is consumed later still sees
/// the values that held where it stands.
class Parameters {
 public:
  struct Definition {
    ParameterValue value;
    std::uint32_t moment = 0;
    SourceLocation where;
  };
  /// Scope 0 is the main file; every included file opens a scope below the including one's.
  int open_scope(int parent);
  /// Names are lower case. A local definition holds in its own file and the files included from there.
  void define(const std::string& name, ParameterValue value, bool local, int scope, SourceLocation where);
  /// The definition that a local (or global) definition of this name in this scope would repeat, if any.
  const Definition* existing(const std::string& name, bool local, int scope) const;
  const Definition* find(const std::string& name, int scope, std::uint32_t moment) const;
  std::uint32_t now() const { return moment_; }

 private:
  static std::string key(const std::string& name, int scope) { return std::to_string(scope) + ':' + name; }
  const Definition* latest(const std::string& key, std::uint32_t moment) const;
  static constexpr int global = -1;
  std::unordered_map<std::string, std::vector<Definition>> definitions_;
  std::vector<int> parent_ = {-1};
  std::vector<bool> has_locals_ = {false};
  std::uint32_t moment_ = 0;
};

/// The parameters as one place in the deck sees them.
struct ParameterView {
  std::shared_ptr<const Parameters> parameters;
  std::uint32_t moment = 0;
  int scope = 0;
  /// Case of `name` does not matter; nullptr if it is not defined here.
  const ParameterValue* find(std::string_view name) const;
};

/// Value of an expression, or why it has none (`problem`, with `offset` into the text).
struct ExpressionResult {
  std::optional<ParameterValue> value;
  std::string problem;
  std::size_t offset = 0;
};

/// Evaluates e.g. "term/(states-30)": + - * / ** ( ), Fortran's functions, parameters with or without "&".
/// Integers stay integers: 2/5 is 0, 2.0/5 is 0.4, as in LS-DYNA.
ExpressionResult evaluate_expression(std::string_view text, const ParameterView& view);

}  // namespace kardan::deck

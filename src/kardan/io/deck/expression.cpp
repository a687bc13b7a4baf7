// Recursive descent over Fortran-like expressions. Depth and length are bounded, so that no deck can exhaust the stack.
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "kardan/io/deck/number.hpp"
#include "kardan/io/deck/parameters.hpp"

namespace kardan::deck {

namespace {

constexpr std::size_t max_length = 4096;
constexpr int max_depth = 100;

struct Failure {
  std::string problem;
  std::size_t offset;
};

/// An integer or a real on the evaluator's stack.
struct Number {
  bool is_integer = false;
  std::int64_t integer = 0;
  double real = 0;
  double as_real() const { return is_integer ? static_cast<double>(integer) : real; }
  static Number of(double x) { return {false, 0, x}; }
  static Number of(std::int64_t i) { return {true, i, 0}; }
};

using Function = double (*)(double);
struct NamedFunction {
  std::string_view name;
  Function function;
};
constexpr std::array<NamedFunction, 18> functions_of_one = {{
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"log", [](double x) { return std::log(x); }},
    {"ln", [](double x) { return std::log(x); }},
    {"log10", [](double x) { return std::log10(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"aint", [](double x) { return std::trunc(x); }},
    {"anint", [](double x) { return std::round(x); }},
    {"float", [](double x) { return x; }},
    {"real", [](double x) { return x; }},
}};

class Evaluator {
 public:
  Evaluator(std::string_view text, const ParameterView& view) : text_(text), view_(view) {}

  Number run() {
    if (text_.size() > max_length) fail(fmt::format("the expression is longer than {} characters", max_length));
    const Number value = sum();
    skip_blanks();
    if (at_ < text_.size()) fail(fmt::format("'{}' is not expected here", text_[at_]));
    return value;
  }

 private:
  [[noreturn]] void fail(std::string problem) const { throw Failure{std::move(problem), std::min(at_, text_.size())}; }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  char peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  Number checked(double value, std::string_view what) const {
    if (!std::isfinite(value)) fail(fmt::format("{} has no finite value", what));
    return Number::of(value);
  }

  Number sum() {
    if (++depth_ > max_depth) fail(fmt::format("nested deeper than {} levels", max_depth));
    Number value = product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      const Number right = product();
      value = c == '+' ? add(value, right) : add(value, negated(right));
    }
    --depth_;
    return value;
  }

  Number product() {
    Number value = signed_power();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      const Number right = signed_power();
      value = c == '*' ? multiply(value, right) : divide(value, right);
    }
    return value;
  }

  // -a**b is -(a**b); a**-b is allowed.
  Number signed_power() {
    bool minus = false;
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      minus ^= c == '-';
    }
    Number base = atom();
    if (take("**") || take("^")) {
      if (++depth_ > max_depth) fail(fmt::format("nested deeper than {} levels", max_depth));
      base = power(base, signed_power());
      --depth_;
    }
    return minus ? negated(base) : base;
  }

  Number atom() {
    const char c = peek();
    if (c == '\0') fail("a number or a parameter is missing");
    if (c == '(') {
      ++at_;
      const Number value = sum();
      if (!take(")")) fail("')' is missing");
      return value;
    }
    if (c == '&') {
      ++at_;
      return parameter(word());
    }
    if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') {
      const std::string name = word();
      if (peek() == '(') return call(name);
      if (view_.find(name) == nullptr && name == "pi") return Number::of(std::numbers::pi);
      return parameter(name);
    }
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return literal();
    fail(fmt::format("'{}' is not expected here", c));
  }

  std::string word() {
    std::string name;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_++])));
    return name;
  }

  Number literal() {
    std::size_t end = at_;
    bool is_real = false;
    while (end < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[end])) || text_[end] == '.'))
      is_real |= text_[end++] == '.';
    // An exponent only with its letter: here "1.5-3" is a subtraction.
    if (end < text_.size() && std::string_view("eEdD").find(text_[end]) != std::string_view::npos) {
      std::size_t digits = end + 1;
      if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
      if (digits < text_.size() && std::isdigit(static_cast<unsigned char>(text_[digits]))) {
        is_real = true;
        for (end = digits; end < text_.size() && std::isdigit(static_cast<unsigned char>(text_[end])); ++end) {
        }
      }
    }
    const std::string_view number = text_.substr(at_, end - at_);
    const RealResult real = parse_real(number);
    if (real.state == NumberState::malformed) fail(fmt::format("'{}' is not a number", number));
    if (real.state == NumberState::too_large) fail(fmt::format("{} is too large", number));
    Number value = Number::of(real.value);
    if (!is_real) {
      const IntegerResult integer = parse_integer(number);
      if (integer.state == NumberState::ok) value = Number::of(integer.value);
    }
    at_ = end;
    return value;
  }

  Number parameter(const std::string& name) const {
    const ParameterValue* value = view_.find(name);
    if (value == nullptr)
      fail(fmt::format("parameter {} is not defined here", name.empty() ? "without a name" : "'" + name + "'"));
    if (const auto* integer = std::get_if<std::int64_t>(value)) return Number::of(*integer);
    if (const auto* real = std::get_if<double>(value)) return Number::of(*real);
    fail(fmt::format("parameter '{}' is a text, a number is needed", name));
  }

  Number call(const std::string& name) {
    const std::size_t start = at_;
    take("(");
    std::vector<Number> arguments;
    if (peek() != ')') {
      do arguments.push_back(sum());
      while (take(","));
    }
    if (!take(")")) fail("')' is missing");
    return apply(name, arguments, start);
  }

  Number apply(const std::string& name, const std::vector<Number>& arguments, std::size_t start) {
    const auto need = [&](std::size_t count) {
      if (arguments.size() == count) return;
      at_ = start;
      fail(fmt::format("{} takes {} argument{}, not {}", name, count, count == 1 ? "" : "s", arguments.size()));
    };
    for (const NamedFunction& f : functions_of_one)
      if (f.name == name) {
        need(1);
        return checked(f.function(arguments[0].as_real()),
                       name + "(" + fmt::format("{}", arguments[0].as_real()) + ")");
      }
    if (name == "abs") {
      need(1);
      return arguments[0].as_real() < 0 ? negated(arguments[0]) : arguments[0];
    }
    if (name == "int" || name == "nint") {
      need(1);
      return to_integer(name == "int" ? std::trunc(arguments[0].as_real()) : std::round(arguments[0].as_real()));
    }
    if (name == "atan2") {
      need(2);
      return checked(std::atan2(arguments[0].as_real(), arguments[1].as_real()), name);
    }
    if (name == "sign") {
      need(2);
      const bool flip = (arguments[0].as_real() < 0) != (arguments[1].as_real() < 0);
      return flip ? negated(arguments[0]) : arguments[0];
    }
    if (name == "mod") {
      need(2);
      return modulo(arguments[0], arguments[1]);
    }
    if (name == "min" || name == "max") {
      if (arguments.empty()) need(2);
      Number best = arguments[0];
      for (const Number& n : arguments)
        if (name == "min" ? n.as_real() < best.as_real() : n.as_real() > best.as_real()) best = n;
      return best;
    }
    at_ = start;
    fail(fmt::format("there is no function '{}'", name));
  }

  Number to_integer(double value) const {
    if (!(std::abs(value) < 9e18)) fail("the value is too large for an integer");
    return Number::of(static_cast<std::int64_t>(value));
  }
  Number negated(const Number& a) const {
    if (!a.is_integer) return Number::of(-a.real);
    if (a.integer == std::numeric_limits<std::int64_t>::min()) fail("the value is too large for an integer");
    return Number::of(-a.integer);
  }
  Number add(const Number& a, const Number& b) const {
    std::int64_t result = 0;
    if (!a.is_integer || !b.is_integer) return checked(a.as_real() + b.as_real(), "the sum");
    if (__builtin_add_overflow(a.integer, b.integer, &result)) fail("the sum is too large for an integer");
    return Number::of(result);
  }
  Number multiply(const Number& a, const Number& b) const {
    std::int64_t result = 0;
    if (!a.is_integer || !b.is_integer) return checked(a.as_real() * b.as_real(), "the product");
    if (__builtin_mul_overflow(a.integer, b.integer, &result)) fail("the product is too large for an integer");
    return Number::of(result);
  }
  Number divide(const Number& a, const Number& b) const {
    if (b.as_real() == 0) fail("division by zero");
    if (!a.is_integer || !b.is_integer) return checked(a.as_real() / b.as_real(), "the quotient");
    if (b.integer == -1) return negated(a);
    return Number::of(a.integer / b.integer);
  }
  Number modulo(const Number& a, const Number& b) const {
    if (b.as_real() == 0) fail("division by zero");
    if (!a.is_integer || !b.is_integer) return checked(std::fmod(a.as_real(), b.as_real()), "mod");
    return Number::of(b.integer == -1 ? std::int64_t{0} : a.integer % b.integer);
  }
  Number power(const Number& a, const Number& b) const {
    if (a.as_real() == 0 && b.as_real() < 0) fail("division by zero");
    const double value = std::pow(a.as_real(), b.as_real());
    if (!std::isfinite(value)) fail(fmt::format("{} ** {} has no finite value", a.as_real(), b.as_real()));
    if (!a.is_integer || !b.is_integer) return Number::of(value);
    return std::abs(value) <= 9e15 ? Number::of(static_cast<std::int64_t>(value)) : Number::of(value);
  }

  std::string_view text_;
  const ParameterView& view_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

ExpressionResult evaluate_expression(std::string_view text, const ParameterView& view) {
  ExpressionResult result;
  try {
    const Number value = Evaluator(text, view).run();
    result.value = value.is_integer ? ParameterValue(value.integer) : ParameterValue(value.real);
  } catch (const Failure& failure) {
    result.problem = failure.problem;
    result.offset = failure.offset;
  }
  return result;
}

}  // namespace kardan::deck

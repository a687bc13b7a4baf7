#include "kardan/io/deck/build/curve_function.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

namespace kardan::deck {

using Arguments = std::vector<double>;

struct CurveFunction::Node {
  enum class Kind { number, time, negate, add, subtract, multiply, divide, power, call } kind = Kind::number;
  double number = 0;
  double (*function)(const Arguments&) = nullptr;
  std::vector<Node> arguments;

  double evaluate(double t) const {
    switch (kind) {
      case Kind::number:
        return number;
      case Kind::time:
        return t;
      case Kind::negate:
        return -arguments[0].evaluate(t);
      case Kind::add:
        return arguments[0].evaluate(t) + arguments[1].evaluate(t);
      case Kind::subtract:
        return arguments[0].evaluate(t) - arguments[1].evaluate(t);
      case Kind::multiply:
        return arguments[0].evaluate(t) * arguments[1].evaluate(t);
      case Kind::divide:
        return arguments[0].evaluate(t) / arguments[1].evaluate(t);
      case Kind::power:
        return std::pow(arguments[0].evaluate(t), arguments[1].evaluate(t));
      case Kind::call:
        break;
    }
    Arguments values(arguments.size());
    std::transform(arguments.begin(), arguments.end(), values.begin(), [t](const Node& n) { return n.evaluate(t); });
    return function(values);
  }
};

namespace {

using Node = CurveFunction::Node;
constexpr std::size_t any = 64;  // largest number of arguments of a series
constexpr int deepest = 200;     // nesting of parentheses and calls

double ramp_cubic(const Arguments& a) {  // STEP(x, x0, h0, x1, h1)
  const double s = std::clamp((a[0] - a[1]) / (a[3] - a[1]), 0.0, 1.0);
  return a[2] + (a[4] - a[2]) * s * s * (3 - 2 * s);
}

double haversine(const Arguments& a) {  // HAVSIN(x, x0, h0, x1, h1)
  const double s = std::clamp((a[0] - a[1]) / (a[3] - a[1]), 0.0, 1.0);
  return 0.5 * (a[2] + a[4]) + 0.5 * (a[4] - a[2]) * std::sin((s - 0.5) * std::numbers::pi);
}

double polynomial(const Arguments& a) {  // POLY(x, x0, a0, a1, ...)
  double sum = 0;
  for (std::size_t j = a.size(); j-- > 2;) sum = sum * (a[0] - a[1]) + a[j];
  return sum;
}

double chebyshev(const Arguments& a) {  // CHEBY(x, x0, a0, a1, ...)
  const double x = a[0] - a[1];
  double before = 1, now = x, sum = a[2];
  for (std::size_t j = 3; j < a.size(); ++j) {
    sum += a[j] * now;
    before = std::exchange(now, 2 * x * now - before);
  }
  return sum;
}

template <double (*wave)(double)>
double fourier(const Arguments& a) {  // FORSIN / FORCOS(x, x0, omega, a0, a1, ...)
  double sum = a[3];
  for (std::size_t j = 4; j < a.size(); ++j) sum += a[j] * wave(static_cast<double>(j - 3) * a[2] * (a[0] - a[1]));
  return sum;
}

double sine(double x) {
  return std::sin(x);
}
double cosine(double x) {
  return std::cos(x);
}

struct Intrinsic {
  std::size_t least, most;
  double (*function)(const Arguments&);
};

const std::map<std::string, Intrinsic>& intrinsics() {
  static const std::map<std::string, Intrinsic> table{
      {"ABS", {1, 1, [](const Arguments& a) { return std::fabs(a[0]); }}},
      {"AINT", {1, 1, [](const Arguments& a) { return std::trunc(a[0]); }}},
      {"ANINT", {1, 1, [](const Arguments& a) { return std::round(a[0]); }}},
      {"MOD", {2, 2, [](const Arguments& a) { return std::fmod(a[0], a[1]); }}},
      {"SIGN", {2, 2, [](const Arguments& a) { return std::copysign(a[0], a[1]); }}},
      {"MAX", {2, any, [](const Arguments& a) { return *std::max_element(a.begin(), a.end()); }}},
      {"MIN", {2, any, [](const Arguments& a) { return *std::min_element(a.begin(), a.end()); }}},
      {"SQRT", {1, 1, [](const Arguments& a) { return std::sqrt(a[0]); }}},
      {"EXP", {1, 1, [](const Arguments& a) { return std::exp(a[0]); }}},
      {"LOG", {1, 1, [](const Arguments& a) { return std::log(a[0]); }}},
      {"LOG10", {1, 1, [](const Arguments& a) { return std::log10(a[0]); }}},
      {"SIN", {1, 1, [](const Arguments& a) { return std::sin(a[0]); }}},
      {"COS", {1, 1, [](const Arguments& a) { return std::cos(a[0]); }}},
      {"TAN", {1, 1, [](const Arguments& a) { return std::tan(a[0]); }}},
      {"ASIN", {1, 1, [](const Arguments& a) { return std::asin(a[0]); }}},
      {"ACOS", {1, 1, [](const Arguments& a) { return std::acos(a[0]); }}},
      {"ATAN", {1, 1, [](const Arguments& a) { return std::atan(a[0]); }}},
      {"ATAN2", {2, 2, [](const Arguments& a) { return std::atan2(a[0], a[1]); }}},
      {"SINH", {1, 1, [](const Arguments& a) { return std::sinh(a[0]); }}},
      {"COSH", {1, 1, [](const Arguments& a) { return std::cosh(a[0]); }}},
      {"TANH", {1, 1, [](const Arguments& a) { return std::tanh(a[0]); }}},
      {"IF", {4, 4, [](const Arguments& a) { return a[0] < 0 ? a[1] : (a[0] > 0 ? a[3] : a[2]); }}},
      {"STEP", {5, 5, ramp_cubic}},
      {"HAVSIN", {5, 5, haversine}},
      {"POLY", {3, any, polynomial}},
      {"CHEBY", {3, any, chebyshev}},
      {"FORSIN", {4, any, fourier<sine>}},
      {"FORCOS", {4, any, fourier<cosine>}},
      {"SHF", {5, 6, [](const Arguments& a) {  // SHF(x, x0, a, omega, phi, b)
                 return a[2] * std::sin(a[3] * (a[0] - a[1]) - a[4]) + (a.size() > 5 ? a[5] : 0.0);
               }}}};
  return table;
}

/// Recursive descent over the text; precedence as in Fortran (unary minus below **).
class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Node parse() {
    Node node = sum();
    skip_blanks();
    if (at_ < text_.size()) fail(std::string("unexpected '") + text_[at_] + "'");
    return node;
  }

 private:
  [[noreturn]] void fail(const std::string& message, bool other = false) const {
    throw CurveFunctionError(message, at_, other);
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(const char* token) {
    skip_blanks();
    const std::string t(token);
    if (text_.compare(at_, t.size(), t) != 0) return false;
    if (t == "*" && text_.compare(at_, 2, "**") == 0) return false;
    at_ += t.size();
    return true;
  }
  static Node binary(Node::Kind kind, Node a, Node b) {
    Node node;
    node.kind = kind;
    node.arguments.push_back(std::move(a));
    node.arguments.push_back(std::move(b));
    return node;
  }

  Node sum() {
    if (++depth_ > deepest) fail("the expression is nested too deeply");
    Node node = product();
    for (;;) {
      if (take("+"))
        node = binary(Node::Kind::add, std::move(node), product());
      else if (take("-"))
        node = binary(Node::Kind::subtract, std::move(node), product());
      else
        break;
    }
    --depth_;
    return node;
  }
  Node product() {
    Node node = signed_factor();
    for (;;) {
      if (take("*"))
        node = binary(Node::Kind::multiply, std::move(node), signed_factor());
      else if (take("/"))
        node = binary(Node::Kind::divide, std::move(node), signed_factor());
      else
        return node;
    }
  }
  Node signed_factor() {
    bool minus = false;
    for (;;) {
      if (take("-"))
        minus = !minus;
      else if (!take("+"))
        break;
    }
    Node node = primary();
    if (take("**")) {
      if (++depth_ > deepest) fail("the expression is nested too deeply");
      node = binary(Node::Kind::power, std::move(node), signed_factor());
      --depth_;
    }
    if (!minus) return node;
    Node negated;
    negated.kind = Node::Kind::negate;
    negated.arguments.push_back(std::move(node));
    return negated;
  }
  Node primary() {
    skip_blanks();
    if (at_ >= text_.size()) fail("the expression ends where a value is expected");
    if (take("(")) {
      Node node = sum();
      if (!take(")")) fail("')' is missing");
      return node;
    }
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') return name();
    fail(std::string("unexpected '") + c + "'");
  }
  Node number() {
    std::string digits;
    const auto digit = [this] { return at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])); };
    while (digit()) digits += text_[at_++];
    if (at_ < text_.size() && text_[at_] == '.') {
      digits += text_[at_++];
      while (digit()) digits += text_[at_++];
    }
    if (at_ + 1 < text_.size() && std::string("eEdD").find(text_[at_]) != std::string::npos) {
      const char next = text_[at_ + 1];
      const bool sign = (next == '+' || next == '-') && at_ + 2 < text_.size() &&
                        std::isdigit(static_cast<unsigned char>(text_[at_ + 2]));
      if (sign || std::isdigit(static_cast<unsigned char>(next))) {
        digits += 'e';
        ++at_;
        if (sign) digits += text_[at_++];
        while (digit()) digits += text_[at_++];
      }
    }
    Node node;
    node.number = std::strtod(digits.c_str(), nullptr);
    return node;
  }
  Node name() {
    const std::size_t start = at_;
    std::string id;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) {
      id += static_cast<char>(std::toupper(static_cast<unsigned char>(text_[at_++])));
    }
    Node node;
    if (id == "TIME" || id == "PI" || id == "DTOR" || id == "RTOD") {
      if (id == "TIME")
        node.kind = Node::Kind::time;
      else
        node.number = id == "PI" ? std::numbers::pi : (id == "DTOR" ? std::numbers::pi / 180 : 180 / std::numbers::pi);
      return node;
    }
    const auto known = intrinsics().find(id);
    if (known == intrinsics().end()) {
      at_ = start;
      fail("'" + id + "' is not TIME, a constant or an intrinsic function of them", true);
    }
    if (!take("(")) fail("'(' is missing after " + id);
    do node.arguments.push_back(sum());
    while (node.arguments.size() < any + 1 && take(","));
    if (!take(")")) fail("')' is missing after the arguments of " + id);
    const Intrinsic& f = known->second;
    if (node.arguments.size() < f.least || node.arguments.size() > f.most) {
      fail(id + " has " + std::to_string(node.arguments.size()) + " arguments, expected " + std::to_string(f.least) +
           (f.most == f.least ? "" : " or more"));
    }
    node.kind = Node::Kind::call;
    node.function = f.function;
    return node;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

CurveFunction::CurveFunction(const std::string& text) : root_(std::make_unique<Node>(Parser(text).parse())) {}
CurveFunction::~CurveFunction() = default;
CurveFunction::CurveFunction(CurveFunction&&) noexcept = default;
CurveFunction& CurveFunction::operator=(CurveFunction&&) noexcept = default;
double CurveFunction::operator()(double time) const {
  return root_->evaluate(time);
}

bool sample(const CurveFunction& f, double end, double tolerance, std::size_t limit, Curve& curve) {
  constexpr int start_intervals = 64;  // so that a short pulse is not stepped over
  const double shortest = 1e-9 * end;
  double largest = 0;
  for (int i = 0; i <= 16 * start_intervals; ++i) {
    const double y = f(end * i / (16 * start_intervals));
    if (!std::isfinite(y)) return false;
    largest = std::max(largest, std::fabs(y));
  }
  const double close = tolerance * largest;

  std::vector<std::pair<double, double>> ahead;  // points still to reach, nearest last
  for (int i = start_intervals; i > 0; --i) ahead.emplace_back(end * i / start_intervals, f(end * i / start_intervals));
  curve.x = {0.0};
  curve.y = {f(0.0)};
  while (!ahead.empty()) {
    if (curve.x.size() + ahead.size() > limit) return false;
    const auto [x1, y1] = ahead.back();
    const double x0 = curve.x.back(), y0 = curve.y.back();
    bool straight = true;
    double middle = y0;
    for (const double s : {0.25, 0.5, 0.75}) {
      const double y = f(x0 + s * (x1 - x0));
      if (!std::isfinite(y)) return false;
      if (s == 0.5) middle = y;
      straight = straight && std::fabs(y - (y0 + s * (y1 - y0))) <= close;
    }
    if (straight || x1 - x0 <= shortest) {
      curve.x.push_back(x1);
      curve.y.push_back(y1);
      ahead.pop_back();
    } else {
      ahead.emplace_back(x0 + 0.5 * (x1 - x0), middle);
    }
  }
  return true;
}

}  // namespace kardan::deck

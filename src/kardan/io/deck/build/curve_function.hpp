// Functions of TIME as *DEFINE_CURVE_FUNCTION writes them.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kardan/model/curve.hpp"

namespace kardan::deck {

/// The text is not a function of TIME that Kardan can evaluate; what() says which name or character stopped it.
class CurveFunctionError : public std::runtime_error {
 public:
  CurveFunctionError(const std::string& message, std::size_t at, bool other_variable)
      : std::runtime_error(message), position(at), solver_variable(other_variable) {}
  std::size_t position;  ///< 0-based character of the text
  bool solver_variable;  ///< a function of the solution (displacement, force, sensor), not a slip of the pen
};

/// A parsed expression: + - * / **, parentheses, TIME, PI, DTOR, RTOD and the intrinsic functions ABS AINT ANINT MOD
/// SIGN MAX MIN SQRT EXP LOG LOG10 SIN COS TAN ASIN ACOS ATAN ATAN2 SINH COSH TANH IF STEP HAVSIN POLY CHEBY FORSIN
/// FORCOS SHF (arguments in the order of the LS-DYNA manual, *DEFINE_CURVE_FUNCTION).
class CurveFunction {
 public:
  /// Throws CurveFunctionError.
  explicit CurveFunction(const std::string& text);
  ~CurveFunction();
  CurveFunction(CurveFunction&&) noexcept;
  CurveFunction& operator=(CurveFunction&&) noexcept;

  double operator()(double time) const;

  struct Node;

 private:
  std::unique_ptr<Node> root_;
};

/// Samples f over [0, end] so that linear interpolation between the points is within `tolerance` times the largest |f|
/// at the quarter points of every interval. Jumps are enclosed in intervals of 1e-9 end. Returns false (and the
/// points so far) where more than `limit` points would be needed or f is not finite somewhere.
bool sample(const CurveFunction& f, double end, double tolerance, std::size_t limit, Curve& curve);

}  // namespace kardan::deck

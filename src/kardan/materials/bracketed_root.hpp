// The root of a function between 0 and a bound where it is not negative, for packs: Newton's method, kept inside the bracket that the
// values found so far leave.
//
// A step of Newton's that leaves the bracket is replaced by the bracket's middle, and every fourth step takes the middle in any case, so
// the bracket shrinks at least 16 times every sixteen steps whatever the function (W. H. Press et al. 2007, Numerical Recipes, section 9.4,
// without the test of the rate of convergence). The function need not rise everywhere: it must be continuous, negative at 0 and not
// negative at the bound; where it has several roots one of them is found, the same on every machine.
#pragma once

namespace kardan {

template <class R>
struct ValueAndSlope {
  R value, slope;
};

/// @param x where to start, in [0, high]
/// @param active lanes that look for a root; the others keep x
/// @param f what it is the root of; f(x) is a ValueAndSlope. The last call is at the root that is returned.
template <class R, class Mask, class F>
[[gnu::always_inline]] inline R bracketed_root(R x, R high, Mask active, double tolerance, F&& f) {
  constexpr int iterations = 220;
  R low(0.0);
  for (int i = 0; i < iterations; ++i) {
    const ValueAndSlope<R> at = f(x);
    active = active & (abs(at.value) > R(tolerance));
    if (!R::any(active)) break;
    low = select(active & (at.value < R(0.0)), x, low);
    high = select(active & (at.value > R(0.0)), x, high);
    const R newton = x - at.value / at.slope, middle = R(0.5) * (low + high);
    R next = middle;
    if (i % 4 != 3) next = select((newton > low) & (newton < high), newton, middle);
    active = active & (next > low) & (next < high);  // else the bracket is shut: there is no number between its ends
    x = select(active, next, x);
  }
  return x;
}

}  // namespace kardan

// Three packs computed side by side, as one number type: where an operation waits for the one before, the processor works on the other
// packs meanwhile. It does not find them by itself where a formula is longer than what it looks ahead, some hundred operations.
// Every pack gets, bit by bit, what it would get alone.
#pragma once

#include "kardan/base/simd_math.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

/// load() and store() find the packs at p, p + Distance and p + 2 Distance.
template <std::size_t Distance>
struct PackTrio {
  struct Mask {
    Pack::Mask a, b, c;

    KARDAN_FRIEND Mask operator&(const Mask& x, const Mask& y) { return {x.a & y.a, x.b & y.b, x.c & y.c}; }
    KARDAN_FRIEND Mask operator|(const Mask& x, const Mask& y) { return {x.a | y.a, x.b | y.b, x.c | y.c}; }
    KARDAN_FRIEND Mask operator+(const Mask& x, std::int64_t y) { return {x.a + y, x.b + y, x.c + y}; }
  };

  Pack a, b, c;

  PackTrio() = default;
  KARDAN_INLINE PackTrio(double x) : a(x), b(x), c(x) {}
  KARDAN_INLINE PackTrio(const Pack& x) : a(x), b(x), c(x) {}
  KARDAN_INLINE PackTrio(const Pack& x, const Pack& y, const Pack& z) : a(x), b(y), c(z) {}

  KARDAN_INLINE static PackTrio load(const double* p) { return {Pack::load(p), Pack::load(p + Distance), Pack::load(p + 2 * Distance)}; }
  KARDAN_INLINE void store(double* p) const {
    a.store(p);
    b.store(p + Distance);
    c.store(p + 2 * Distance);
  }
  KARDAN_INLINE static bool any(const Mask& mask) { return Pack::any(mask.a | mask.b | mask.c); }
  KARDAN_INLINE static Mask choose(const Mask& mask, const Mask& x, const Mask& y) {
    return {Pack::choose(mask.a, x.a, y.a), Pack::choose(mask.b, x.b, y.b), Pack::choose(mask.c, x.c, y.c)};
  }
  KARDAN_INLINE static PackTrio gather(const double* base, const Mask& index) {
    return {Pack::gather(base, index.a), Pack::gather(base, index.b), Pack::gather(base, index.c)};
  }

  KARDAN_INLINE PackTrio& operator+=(const PackTrio& y) { a += y.a, b += y.b, c += y.c; return *this; }
  KARDAN_INLINE PackTrio& operator-=(const PackTrio& y) { a -= y.a, b -= y.b, c -= y.c; return *this; }
  KARDAN_INLINE PackTrio& operator*=(const PackTrio& y) { a *= y.a, b *= y.b, c *= y.c; return *this; }
  KARDAN_FRIEND PackTrio operator+(const PackTrio& x, const PackTrio& y) { return {x.a + y.a, x.b + y.b, x.c + y.c}; }
  KARDAN_FRIEND PackTrio operator-(const PackTrio& x, const PackTrio& y) { return {x.a - y.a, x.b - y.b, x.c - y.c}; }
  KARDAN_FRIEND PackTrio operator*(const PackTrio& x, const PackTrio& y) { return {x.a * y.a, x.b * y.b, x.c * y.c}; }
  KARDAN_FRIEND PackTrio operator/(const PackTrio& x, const PackTrio& y) { return {x.a / y.a, x.b / y.b, x.c / y.c}; }
  KARDAN_FRIEND PackTrio operator-(const PackTrio& x) { return {-x.a, -x.b, -x.c}; }
  KARDAN_FRIEND Mask operator<(const PackTrio& x, const PackTrio& y) { return {x.a < y.a, x.b < y.b, x.c < y.c}; }
  KARDAN_FRIEND Mask operator>(const PackTrio& x, const PackTrio& y) { return {x.a > y.a, x.b > y.b, x.c > y.c}; }
  KARDAN_FRIEND PackTrio select(const Mask& mask, const PackTrio& x, const PackTrio& y) {
    return {select(mask.a, x.a, y.a), select(mask.b, x.b, y.b), select(mask.c, x.c, y.c)};
  }
  KARDAN_FRIEND PackTrio abs(const PackTrio& x) { return {abs(x.a), abs(x.b), abs(x.c)}; }
  KARDAN_FRIEND PackTrio max(const PackTrio& x, const PackTrio& y) { return {max(x.a, y.a), max(x.b, y.b), max(x.c, y.c)}; }
  KARDAN_FRIEND PackTrio min(const PackTrio& x, const PackTrio& y) { return {min(x.a, y.a), min(x.b, y.b), min(x.c, y.c)}; }
  KARDAN_FRIEND PackTrio sqrt(const PackTrio& x) { return {sqrt(x.a), sqrt(x.b), sqrt(x.c)}; }
  KARDAN_FRIEND PackTrio inverse_sqrt(const PackTrio& x) { return {inverse_sqrt(x.a), inverse_sqrt(x.b), inverse_sqrt(x.c)}; }
  KARDAN_FRIEND PackTrio log(const PackTrio& x) { return {log(x.a), log(x.b), log(x.c)}; }
  KARDAN_FRIEND PackTrio exp(const PackTrio& x) { return {exp(x.a), exp(x.b), exp(x.c)}; }
};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

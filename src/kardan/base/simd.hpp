// Packs of doubles for the kernels: one number type R on which the mathematics is written once.
//
// Memory is laid out in blocks of `block_lanes` values (AoSoA) whatever the machine; a Pack is as wide as the instruction set the
// translation unit is compiled for, and a kernel runs over the block in block_lanes / Pack::lanes pieces. The same operations are
// done on every lane in the same order with any width, so results do not depend on the instruction set.
//
// A kernel's translation unit that is compiled more than once defines KARDAN_ISA_NAMESPACE before it includes this file: the
// types of different instruction sets are then different types, and the linker cannot merge their inline functions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kardan/base/lanes.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef KARDAN_ISA_NAMESPACE
#define KARDAN_ISA_NAMESPACE isa_of_build
#endif

namespace kardan {

namespace KARDAN_ISA_NAMESPACE {

#if defined(__AVX512F__)
inline constexpr std::size_t native_lanes = 8;
#elif defined(__AVX__)
inline constexpr std::size_t native_lanes = 4;
#else
inline constexpr std::size_t native_lanes = 2;
#endif

#define KARDAN_INLINE [[gnu::always_inline]] inline
#define KARDAN_FRIEND [[gnu::always_inline]] friend inline

/// native_lanes doubles; arithmetic is lane by lane.
struct Pack {
  static constexpr std::size_t lanes = native_lanes;
  typedef double Vector __attribute__((vector_size(native_lanes * sizeof(double))));
  typedef std::int64_t Mask __attribute__((vector_size(native_lanes * sizeof(std::int64_t))));

  Vector v{};

  Pack() = default;
  KARDAN_INLINE Pack(double a) : v(a - Vector{}) {}  // a - 0 is a, also for -0: the compiler leaves it out, which it may not do with 0 + a
  KARDAN_INLINE explicit Pack(Vector a) : v(a) {}

  KARDAN_INLINE static Pack load(const double* p) {
    Pack r;
    std::memcpy(&r.v, p, sizeof r.v);
    return r;
  }
  KARDAN_INLINE void store(double* p) const { std::memcpy(p, &v, sizeof v); }

  /// Whether a lane is set.
  KARDAN_INLINE static bool any(const Mask& mask) {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#elif defined(__AVX__)
    return _mm256_movemask_pd((__m256d)mask) != 0;
#elif defined(__x86_64__)
    return _mm_movemask_pd((__m128d)mask) != 0;
#else
    std::int64_t bits = 0;
    for (std::size_t l = 0; l < native_lanes; ++l) bits |= mask[l];
    return bits != 0;
#endif
  }
  KARDAN_INLINE static Mask choose(const Mask& mask, const Mask& a, const Mask& b) { return mask ? a : b; }
  /// base[index] of every lane.
  KARDAN_INLINE static Pack gather(const double* base, const Mask& index) {
#if defined(__AVX512F__)
    return Pack(Pack::Vector(_mm512_mask_i64gather_pd(__m512d{}, 0xff, (__m512i)index, base, sizeof(double))));
#else
    Pack r;
    for (std::size_t l = 0; l < native_lanes; ++l) r.v[l] = base[index[l]];
    return r;
#endif
  }

  KARDAN_INLINE Pack& operator+=(const Pack& b) { v += b.v; return *this; }
  KARDAN_INLINE Pack& operator-=(const Pack& b) { v -= b.v; return *this; }
  KARDAN_INLINE Pack& operator*=(const Pack& b) { v *= b.v; return *this; }
  KARDAN_INLINE Pack& operator/=(const Pack& b) { v /= b.v; return *this; }
  KARDAN_FRIEND Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  KARDAN_FRIEND Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  KARDAN_FRIEND Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  KARDAN_FRIEND Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  KARDAN_FRIEND Pack operator-(const Pack& a) { return Pack(-a.v); }
  KARDAN_FRIEND Mask operator<(const Pack& a, const Pack& b) { return a.v < b.v; }
  KARDAN_FRIEND Mask operator>(const Pack& a, const Pack& b) { return a.v > b.v; }
};

KARDAN_INLINE Pack select(const Pack::Mask& mask, const Pack& a, const Pack& b) { return Pack(mask ? a.v : b.v); }
KARDAN_INLINE Pack abs(const Pack& a) { return Pack(Pack::Vector((Pack::Mask)a.v & 0x7fffffffffffffff)); }
KARDAN_INLINE Pack max(const Pack& a, const Pack& b) { return select(a > b, a, b); }
KARDAN_INLINE Pack min(const Pack& a, const Pack& b) { return select(a < b, a, b); }

KARDAN_INLINE Pack sqrt(const Pack& a) {
#if defined(__AVX512F__)
  return Pack(Pack::Vector(_mm512_maskz_sqrt_pd(0xff, a.v)));  // the unmasked one warns in GCC 12
#elif defined(__AVX__)
  return Pack(Pack::Vector(_mm256_sqrt_pd(a.v)));
#elif defined(__x86_64__)
  return Pack(Pack::Vector(_mm_sqrt_pd(a.v)));
#else
  Pack r;
  for (std::size_t l = 0; l < native_lanes; ++l) r.v[l] = std::sqrt(a.v[l]);
  return r;
#endif
}

}  // namespace KARDAN_ISA_NAMESPACE
}  // namespace kardan

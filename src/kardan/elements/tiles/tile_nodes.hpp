// How a pack takes vectors from the nodes of a tile, and how forces go back to them. Included by translation units that are compiled
// for one instruction set each.
//
// A node's vectors lie in fours, so that one is a single load; lanes and components then change places in registers. Forces are turned
// round likewise and given to the nodes element by element: nodes are shared by neighbouring lanes.
#pragma once

#include <cstdint>
#include <cstring>

#include "kardan/base/simd.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/elements/tiles/tile_work.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

typedef double Four __attribute__((vector_size(4 * sizeof(double))));
typedef double Eight __attribute__((vector_size(8 * sizeof(double))));
typedef double Two __attribute__((vector_size(2 * sizeof(double))));

template <class V, class T>
KARDAN_INLINE V load_as(const T* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
template <class V>
KARDAN_INLINE void store_as(const V& v, double* p) {
  std::memcpy(p, &v, sizeof v);
}

/// Asks the memory for values of a pack that will be needed soon. A few at a time, spread over a kernel: a core waits for some ten cache
/// lines at once, and what the next block needs is more than that.
KARDAN_INLINE void ask_for(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(values + i * block_lanes, 1);
}

/// The vectors at base + stride * index[lane] of the pack's lanes; a fourth value behind each is read and left.
template <std::size_t Stride>
KARDAN_INLINE Vec3T<Pack> gather_vectors(const double* base, const std::uint16_t* index) {
  const auto at = [&](std::size_t lane) { return load_as<Four>(base + Stride * index[lane]); };
  Vec3T<Pack> r;
#if defined(__AVX512F__)
  const auto pair = [&](std::size_t lane) {
    return Pack::Vector(__builtin_shufflevector(at(lane), at(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7));
  };
  const Pack::Vector p0 = pair(0), p1 = pair(1), p2 = pair(2), p3 = pair(3);
  const Pack::Vector xz01 = __builtin_shufflevector(p0, p1, 0, 8, 2, 10, 4, 12, 6, 14);
  const Pack::Vector xz23 = __builtin_shufflevector(p2, p3, 0, 8, 2, 10, 4, 12, 6, 14);
  const Pack::Vector y01 = __builtin_shufflevector(p0, p1, 1, 9, 3, 11, 5, 13, 7, 15);
  const Pack::Vector y23 = __builtin_shufflevector(p2, p3, 1, 9, 3, 11, 5, 13, 7, 15);
  r.x.v = __builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13);
  r.y.v = __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13);
  r.z.v = __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15);
#elif defined(__AVX__)
  const Four p0 = at(0), p1 = at(1), p2 = at(2), p3 = at(3);
  const Four xz01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6), xz23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6);
  const Four y01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7), y23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
  r.x.v = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
  r.y.v = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
  r.z.v = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
#else
  for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
    const Four p = at(lane);
    r.x.v[lane] = p[0];
    r.y.v[lane] = p[1];
    r.z.v[lane] = p[2];
  }
#endif
  return r;
}

#if defined(__AVX512F__)
/// a, b, c, d of lanes 0 and 4, 1 and 5, 2 and 6, 3 and 7, of each lane next to one another.
struct PairsOfFour {
  Pack::Vector lanes_0_4, lanes_1_5, lanes_2_6, lanes_3_7;

  KARDAN_INLINE PairsOfFour(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
    const Pack::Vector ab02 = __builtin_shufflevector(a.v, b.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const Pack::Vector ab13 = __builtin_shufflevector(a.v, b.v, 1, 9, 3, 11, 5, 13, 7, 15);
    const Pack::Vector cd02 = __builtin_shufflevector(c.v, d.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const Pack::Vector cd13 = __builtin_shufflevector(c.v, d.v, 1, 9, 3, 11, 5, 13, 7, 15);
    lanes_0_4 = __builtin_shufflevector(ab02, cd02, 0, 1, 8, 9, 4, 5, 12, 13);
    lanes_1_5 = __builtin_shufflevector(ab13, cd13, 0, 1, 8, 9, 4, 5, 12, 13);
    lanes_2_6 = __builtin_shufflevector(ab02, cd02, 2, 3, 10, 11, 6, 7, 14, 15);
    lanes_3_7 = __builtin_shufflevector(ab13, cd13, 2, 3, 10, 11, 6, 7, 14, 15);
  }
};
#endif

/// Writes a, b, c, d of every lane next to one another: lane l to to[l * Stride].
template <std::size_t Stride>
KARDAN_INLINE void spread(const Pack& a, const Pack& b, const Pack& c, const Pack& d, double* to) {
#if defined(__AVX512F__)
  const PairsOfFour p(a, b, c, d);
  const auto both = [&](const Pack::Vector& v, std::size_t lane) {
    store_as(Four(__builtin_shufflevector(v, v, 0, 1, 2, 3)), to + lane * Stride);
    store_as(Four(__builtin_shufflevector(v, v, 4, 5, 6, 7)), to + (lane + 4) * Stride);
  };
  both(p.lanes_0_4, 0);
  both(p.lanes_1_5, 1);
  both(p.lanes_2_6, 2);
  both(p.lanes_3_7, 3);
#elif defined(__AVX__)
  const Four ab02 = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6), ab13 = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
  const Four cd02 = __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6), cd13 = __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
  store_as(Four(__builtin_shufflevector(ab02, cd02, 0, 1, 4, 5)), to);
  store_as(Four(__builtin_shufflevector(ab13, cd13, 0, 1, 4, 5)), to + Stride);
  store_as(Four(__builtin_shufflevector(ab02, cd02, 2, 3, 6, 7)), to + 2 * Stride);
  store_as(Four(__builtin_shufflevector(ab13, cd13, 2, 3, 6, 7)), to + 3 * Stride);
#else
  for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
    double* const p = to + lane * Stride;
    p[0] = a.v[lane];
    p[1] = b.v[lane];
    p[2] = c.v[lane];
    p[3] = d.v[lane];
  }
#endif
}

/// Writes force and moment of every lane next to one another, lane l to to[8 l]; what stands behind them is no matter.
KARDAN_INLINE void spread_six(const Vec3T<Pack>& f, const Vec3T<Pack>& m, double* to) {
#if defined(__AVX512F__)
  const PairsOfFour p(f.x, f.y, f.z, m.x);
  const Pack::Vector even = __builtin_shufflevector(m.y.v, m.z.v, 0, 8, 2, 10, 4, 12, 6, 14);
  const Pack::Vector odd = __builtin_shufflevector(m.y.v, m.z.v, 1, 9, 3, 11, 5, 13, 7, 15);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_0_4, even, 0, 1, 2, 3, 8, 9, 8, 9)), to);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_1_5, odd, 0, 1, 2, 3, 8, 9, 8, 9)), to + 8);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_2_6, even, 0, 1, 2, 3, 10, 11, 10, 11)), to + 16);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_3_7, odd, 0, 1, 2, 3, 10, 11, 10, 11)), to + 24);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_0_4, even, 4, 5, 6, 7, 12, 13, 12, 13)), to + 32);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_1_5, odd, 4, 5, 6, 7, 12, 13, 12, 13)), to + 40);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_2_6, even, 4, 5, 6, 7, 14, 15, 14, 15)), to + 48);
  store_as(Pack::Vector(__builtin_shufflevector(p.lanes_3_7, odd, 4, 5, 6, 7, 14, 15, 14, 15)), to + 56);
#else
  spread<8>(f.x, f.y, f.z, m.x, to);
  spread<8>(m.y, m.z, Pack(), Pack(), to + 4);
#endif
}

/// Forces of a block's elements on their nodes, as the nodes have them: [node of the element][lane][force and moment].
template <std::size_t Nodes, std::size_t Components>
struct alignas(64) NodalForces {
  static constexpr std::size_t stride = sum_stride(Components);
  double value[Nodes][block_lanes][stride];

  /// Forces (and moments) on node a of the lanes from `first` on.
  KARDAN_INLINE void set(std::size_t a, std::size_t first, const Vec3T<Pack>& f) {
    spread<stride>(f.x, f.y, f.z, Pack(), value[a][first]);
  }
  KARDAN_INLINE void set(std::size_t a, std::size_t first, const Vec3T<Pack>& f, const Vec3T<Pack>& m) {
    spread_six(f, m, value[a][first]);
  }
  /// Takes the forces of the lanes that are alive from the sums of the tile's nodes: what acts on the element acts against its node.
  KARDAN_INLINE void scatter(const std::uint16_t* connectivity, const double* alive, double* sums) const {
    bool all = true;
    for (std::size_t l = 0; l < block_lanes; l += Pack::lanes) all &= !Pack::any(~(Pack::load(alive + l) > Pack(0.0)));
    const auto of_lanes = [&](auto&& lives) {
      for (std::size_t a = 0; a < Nodes; ++a) {
        for (std::size_t l = 0; l < block_lanes; ++l) {
          if (lives(l)) take(connectivity[a * block_lanes + l], value[a][l], sums);
        }
      }
    };
    if (all) {
      of_lanes([](std::size_t) { return true; });
    } else {
      of_lanes([alive](std::size_t l) { return alive[l] > 0; });
    }
  }

 private:
  KARDAN_INLINE static void take(std::size_t node, const double* own, double* sums) {
    double* const sum = sums + stride * node;
#if defined(__AVX512F__)
    if constexpr (Components == 6) {
      store_as(load_as<Eight>(sum) - load_as<Eight>(own), sum);
      return;
    }
#endif
    store_as(load_as<Four>(sum) - load_as<Four>(own), sum);
    if constexpr (Components == 6) store_as(load_as<Two>(sum + 4) - load_as<Two>(own + 4), sum + 4);
  }
};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

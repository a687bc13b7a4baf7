// Things that one loop makes and the next one takes: pieces of the first loop put them into buckets, pieces of the second take each bucket's out again.
//
// Pieces and buckets are cut from the numbers of things alone, never from the number of threads, and a bucket gives back what it holds by piece, in the
// order in which the piece put it in. So the order is that of one loop over everything, whoever did the pieces.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace kardan {

/// The numbers 0 ... count - 1 in at most 64 pieces of equal size, a power of two.
class Pieces {
 public:
  static constexpr std::size_t most = 64;

  Pieces() = default;
  /// @param least  smallest size that is worth a piece, a power of two
  explicit Pieces(std::size_t numbers, std::size_t least = 512) : numbers_(numbers) {
    shift_ = static_cast<int>(std::bit_width(std::max(least, std::bit_ceil((numbers + most - 1) / most)))) - 1;
  }
  std::size_t count() const { return (numbers_ + (std::size_t{1} << shift_) - 1) >> shift_; }
  std::size_t begin(std::size_t piece) const { return piece << shift_; }
  std::size_t end(std::size_t piece) const { return std::min((piece + 1) << shift_, numbers_); }
  /// The piece that a number is in.
  std::size_t of(std::size_t number) const { return number >> shift_; }

 private:
  std::size_t numbers_ = 0;
  int shift_ = 0;
};

/// f(piece, begin, end) for all pieces, by several threads where there are more than two.
template <class F>
void for_each_piece(const Pieces& pieces, F&& f) {
  const auto count = static_cast<std::ptrdiff_t>(pieces.count());
#pragma omp parallel for schedule(dynamic) if (count > 2)
  for (std::ptrdiff_t p = 0; p < count; ++p) {
    const auto piece = static_cast<std::size_t>(p);
    f(piece, pieces.begin(piece), pieces.end(piece));
  }
}

template <class T>
class Exchange {
 public:
  /// By one thread, before any piece opens.
  void start(std::size_t pieces, std::size_t buckets) {
    pieces_ = pieces;
    buckets_ = buckets;
    if (lists_.size() < pieces * buckets) lists_.resize(pieces * buckets);
  }
  /// By whoever does the piece, before it puts something in.
  void open(std::size_t piece) {
    for (std::size_t b = 0; b < buckets_; ++b) lists_[piece * buckets_ + b].clear();
  }
  void put(std::size_t piece, std::size_t bucket, const T& item) { lists_[piece * buckets_ + bucket].push_back(item); }

  std::size_t size(std::size_t bucket) const {
    std::size_t size = 0;
    for (std::size_t p = 0; p < pieces_; ++p) size += lists_[p * buckets_ + bucket].size();
    return size;
  }
  /// f(item) for all of a bucket.
  template <class F>
  void each(std::size_t bucket, F&& f) const {
    for (std::size_t p = 0; p < pieces_; ++p)
      for (const T& item : lists_[p * buckets_ + bucket]) f(item);
  }

 private:
  std::size_t pieces_ = 0, buckets_ = 0;
  std::vector<std::vector<T>> lists_;  ///< [piece][bucket]
};

}  // namespace kardan

// From the user's numbers to indices: a dense array where the numbers are compact, a hash map for those far away.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kardan/base/index.hpp"

namespace kardan {

/// Finds like std::unordered_map<UserId, Index> (find, end, at, contains, count, emplace, operator[]), but without a
/// hash for the numbers of an ordinary mesh: a million nodes are entered in a few milliseconds.
class IdMap {
 public:
  using value_type = std::pair<UserId, Index>;

  /// What find() returns: points to the pair it holds; equal to end() when nothing was found.
  class const_iterator {
   public:
    const_iterator() = default;
    const_iterator(UserId id, Index index) : hit_{id, index} {}
    const value_type& operator*() const { return hit_; }
    const value_type* operator->() const { return &hit_; }
    friend bool operator==(const const_iterator& a, const const_iterator& b) { return a.hit_.second == b.hit_.second; }

   private:
    value_type hit_{0, none};
  };

  /// Prepares for `count` numbers between `low` and `high`; numbers outside are still accepted.
  void reserve(UserId low, UserId high, std::size_t count) {
    const auto span = static_cast<std::size_t>(high - low) + 1;
    if (size_ != 0 || high < low || span > 16 * count + slack) return;
    base_ = low;
    dense_.assign(span, none);
  }

  /// Index of `id`, or `none`.
  Index index(UserId id) const {
    const auto offset = static_cast<std::size_t>(id - base_);  // an id below the base wraps to a huge offset
    if (offset < dense_.size()) return dense_[offset];
    if (sparse_.empty()) return none;
    const auto hit = sparse_.find(id);
    return hit == sparse_.end() ? none : hit->second;
  }

  const_iterator find(UserId id) const {
    const Index i = index(id);
    return i == none ? end() : const_iterator(id, i);
  }
  const_iterator end() const { return {}; }
  bool contains(UserId id) const { return index(id) != none; }
  std::size_t count(UserId id) const { return contains(id) ? 1 : 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  Index at(UserId id) const {
    const Index i = index(id);
    if (i == none) throw std::out_of_range("no entry with the number " + std::to_string(id));
    return i;
  }

  /// Enters id -> index unless the number is taken; .second says whether it was entered.
  std::pair<const_iterator, bool> emplace(UserId id, Index i) {
    Index& place = slot(id);
    const bool fresh = place == none;
    if (fresh) {
      place = i;
      ++size_;
    }
    return {const_iterator(id, place), fresh};
  }

  /// Assignment target for id; a new entry counts even before it is assigned.
  Index& operator[](UserId id) {
    Index& place = slot(id);
    if (place == none) {
      ++size_;
      place = 0;
    }
    return place;
  }

 private:
  static constexpr std::size_t slack = 1u << 16;

  Index& slot(UserId id) {
    const auto offset = static_cast<std::size_t>(id - base_);
    if (offset < dense_.size()) return dense_[offset];
    const bool close = id >= base_ && offset < 4 * size_ + slack && !sparse_.contains(id);
    if (!close) return sparse_.try_emplace(id, none).first->second;
    dense_.resize(offset + offset / 2 + 1, none);
    // Numbers that were far away may now lie within the dense range.
    for (auto it = sparse_.begin(); it != sparse_.end();) {
      const auto o = static_cast<std::size_t>(it->first - base_);
      if (o < dense_.size()) {
        dense_[o] = it->second;
        it = sparse_.erase(it);
      } else {
        ++it;
      }
    }
    return dense_[offset];
  }

  UserId base_ = 0;
  std::size_t size_ = 0;
  std::vector<Index> dense_;
  std::unordered_map<UserId, Index> sparse_;
};

}  // namespace kardan

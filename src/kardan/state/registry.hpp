// The list of every mutable array: name, unit, shape, who writes it. The state hash and the restart file are made from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace kardan {

/// FNV-1a on 8-byte words, carried on from `h` (the tail byte by byte): byte-wise FNV would cost a second per gigabyte.
std::uint64_t fnv1a(std::uint64_t h, std::span<const std::byte> data);
inline constexpr std::uint64_t fnv1a_start = 14695981039346656037ULL;

/// Describes one registered array.
struct ArrayInfo {
  std::string name;    ///< e.g. "nodes.x"; no two arrays of a run have the same
  std::string unit;    ///< in terms of the deck's units: "length", "length/time", "1" …
  std::string writer;  ///< the stage of the step that writes it, e.g. "nodes.drift"
};

/// Holds views on the mutable arrays of a run; the owners register them once, after they are sized. Whatever the next step reads
/// of the steps before it must be here.
///   add, add_value, add_list     what the model is: part of the hash
///   keep, keep_value, keep_list  what else the next step, or a report, reads: lists of candidates, counters …; in restart files only
/// The size of a list may change in the run.
class Registry {
 public:
  struct Entry {
    ArrayInfo info;
    std::size_t item_bytes = 1;
    bool hashed = true;
    std::function<std::span<std::byte>()> bytes;
    std::function<void(std::size_t items)> resize;  ///< empty where the size is fixed
  };

  /// Registers a vector of trivially copyable items. The vector must outlive the registry's use.
  template <class T, class Allocator>
  void add(ArrayInfo info, std::vector<T, Allocator>& array) {
    put(std::move(info), array, true, false);
  }
  template <class T, class Allocator>
  void add_list(ArrayInfo info, std::vector<T, Allocator>& array) {
    put(std::move(info), array, true, true);
  }
  template <class T, class Allocator>
  void keep(ArrayInfo info, std::vector<T, Allocator>& array) {
    put(std::move(info), array, false, false);
  }
  template <class T, class Allocator>
  void keep_list(ArrayInfo info, std::vector<T, Allocator>& array) {
    put(std::move(info), array, false, true);
  }

  /// Registers one trivially copyable value.
  template <class T>
  void add_value(ArrayInfo info, T& value) {
    put_value(std::move(info), value, true);
  }
  template <class T>
  void keep_value(ArrayInfo info, T& value) {
    put_value(std::move(info), value, false);
  }

  /// f() is called when all arrays have been filled from a restart file: for what follows from them.
  void after_restore(std::function<void()> f) { after_restore_.push_back(std::move(f)); }
  /// The arrays have been filled.
  void restored() const {
    for (const auto& f : after_restore_) f();
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// FNV-1a over the names and the bytes of every array that was added, in the order of registration: equal for two runs only if
  /// every bit of every array is equal.
  std::uint64_t hash() const;

 private:
  template <class T, class Allocator>
  void put(ArrayInfo info, std::vector<T, Allocator>& array, bool hashed, bool varies) {
    static_assert(std::is_trivially_copyable_v<T>);
    Entry entry{std::move(info), sizeof(T), hashed, [&array] { return std::as_writable_bytes(std::span<T>(array)); }, {}};
    if (varies) entry.resize = [&array](std::size_t items) { array.resize(items); };
    entries_.push_back(std::move(entry));
  }
  template <class T>
  void put_value(ArrayInfo info, T& value, bool hashed) {
    static_assert(std::is_trivially_copyable_v<T>);
    entries_.push_back({std::move(info), sizeof(T), hashed, [&value] { return std::as_writable_bytes(std::span<T>(&value, 1)); }, {}});
  }

  std::vector<Entry> entries_;
  std::vector<std::function<void()>> after_restore_;
};

}  // namespace kardan

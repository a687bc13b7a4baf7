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

/// Describes one registered array.
struct ArrayInfo {
  std::string name;    ///< e.g. "nodes.x"
  std::string unit;    ///< in terms of the deck's units: "length", "length/time", "1" …
  std::string writer;  ///< the stage of the step that writes it, e.g. "nodes.drift"
};

/// Holds views on the mutable arrays of a run; the owners register them once, after they are sized.
class Registry {
 public:
  struct Entry {
    ArrayInfo info;
    std::function<std::span<std::byte>()> bytes;
  };

  /// Registers a vector of trivially copyable items. The vector must outlive the registry's use.
  template <class T, class Allocator>
  void add(ArrayInfo info, std::vector<T, Allocator>& array) {
    static_assert(std::is_trivially_copyable_v<T>);
    entries_.push_back({std::move(info), [&array] { return std::as_writable_bytes(std::span<T>(array)); }});
  }

  /// Registers one trivially copyable value.
  template <class T>
  void add_value(ArrayInfo info, T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    entries_.push_back({std::move(info), [&value] { return std::as_writable_bytes(std::span<T>(&value, 1)); }});
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// FNV-1a over the names and the bytes of every array, in the order of registration: equal for two runs only if every
  /// bit of every array is equal.
  std::uint64_t hash() const;

 private:
  std::vector<Entry> entries_;
};

}  // namespace kardan

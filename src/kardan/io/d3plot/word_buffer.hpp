// The stream of equal words a d3plot is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kardan/base/vec3.hpp"

namespace kardan {

class WordBuffer {
 public:
  /// Words of 4 or 8 bytes.
  explicit WordBuffer(int word_bytes) : word_(static_cast<std::size_t>(word_bytes)) {}

  void integer(std::int64_t value) {
    if (word_ == 8) return raw(&value, 8);
    const auto narrow = static_cast<std::int32_t>(value);
    raw(&narrow, 4);
  }
  void real(double value) {
    if (word_ == 8) return raw(&value, 8);
    const auto narrow = static_cast<float>(value);
    raw(&narrow, 4);
  }
  void vector(const Vec3& v) {
    real(v.x);
    real(v.y);
    real(v.z);
  }
  void zeros(std::size_t words) { bytes_.resize(bytes_.size() + words * word_); }
  /// Exactly `bytes` characters: cut, or filled with blanks.
  void text(std::string_view t, std::size_t bytes) {
    const std::size_t taken = t.size() < bytes ? t.size() : bytes;
    raw(t.data(), taken);
    bytes_.resize(bytes_.size() + bytes - taken, std::byte{' '});
  }

  std::size_t word_bytes() const { return word_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  void raw(const void* data, std::size_t n) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + n);
  }

  std::size_t word_;
  std::vector<std::byte> bytes_;
};

}  // namespace kardan

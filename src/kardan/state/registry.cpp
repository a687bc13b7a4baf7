#include "kardan/state/registry.hpp"

#include <cstring>

namespace kardan {

namespace {

constexpr std::uint64_t fnv_prime = 1099511628211ULL;

/// FNV-1a on 8-byte words (the tail byte by byte): byte-wise FNV would cost a second per gigabyte.
std::uint64_t fnv1a(std::uint64_t h, std::span<const std::byte> data) {
  std::size_t i = 0;
  for (; i + 8 <= data.size(); i += 8) {
    std::uint64_t word;
    std::memcpy(&word, data.data() + i, 8);
    h = (h ^ word) * fnv_prime;
    h ^= h >> 29;
  }
  for (; i < data.size(); ++i) h = (h ^ static_cast<std::uint64_t>(data[i])) * fnv_prime;
  return h;
}

}  // namespace

std::uint64_t Registry::hash() const {
  std::uint64_t h = 14695981039346656037ULL;
  for (const Entry& entry : entries_) {
    h = fnv1a(h, std::as_bytes(std::span(entry.info.name.data(), entry.info.name.size())));
    h = fnv1a(h, entry.bytes());
  }
  return h;
}

}  // namespace kardan

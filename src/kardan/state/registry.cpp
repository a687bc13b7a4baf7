#include "kardan/state/registry.hpp"

#include <cstring>

namespace kardan {

namespace {

constexpr std::uint64_t fnv_prime = 1099511628211ULL;

}  // namespace

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

std::uint64_t Registry::hash() const {
  std::uint64_t h = fnv1a_start;
  for (const Entry& entry : entries_) {
    if (!entry.hashed) continue;
    h = fnv1a(h, std::as_bytes(std::span(entry.info.name.data(), entry.info.name.size())));
    h = fnv1a(h, entry.bytes());
  }
  return h;
}

}  // namespace kardan

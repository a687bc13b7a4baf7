// A restart file: the arrays of a registry, and a head in JSON that says which run they belong to.
//
// Layout, little endian. 8 bytes "KARDANRS", 4 bytes format version, 4 bytes 0; then records:
//   u32 length of the name, u32 bytes of an item, u64 items, u64 stored bytes, u64 check, name, stored bytes
// The stored bytes are one zstd frame with its own checksum (XXH64); `check` is FNV-1a over the record but for itself, stored bytes included.
// The first record, "head", is the JSON text; then comes one for each array, in the order of the registry; the last, "end", has no bytes
// and as its items the number of records before it: a file without it is incomplete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kardan/state/registry.hpp"

namespace kardan {

/// Writes to `path` with ".tmp" behind it, brings it onto the disk and renames it: under `path` there is a whole file or none.
/// @return its size in bytes. @throws RunError; the unfinished file is gone then
std::int64_t write_checkpoint(const std::filesystem::path& path, const nlohmann::json& head, const Registry& registry);

/// A restart file that has been read and whose checks hold.
class CheckpointFile {
 public:
  /// @throws RunError that says what is wrong with the file
  explicit CheckpointFile(const std::filesystem::path& path);

  const nlohmann::json& head() const { return head_; }
  /// Fills the arrays. @throws RunError naming an array that the file does not have, or has in another shape; nothing is changed then
  void restore(const Registry& registry) const;

 private:
  struct Record {
    std::string name;
    std::size_t item_bytes = 0, items = 0;
    std::size_t offset = 0, stored = 0;  ///< into text_
  };
  Record read_record(std::size_t& position) const;
  void unpack(const Record& record, std::byte* to) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::vector<char> text_;
  std::vector<Record> arrays_;
  nlohmann::json head_;
};

}  // namespace kardan

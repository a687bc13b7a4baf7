// LSDA, the container of LS-DYNA's binout: a tree of folders with typed arrays, written append-only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/io/file_sink.hpp"

namespace kardan {

/// Layout (LSTC's LSDA, as its published readers read it): an 8-byte file header; then records, each a length of 8
/// bytes that counts the whole record, a command of 1 byte, and a body. Data records hold type, name and values; a
/// symbol table lists the data records of a stretch of the file and ends with the offset of the next table. Little
/// endian.
class LsdaWriter {
 public:
  explicit LsdaWriter(std::filesystem::path path);
  /// Goes on where mark() was taken.
  LsdaWriter(std::filesystem::path path, const nlohmann::json& mark);

  /// Makes `folder` (absolute, e.g. "/glstat/d000001") the place of the arrays written next.
  void cd(std::string folder);
  void write(std::string_view name, std::span<const double> values);
  /// 32-bit integers where every value fits, else 64-bit ones.
  void write(std::string_view name, std::span<const std::int64_t> values);
  void write(std::string_view name, std::string_view text);

  /// Writes the symbol table of everything since the last call and links it: only then do readers see it.
  void flush();
  /// After flush().
  nlohmann::json mark() const;
  void sync() { file_.sync(); }

 private:
  enum class Type : std::uint8_t { text = 1, int32 = 3, int64 = 4, real64 = 10 };
  struct Symbol {
    std::string folder, name;
    Type type;
    std::int64_t offset, count;
  };

  void record_head(std::int64_t length, std::uint8_t command);
  void data_record(std::string_view name, Type type, std::span<const std::byte> values, std::int64_t count);

  FileSink file_;
  std::string folder_ = "/";
  bool folder_written_ = false;
  std::vector<Symbol> pending_;
  std::int64_t link_;  ///< where the offset of the next symbol table belongs
};

}  // namespace kardan

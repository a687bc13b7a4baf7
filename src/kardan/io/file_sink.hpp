// A binary or text file being written, whose every failure becomes a RunError with path and reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace kardan {

class FileSink {
 public:
  /// Creates or empties the file. @throws RunError if that is refused.
  explicit FileSink(std::filesystem::path path);

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Next write goes to `offset` bytes from the start (0 <= offset <= size()).
  void seek(std::int64_t offset);
  std::int64_t position() const { return position_; }
  std::int64_t size() const { return size_; }
  /// Hands everything written so far to the operating system: what a killed run leaves is readable up to here.
  void flush();

  const std::filesystem::path& path() const { return path_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::int64_t position_ = 0, size_ = 0;
};

}  // namespace kardan

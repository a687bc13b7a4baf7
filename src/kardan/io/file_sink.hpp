// A binary or text file being written, whose every failure becomes a RunError with path and reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace kardan {

/// What has been flushed stays as it is if a later write fails (a full disk, a quota): the file is cut back to its size of the last
/// flush before the error is thrown, and a file that was never flushed is removed.
class FileSink {
 public:
  /// Creates or empties the file. @throws RunError if that is refused.
  explicit FileSink(std::filesystem::path path);
  /// Goes on behind the first `size` bytes of a file that is there; what follows them is cut off.
  /// @throws RunError if the file is missing or shorter.
  FileSink(std::filesystem::path path, std::int64_t size);
  FileSink(const FileSink&) = delete;
  FileSink(FileSink&& other) noexcept;
  FileSink& operator=(FileSink&& other) noexcept;
  ~FileSink();

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Next write goes to `offset` bytes from the start (0 <= offset <= size()).
  void seek(std::int64_t offset);
  std::int64_t position() const { return position_; }
  std::int64_t size() const { return size_; }
  /// Hands everything written so far to the operating system: what a killed run leaves is readable up to here.
  void flush();
  /// flush(), and the data are on the disk: what is there after a power cut.
  void sync();

  const std::filesystem::path& path() const { return path_; }

 private:
  void write_out();
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;      ///< belongs before position_
  std::int64_t position_ = 0, size_ = 0;
  std::int64_t flushed_ = 0;           ///< size at the last flush
  bool fresh_ = true;                  ///< nothing of it has been flushed
  int failure_ = 0;                    ///< errno of the write that failed: nothing is written any more
};

/// A file that was written and closed is on the disk. @throws RunError
void sync_file(const std::filesystem::path& path);
/// The entries of a folder are on the disk: files that were created, renamed or removed. @throws RunError
void sync_folder(const std::filesystem::path& folder);

}  // namespace kardan

#include "kardan/io/file_sink.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;

/// Writes all of it at `offset`; 0 or errno.
int write_fully(int descriptor, const std::byte* data, std::size_t bytes, std::int64_t offset) {
  while (bytes > 0) {
    const ssize_t written = ::pwrite(descriptor, data, bytes, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    data += written;
    bytes -= static_cast<std::size_t>(written);
    offset += written;
  }
  return 0;
}

}  // namespace

FileSink::FileSink(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail(errno);
}

FileSink::FileSink(std::filesystem::path path, std::int64_t size)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)), position_(size), size_(size), flushed_(size), fresh_(false) {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) fail(errno);
  if (status.st_size >= size && ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  descriptor_ = -1;
  if (status.st_size < size) throw RunError("the result file " + path_.string() + " is shorter than it was when the restart file was written");
  fail(error);
}

FileSink::FileSink(FileSink&& other) noexcept { *this = std::move(other); }

FileSink& FileSink::operator=(FileSink&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(buffer_, other.buffer_);
  std::swap(position_, other.position_);
  std::swap(size_, other.size_);
  std::swap(flushed_, other.flushed_);
  std::swap(fresh_, other.fresh_);
  std::swap(failure_, other.failure_);
  return *this;
}

FileSink::~FileSink() {
  if (descriptor_ < 0) return;
  if (failure_ == 0) write_fully(descriptor_, buffer_.data(), buffer_.size(), position_ - static_cast<std::int64_t>(buffer_.size()));
  ::close(descriptor_);
}

void FileSink::write(const void* data, std::size_t bytes) {
  if (failure_ != 0) fail(failure_);
  if (bytes == 0) return;
  const auto* first = static_cast<const std::byte*>(data);
  if (buffer_.size() + bytes > buffer_bytes) write_out();
  if (bytes >= buffer_bytes) {
    if (const int error = write_fully(descriptor_, first, bytes, position_)) fail(error);
  } else {
    buffer_.insert(buffer_.end(), first, first + bytes);
  }
  position_ += static_cast<std::int64_t>(bytes);
  size_ = std::max(size_, position_);
}

void FileSink::seek(std::int64_t offset) {
  if (offset == position_) return;
  write_out();
  position_ = offset;
}

void FileSink::write_out() {
  if (failure_ != 0) fail(failure_);
  if (const int error = write_fully(descriptor_, buffer_.data(), buffer_.size(), position_ - static_cast<std::int64_t>(buffer_.size()))) fail(error);
  buffer_.clear();
}

void FileSink::flush() {
  write_out();
  flushed_ = size_;
  fresh_ = false;
}

void FileSink::sync() {
  flush();
  // Pipes and the like have nothing to synchronise.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
}

void FileSink::fail(int error) {
  if (failure_ == 0 && descriptor_ >= 0) {
    buffer_.clear();
    size_ = position_ = flushed_;
    if (::ftruncate(descriptor_, static_cast<off_t>(flushed_)) == 0 && fresh_) ::unlink(path_.c_str());
  }
  failure_ = error;
  throw RunError("cannot write the result file " + path_.string() + ": " + std::strerror(error));
}

namespace {

void sync_path(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  const bool good = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS);
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!good) throw RunError("cannot bring " + path.string() + " onto the disk: " + std::strerror(error));
}

}  // namespace

void sync_file(const std::filesystem::path& path) { sync_path(path, 0); }
void sync_folder(const std::filesystem::path& folder) { sync_path(folder, O_DIRECTORY); }

}  // namespace kardan

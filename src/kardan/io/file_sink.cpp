#include "kardan/io/file_sink.hpp"

#include <sys/types.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

FileSink::FileSink(std::filesystem::path path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
  if (!file_) fail(errno);
}

void FileSink::write(const void* data, std::size_t bytes) {
  if (bytes == 0) return;
  if (std::fwrite(data, 1, bytes, file_.get()) != bytes) fail(errno);
  position_ += static_cast<std::int64_t>(bytes);
  size_ = std::max(size_, position_);
}

void FileSink::seek(std::int64_t offset) {
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0) fail(errno);
  position_ = offset;
}

void FileSink::flush() {
  if (std::fflush(file_.get()) != 0) fail(errno);
}

void FileSink::fail(int error) const {
  throw RunError("cannot write the result file " + path_.string() + ": " + std::strerror(error));
}

}  // namespace kardan

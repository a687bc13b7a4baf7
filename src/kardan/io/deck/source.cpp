#include "kardan/io/deck/source.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace kardan::deck {

SourceFile::~SourceFile() {
  if (mapped_ != nullptr) munmap(mapped_, mapped_size_);
}

void SourceFile::set_text(std::string_view all) {
  if (all.starts_with("\xEF\xBB\xBF")) all.remove_prefix(3);  // UTF-8 byte order mark
  text = all;
}

std::shared_ptr<const SourceFile> SourceFile::open(const std::filesystem::path& path, std::string name,
                                                   std::string& problem) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe must not make it wait
  if (descriptor < 0) {
    problem = std::strerror(errno);
    return nullptr;
  }
  auto file = std::make_shared<SourceFile>();
  file->name = std::move(name);
  struct stat status {};
  if (fstat(descriptor, &status) != 0) {
    problem = std::strerror(errno);
  } else if (S_ISDIR(status.st_mode)) {
    problem = "it is a folder";
  } else if (!S_ISREG(status.st_mode)) {
    problem = "it is not a plain file";
  } else if (status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (mapped == MAP_FAILED) {
      problem = std::strerror(errno);
    } else {
      madvise(mapped, size, MADV_SEQUENTIAL);
      file->mapped_ = mapped;
      file->mapped_size_ = size;
      file->set_text({static_cast<const char*>(mapped), size});
    }
  }
  close(descriptor);
  if (!problem.empty()) return nullptr;
  return file;
}

std::shared_ptr<const SourceFile> SourceFile::from_text(std::string text, std::string name) {
  auto file = std::make_shared<SourceFile>();
  file->name = std::move(name);
  file->owned_ = std::move(text);
  file->set_text(file->owned_);
  return file;
}

}  // namespace kardan::deck

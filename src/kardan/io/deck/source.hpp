// The text of one file of a deck, mapped into memory.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace kardan::deck {

struct SourceFile {
  std::string name;  ///< as shown in messages
  std::string_view text;

  SourceFile() = default;
  SourceFile(const SourceFile&) = delete;
  SourceFile& operator=(const SourceFile&) = delete;
  ~SourceFile();

  /// Maps a file; nullptr with the reason in `problem` if it cannot be read.
  static std::shared_ptr<const SourceFile> open(const std::filesystem::path& path, std::string name,
                                                std::string& problem);
  static std::shared_ptr<const SourceFile> from_text(std::string text, std::string name);

 private:
  void set_text(std::string_view all);
  std::string owned_;
  void* mapped_ = nullptr;
  std::size_t mapped_size_ = 0;
};

}  // namespace kardan::deck

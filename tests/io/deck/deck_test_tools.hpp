// What the reader's tests share: decks in memory and in temporary folders, and looking for messages.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "kardan/io/deck/deck.hpp"

namespace kardan::deck::test {

/// A deck in memory with its messages. Not copyable, since blocks report into `diagnostics`.
struct Read {
  Diagnostics diagnostics;
  Deck deck;
  explicit Read(const std::string& text, const ReadOptions& options = {}) {
    deck = read_deck_text(text, "deck.k", {}, options, diagnostics);
  }
  explicit Read(const char* text, const ReadOptions& options = {}) : Read(std::string(text), options) {}
  explicit Read(const std::filesystem::path& path, const ReadOptions& options = {}) {
    deck = read_deck(path, options, diagnostics);
  }
  Read(const Read&) = delete;
  Read& operator=(const Read&) = delete;

  Block& block(std::size_t i) { return deck.blocks.at(i); }
  std::string messages() const {
    std::string text;
    for (const Diagnostic& d : diagnostics.all()) text += to_string(d) + "\n";
    return text;
  }
};

/// The first message of a severity that contains `part`; nullptr if there is none.
inline const Diagnostic* find_message(const Diagnostics& diagnostics, Severity severity, std::string_view part) {
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == severity && (d.message.find(part) != std::string::npos || d.cure.find(part) != std::string::npos))
      return &d;
  return nullptr;
}

/// A folder that is removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kardan_deck_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace kardan::deck::test

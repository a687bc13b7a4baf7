// What the program says: on the terminal, and the same in a file beside the results.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include "kardan/base/diagnostics.hpp"

namespace kardan::app {

class Log {
 public:
  /// @param terminal whether `out` is one: only there a live line is redrawn in place
  Log(std::ostream& out, std::ostream& err, bool terminal) : out_(out), err_(err), terminal_(terminal) {}

  /// From now on everything is also written to `path`, behind what it holds where `append`. @throws RunError if it cannot be.
  void open_file(const std::filesystem::path& path, bool append = false);

  void line(const std::string& text);
  /// Goes to standard error.
  void error(const std::string& text);
  /// Notices and warnings to standard output, errors to standard error; those from `first` on.
  void diagnostics(const Diagnostics& diagnostics, std::size_t first = 0);
  /// Redraws the live line; only on a terminal, never in the file.
  void live(const std::string& text);
  bool terminal() const { return terminal_; }

 private:
  void clear_live();

  std::ostream& out_;
  std::ostream& err_;
  std::ofstream file_;
  bool terminal_ = false;
  std::size_t live_width_ = 0;
};

}  // namespace kardan::app

// The ASCII time-history files in LS-DYNA's layouts.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "kardan/io/file_sink.hpp"
#include "kardan/io/run_label.hpp"
#include "kardan/io/tables/snapshot.hpp"

namespace kardan {

/// One file: head (title, version, date, legend), then a block for each output.
class AsciiWriter {
 public:
  AsciiWriter(std::filesystem::path path, RunLabel label);
  /// Goes on where mark() was taken.
  AsciiWriter(std::filesystem::path path, RunLabel label, const nlohmann::json& mark);

  /// Appends one output of the file this writer was made for and flushes it.
  void write(const Snapshot& snapshot) { append(snapshot, text_of(snapshot)); }
  /// Appends the joints' separations (Kardan's file `jntsep`) and flushes them.
  void write_separations(const Snapshot& jntforc);

  nlohmann::json mark() const;
  void sync() { file_.sync(); }

 private:
  static std::string text_of(const Snapshot& snapshot);
  void append(const Snapshot& snapshot, const std::string& text);

  FileSink file_;
  RunLabel label_;
  bool headed_ = false;
};

/// The layouts, one output each.
std::string glstat_text(const Snapshot& s);
std::string matsum_text(const Snapshot& s);
std::string nodout_text(const Snapshot& s);
std::string rbdout_text(const Snapshot& s);
std::string jntforc_text(const Snapshot& s);
std::string jntsep_text(const Snapshot& s);
std::string bndout_text(const Snapshot& s);
std::string spcforc_text(const Snapshot& s);
std::string rwforc_text(const Snapshot& s);
std::string swforc_text(const Snapshot& s);
std::string deforc_text(const Snapshot& s);
std::string secforc_text(const Snapshot& s);
std::string elout_text(const Snapshot& s);
std::string rcforc_text(const Snapshot& s);
std::string sleout_text(const Snapshot& s);
std::string ncforc_text(const Snapshot& s);

}  // namespace kardan

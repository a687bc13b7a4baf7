// The binout file: time histories in LS-DYNA's tree and names, reals in 8 bytes.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "kardan/io/binout/lsda_writer.hpp"
#include "kardan/io/run_label.hpp"
#include "kardan/io/tables/snapshot.hpp"

namespace kardan {

class BinoutWriter {
 public:
  BinoutWriter(std::filesystem::path path, RunLabel label);
  /// Goes on where mark() was taken.
  BinoutWriter(std::filesystem::path path, RunLabel label, const nlohmann::json& mark);

  /// Appends one output; the first of a folder writes its metadata before.
  void write(const Snapshot& snapshot);
  /// Makes what was written visible to readers.
  void flush() { file_.flush(); }
  /// After flush().
  nlohmann::json mark() const;
  void sync() { file_.sync(); }

 private:
  void write_metadata(const Folder& folder);

  LsdaWriter file_;
  RunLabel label_;
  std::map<std::string, int> states_;  ///< outputs so far by folder
};

}  // namespace kardan

#include "kardan/io/binout/binout_writer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace kardan {

BinoutWriter::BinoutWriter(std::filesystem::path path, RunLabel label)
    : file_(std::move(path)), label_(std::move(label)) {}

BinoutWriter::BinoutWriter(std::filesystem::path path, RunLabel label, const nlohmann::json& mark)
    : file_(std::move(path), mark.at("file")), label_(std::move(label)), states_(mark.at("states").get<std::map<std::string, int>>()) {}

nlohmann::json BinoutWriter::mark() const { return {{"file", file_.mark()}, {"states", states_}}; }

void BinoutWriter::write_metadata(const Folder& folder) {
  constexpr std::size_t title_width = 80;
  file_.cd(folder.path + "/metadata");
  file_.write("title", padded(label_.title, title_width));
  file_.write("version", padded(label_.version, 12));
  file_.write("revision", padded("0", 10));
  file_.write("date", padded(label_.date, 10));
  for (const auto& [name, text] : folder.text_metadata) file_.write(name, std::string_view(text));
  for (const IntegerColumn& c : folder.metadata) file_.write(c.name, c.values);
  if (folder.legend.empty()) return;
  std::string titles;
  for (const std::string& t : folder.legend) titles += padded(t, title_width);
  file_.write("legend_ids", folder.legend_ids);
  file_.write("legend", std::string_view(titles));
}

void BinoutWriter::write(const Snapshot& snapshot) {
  for (const Folder& folder : snapshot.folders) {
    const int number = ++states_[folder.path];
    if (number == 1) write_metadata(folder);
    file_.cd(fmt::format("{}/d{:06d}", folder.path, number));
    file_.write("time", std::span<const double>(&snapshot.time, 1));
    for (const IntegerColumn& c : folder.integers) file_.write(c.name, c.values);
    for (const RealColumn& c : folder.columns) file_.write(c.name, c.values);
  }
}

}  // namespace kardan

#include "kardan/io/binout/lsda_writer.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

static_assert(std::endian::native == std::endian::little, "the writers put native words into little-endian files");

constexpr std::int64_t length_size = 8, command_size = 1, type_size = 1, offset_size = 8, name_length_size = 1;
constexpr std::int64_t head_size = length_size + command_size;

enum Command : std::uint8_t {
  cd_command = 2,
  data = 3,
  variable = 4,
  begin_table = 5,
  end_table = 6,
  table_offset = 7
};

}  // namespace

LsdaWriter::LsdaWriter(std::filesystem::path path) : file_(std::move(path)) {
  // Sizes of header, lengths, offsets, commands, types; 1 = little endian; 0 = IEEE floating point.
  const std::uint8_t header[8] = {8, length_size, offset_size, command_size, type_size, 1, 0, 0};
  file_.write(header, sizeof header);
  record_head(head_size + offset_size, table_offset);
  link_ = file_.position();
  const std::int64_t no_table = 0;
  file_.write(&no_table, sizeof no_table);
}

LsdaWriter::LsdaWriter(std::filesystem::path path, const nlohmann::json& mark)
    : file_(std::move(path), mark.at("size").get<std::int64_t>()),
      folder_(mark.at("folder").get<std::string>()),
      folder_written_(mark.at("folder_written").get<bool>()),
      link_(mark.at("link").get<std::int64_t>()) {
  // The killed run may have linked a table that has been cut off.
  const std::int64_t no_table = 0;
  file_.seek(link_);
  file_.write(&no_table, sizeof no_table);
  file_.seek(file_.size());
  file_.flush();
}

nlohmann::json LsdaWriter::mark() const {
  KARDAN_ASSERT(pending_.empty());
  return {{"size", file_.size()}, {"folder", folder_}, {"folder_written", folder_written_}, {"link", link_}};
}

void LsdaWriter::cd(std::string folder) {
  folder_ = std::move(folder);
  folder_written_ = false;
}

void LsdaWriter::write(std::string_view name, std::span<const double> values) {
  data_record(name, Type::real64, std::as_bytes(values), static_cast<std::int64_t>(values.size()));
}

void LsdaWriter::write(std::string_view name, std::span<const std::int64_t> values) {
  const auto fits = [](std::int64_t v) {
    return v >= std::numeric_limits<std::int32_t>::min() && v <= std::numeric_limits<std::int32_t>::max();
  };
  const auto count = static_cast<std::int64_t>(values.size());
  if (!std::all_of(values.begin(), values.end(), fits))
    return data_record(name, Type::int64, std::as_bytes(values), count);
  std::vector<std::int32_t> narrow;
  narrow.reserve(values.size());
  for (const std::int64_t v : values) narrow.push_back(static_cast<std::int32_t>(v));
  data_record(name, Type::int32, std::as_bytes(std::span<const std::int32_t>(narrow)), count);
}

void LsdaWriter::write(std::string_view name, std::string_view text) {
  data_record(name, Type::text, std::as_bytes(std::span(text.data(), text.size())),
              static_cast<std::int64_t>(text.size()));
}

void LsdaWriter::flush() {
  if (pending_.empty()) return;
  const std::int64_t start = file_.size();
  file_.seek(start);
  record_head(0, begin_table);  // its length is known at the end
  const std::string* folder = nullptr;
  for (const Symbol& s : pending_) {
    if (folder == nullptr || *folder != s.folder) {
      folder = &s.folder;
      record_head(head_size + static_cast<std::int64_t>(s.folder.size()), cd_command);
      file_.write(s.folder);
    }
    record_head(head_size + static_cast<std::int64_t>(s.name.size()) + type_size + offset_size + length_size, variable);
    file_.write(s.name);
    file_.write(&s.type, 1);
    file_.write(&s.offset, sizeof s.offset);
    file_.write(&s.count, sizeof s.count);
  }
  record_head(head_size + offset_size, end_table);
  const std::int64_t next_link = file_.position();
  const std::int64_t no_table = 0;
  file_.write(&no_table, sizeof no_table);
  const std::int64_t length = file_.position() - start;
  file_.seek(start);
  file_.write(&length, sizeof length);
  file_.flush();  // the table is complete on disk before anything points to it
  file_.seek(link_);
  file_.write(&start, sizeof start);
  file_.seek(file_.size());
  file_.flush();
  link_ = next_link;
  pending_.clear();
}

void LsdaWriter::record_head(std::int64_t length, std::uint8_t command) {
  file_.write(&length, sizeof length);
  file_.write(&command, sizeof command);
}

void LsdaWriter::data_record(std::string_view name, Type type, std::span<const std::byte> values, std::int64_t count) {
  KARDAN_ASSERT(name.size() < 256);
  if (!folder_written_) {
    record_head(head_size + static_cast<std::int64_t>(folder_.size()), cd_command);
    file_.write(folder_);
    folder_written_ = true;
  }
  const std::int64_t offset = file_.position();
  const auto name_length = static_cast<std::uint8_t>(name.size());
  record_head(head_size + type_size + name_length_size + static_cast<std::int64_t>(name.size() + values.size()), data);
  file_.write(&type, 1);
  file_.write(&name_length, 1);
  file_.write(name);
  file_.write(values.data(), values.size());
  pending_.push_back({folder_, std::string(name), type, offset, count});
}

}  // namespace kardan

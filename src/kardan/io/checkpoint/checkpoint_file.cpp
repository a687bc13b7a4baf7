#include "kardan/io/checkpoint/checkpoint_file.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>

#include "kardan/base/diagnostics.hpp"
#include "kardan/io/file_sink.hpp"

namespace kardan {

namespace {

static_assert(std::endian::native == std::endian::little, "the file is little endian");

constexpr char magic[8] = {'K', 'A', 'R', 'D', 'A', 'N', 'R', 'S'};
constexpr std::uint32_t format_version = 1;
constexpr int compression_level = 1;  ///< states are nearly random bits: higher levels take time and gain little

/// What stands before the name of a record.
struct RecordHead {
  std::uint32_t name_length = 0, item_bytes = 0;
  std::uint64_t items = 0, stored = 0, check = 0;
};
static_assert(sizeof(RecordHead) == 32);

std::uint64_t check_of(RecordHead head, std::span<const char> name, std::span<const char> stored) {
  head.check = 0;
  std::uint64_t h = fnv1a(fnv1a_start, std::as_bytes(std::span(&head, 1)));
  h = fnv1a(h, std::as_bytes(name));
  return fnv1a(h, std::as_bytes(stored));
}

class RecordWriter {
 public:
  explicit RecordWriter(FileSink& file) : file_(file), context_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
    KARDAN_ASSERT(context_ != nullptr);
    ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, compression_level);
    ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1);
  }

  void write(const std::string& name, std::size_t item_bytes, std::span<const std::byte> bytes) {
    stored_.resize(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress2(context_.get(), stored_.data(), stored_.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size)) throw RunError(fmt::format("cannot compress {} for the restart file: {}", name, ZSTD_getErrorName(size)));
    stored_.resize(size);
    put(name, item_bytes, bytes.size() / item_bytes);
    ++records_;
  }
  void end() {
    stored_.clear();
    put("end", 1, records_);
  }

 private:
  void put(const std::string& name, std::size_t item_bytes, std::size_t items) {
    RecordHead head{static_cast<std::uint32_t>(name.size()), static_cast<std::uint32_t>(item_bytes), items, stored_.size(), 0};
    head.check = check_of(head, name, stored_);
    file_.write(&head, sizeof head);
    file_.write(name);
    file_.write(stored_.data(), stored_.size());
  }

  FileSink& file_;
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
  std::vector<char> stored_;
  std::uint64_t records_ = 0;
};

}  // namespace

std::int64_t write_checkpoint(const std::filesystem::path& path, const nlohmann::json& head, const Registry& registry) {
  const std::filesystem::path unfinished = path.string() + ".tmp";
  try {
    FileSink file(unfinished);
    file.write(magic, sizeof magic);
    const std::uint32_t version[2] = {format_version, 0};
    file.write(version, sizeof version);
    RecordWriter records(file);
    const std::string text = head.dump();
    records.write("head", 1, std::as_bytes(std::span(text)));
    for (const Registry::Entry& entry : registry.entries()) records.write(entry.info.name, entry.item_bytes, entry.bytes());
    records.end();
    file.sync();
    const std::int64_t size = file.size();
    std::filesystem::rename(unfinished, path);
    sync_folder(path.parent_path());
    return size;
  } catch (const std::filesystem::filesystem_error& error) {
    throw RunError(fmt::format("cannot rename {}: {}", unfinished.string(), error.code().message()));
  }
}

void CheckpointFile::fail(const std::string& what) const { throw RunError(fmt::format("{}: {}", path_.string(), what)); }

CheckpointFile::CheckpointFile(const std::filesystem::path& path) : path_(path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) fail("cannot be read");
  text_.resize(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  if (!file.read(text_.data(), static_cast<std::streamsize>(text_.size()))) fail("cannot be read");
  std::uint32_t version = 0;
  if (text_.size() < sizeof magic + 8 || std::memcmp(text_.data(), magic, sizeof magic) != 0) fail("is not a restart file of Kardan");
  std::memcpy(&version, text_.data() + sizeof magic, sizeof version);
  if (version != format_version) fail(fmt::format("has format {}; this version of Kardan reads format {}", version, format_version));
  std::size_t position = sizeof magic + 8;
  const Record first = read_record(position);
  std::string text(first.items, '\0');
  if (first.name != "head" || first.item_bytes != 1) fail("does not begin with a head");
  unpack(first, reinterpret_cast<std::byte*>(text.data()));
  for (Record record = read_record(position); record.name != "end"; record = read_record(position)) arrays_.push_back(std::move(record));
  head_ = nlohmann::json::parse(text, nullptr, false);
  if (head_.is_discarded()) fail("has a head that is not JSON");
}

CheckpointFile::Record CheckpointFile::read_record(std::size_t& position) const {
  RecordHead head;
  const auto left = [&] { return text_.size() - position; };
  if (left() < sizeof head) fail("is incomplete");
  std::memcpy(&head, text_.data() + position, sizeof head);
  position += sizeof head;
  if (left() < head.name_length || left() - head.name_length < head.stored) fail("is incomplete or damaged");
  const std::span<const char> name(text_.data() + position, head.name_length);
  position += head.name_length;
  const std::span<const char> stored(text_.data() + position, head.stored);
  if (check_of(head, name, stored) != head.check) fail(fmt::format("is damaged near byte {}", position));
  Record record{std::string(name.begin(), name.end()), head.item_bytes, head.items, position, head.stored};
  position += head.stored;
  if (record.name == "end" && head.items != arrays_.size() + 1) fail("is incomplete");
  return record;
}

void CheckpointFile::unpack(const Record& record, std::byte* to) const {
  const std::size_t bytes = record.items * record.item_bytes;
  const std::size_t size = ZSTD_decompress(to, bytes, text_.data() + record.offset, record.stored);
  if (ZSTD_isError(size)) fail(fmt::format("is damaged in \"{}\": {}", record.name, ZSTD_getErrorName(size)));
  if (size != bytes) fail(fmt::format("is damaged in \"{}\"", record.name));
}

void CheckpointFile::restore(const Registry& registry) const {
  const auto& entries = registry.entries();
  const char* const other = "; it was written by another build of Kardan";
  if (entries.size() != arrays_.size()) fail(fmt::format("holds {} arrays, the run has {}{}", arrays_.size(), entries.size(), other));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Registry::Entry& entry = entries[i];
    const Record& record = arrays_[i];
    if (entry.info.name != record.name) fail(fmt::format("has the array \"{}\" where the run has \"{}\"{}", record.name, entry.info.name, other));
    const std::size_t items = entry.bytes().size() / entry.item_bytes;
    if (entry.item_bytes != record.item_bytes || (!entry.resize && items != record.items))
      fail(fmt::format("holds {} items of {} bytes of \"{}\", the run has {} of {}{}", record.items, record.item_bytes, record.name, items,
                       entry.item_bytes, other));
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].resize) entries[i].resize(arrays_[i].items);
    unpack(arrays_[i], entries[i].bytes().data());
  }
  registry.restored();
}

}  // namespace kardan

// *INCLUDE, _PATH, _TRANSFORM.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kardan/io/deck/deck_reader.hpp"

namespace kardan::deck {

namespace fs = std::filesystem;

namespace {

std::string without_quotes(std::string_view name) {
  if (name.size() > 1 && (name[0] == '"' || name[0] == '\'') && name.back() == name[0])
    name = name.substr(1, name.size() - 2);
  return std::string(name);
}

/// &name within a file name, where the parameter is defined.
std::string substituted(std::string name, const ParameterView& view) {
  for (std::size_t at = name.find('&'); at != std::string::npos; at = name.find('&', at + 1)) {
    std::size_t end = at + 1;
    while (end < name.size() && (std::isalnum(static_cast<unsigned char>(name[end])) || name[end] == '_')) ++end;
    const ParameterValue* value = view.find(std::string_view(name).substr(at + 1, end - at - 1));
    if (value != nullptr && name.size() < 4096) name.replace(at, end - at, to_string(*value));
  }
  return name;
}

}  // namespace

/// The file names of an include; one that ends in " +" goes on in the next line. `only_first`: the lines after it are
/// cards.
std::vector<std::pair<std::string, SourceLocation>> DeckReader::file_names(Block& block, bool only_first) {
  std::vector<std::pair<std::string, SourceLocation>> names;
  std::string pending;
  std::string_view line;
  int number = 0;
  SourceLocation where;
  while (block.take_line(line, number)) {
    std::string_view text = trimmed(line);
    if (text.empty()) continue;
    if (pending.empty()) where = {block.where.file, number, static_cast<int>(text.data() - line.data()) + 1};
    const bool continues = text.ends_with(" +");
    if (continues) text = trimmed(text.substr(0, text.size() - 1));
    pending += text;
    if (continues) continue;
    names.emplace_back(substituted(without_quotes(pending), block.parameters_), where);
    pending.clear();
    if (only_first) break;
  }
  if (!pending.empty()) names.emplace_back(pending, where);
  if (names.empty()) block.error("the name of the file is missing");
  return names;
}

void DeckReader::include(const FileState& state, Block& block) {
  for (const auto& [name, where] : file_names(block, false)) include_file(state, name, where, block, state.context);
}

void DeckReader::add_include_path(const FileState& state, Block& block) {
  for (const auto& [name, where] : file_names(block, false)) {
    const Path path(name);
    include_paths_.push_back(path.is_absolute() ? path : (block.has("RELATIVE") ? state.folder : main_folder_) / path);
  }
}

void DeckReader::include_transformed(const FileState& state, Block& block) {
  const auto names = file_names(block, true);
  const Card ids = block.next_optional("ids"), others = block.next_optional("others"),
             units = block.next_optional("units"), transformation = block.next_optional("transformation");
  if (names.empty()) return;

  const IncludeContext& outer = *state.context;
  auto context = std::make_shared<IncludeContext>(outer);
  context->trivial = false;
  constexpr std::array<std::string_view, 7> fields = {"idnoff", "ideoff", "idpoff", "idmoff",
                                                      "idsoff", "idfoff", "iddoff"};
  constexpr std::array<IdKind, 7> kinds = {IdKind::node, IdKind::element, IdKind::part,  IdKind::material,
                                           IdKind::set,  IdKind::curve,   IdKind::define};
  const auto shift = [&](IdKind kind, const Card& card, std::string_view field) {
    constexpr std::int64_t largest = 1'000'000'000'000;
    const std::int64_t offset = card.integer(field);
    if (offset > largest || offset < -largest)
      return card.error(field, fmt::format("the offset {} is too large", offset));
    context->offset[static_cast<std::size_t>(kind)] += offset;
  };
  for (std::size_t i = 0; i < fields.size(); ++i) shift(kinds[i], ids, fields[i]);
  shift(IdKind::other, others, "idroff");

  const auto factor = [&](std::string_view field) {
    const double value = units.real(field);
    if (value > 0) return value;
    if (value < 0) units.error(field, fmt::format("found {}, expected a positive factor", value));
    return 1.0;
  };
  const double length = factor("fctlen");
  context->mass = outer.mass * factor("fctmas");
  context->time = outer.time * factor("fcttim");
  context->length = outer.length * length;

  const std::int64_t id = transformation.integer("tranid");
  Affine inner;
  if (const auto found = transformations_.find(id); found != transformations_.end())
    inner = found->second;
  else if (id != 0)
    transformation.error("tranid", fmt::format("transformation {} is not defined", id),
                         "*DEFINE_TRANSFORMATION stands before its use");
  if (!inner.is_identity || !outer.affine.is_identity) {
    // x -> A_o f_o (A_i f_i x + b_i) + b_o, written as factors first and one affine map after them.
    context->affine.linear = outer.affine.linear * inner.linear;
    context->affine.shift = outer.affine.point(inner.shift * outer.length);
    context->affine.is_identity = false;
  }
  include_file(state, names[0].first, names[0].second, block, std::move(context));
}

bool DeckReader::allowed(const Path& path) const {
  if (options_.confine_to.empty()) return true;
  std::error_code problem;
  const Path folder = fs::weakly_canonical(options_.confine_to, problem), file = fs::weakly_canonical(path, problem);
  return !problem && std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

fs::path DeckReader::locate(const FileState& state, const std::string& name, std::string& searched) const {
  std::error_code ignored;
  std::vector<std::string> spellings = {name};
  if (name.find('\\') != std::string::npos) {  // written on Windows
    spellings.push_back(name);
    std::replace(spellings[1].begin(), spellings[1].end(), '\\', '/');
  }
  std::vector<Path> folders = {state.folder, main_folder_};
  folders.insert(folders.end(), include_paths_.begin(), include_paths_.end());
  folders.insert(folders.end(), options_.include_folders.begin(), options_.include_folders.end());
  for (const std::string& spelling : spellings) {
    const Path path(spelling);
    if (path.is_absolute()) {
      if (fs::is_regular_file(path, ignored)) return path;
      continue;
    }
    for (const Path& folder : folders)
      if (fs::is_regular_file(folder / path, ignored)) return folder / path;
  }
  std::vector<std::string> seen;
  for (const Path& folder : folders) {
    const std::string text = folder.empty() ? "." : folder.string();
    if (std::find(seen.begin(), seen.end(), text) != seen.end()) continue;
    seen.push_back(text);
    searched += (searched.empty() ? "" : ", ") + text;
  }
  return {};
}

void DeckReader::include_file(const FileState& state, const std::string& name, const SourceLocation& where,
                              const Block& block, std::shared_ptr<const IncludeContext> context) {
  const auto fail = [&](std::string message, std::string cure = {}) {
    diagnostics_.error(std::move(message), std::move(cure), block.as_written(), where);
  };
  if (name.find('\0') != std::string::npos || name.size() > 4096) return fail("this is no name of a file");
  std::string searched, problem;
  const Path path = locate(state, name, searched);
  if (path.empty())
    return fail(fmt::format("the file '{}' is not found", name),
                Path(name).is_absolute() ? "" : "searched in: " + searched);
  if (!allowed(path))
    return fail(fmt::format("the file '{}' lies outside of the folder that includes are confined to", name));
  std::error_code ignored;
  const Path canonical = fs::weakly_canonical(path, ignored);
  if (const auto first = std::find(open_files_.begin(), open_files_.end(), canonical); first != open_files_.end()) {
    std::string chain;
    for (auto file = first; file != open_files_.end(); ++file) chain += file->filename().string() + " -> ";
    return fail(fmt::format("the includes go in a circle: {}{}", chain, canonical.filename().string()),
                "break the circle");
  }
  if (open_files_.size() >= static_cast<std::size_t>(options_.max_include_depth))
    return fail(fmt::format("includes are nested deeper than {} files", options_.max_include_depth));
  if (deck_.files.size() >= options_.max_files) {
    if (named_.insert("too many files").second)
      fail(fmt::format("the deck has more than {} files", options_.max_files));
    return;
  }
  FileState inner;
  inner.file = SourceFile::open(path, path.string(), problem);
  if (!inner.file) return fail(fmt::format("cannot read '{}': {}", name, problem));
  if (deck_.bytes + inner.file->text.size() > options_.max_bytes) {
    if (named_.insert("too many bytes").second)
      fail(fmt::format("the deck has more than {} bytes", options_.max_bytes));
    return;
  }
  inner.folder = path.parent_path();
  inner.scope = parameters_->open_scope(state.scope);
  inner.format = state.format;
  inner.context = std::move(context);
  open_files_.push_back(canonical);
  read(inner);
  open_files_.pop_back();
}

}  // namespace kardan::deck

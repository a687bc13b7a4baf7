#include "kardan/io/deck/deck_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <span>
#include <utility>

#include "kardan/state/registry.hpp"

namespace kardan::deck {

namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

int count_lines(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// Position of the next line that begins with '*', from `from` (a line start) on; npos if there is none.
std::size_t next_star(std::string_view text, std::size_t from) {
  while (from < text.size()) {
    const void* star = std::memchr(text.data() + from, '*', text.size() - from);
    if (star == nullptr) return std::string_view::npos;
    const auto at = static_cast<std::size_t>(static_cast<const char*>(star) - text.data());
    if (at == 0 || text[at - 1] == '\n') return at;
    from = at + 1;
  }
  return std::string_view::npos;
}

bool contains(std::string_view text, char c) {
  return std::memchr(text.data(), c, text.size()) != nullptr;
}

}  // namespace

DeckReader::DeckReader(const ReadOptions& options, Diagnostics& diagnostics)
    : options_(options), diagnostics_(diagnostics) {}

void DeckReader::read_main(const std::filesystem::path& path) {
  std::string problem;
  const auto file = SourceFile::open(path, path.string(), problem);
  if (!file) {
    diagnostics_.error(fmt::format("cannot read the deck: {}", problem), {}, {}, {path.string(), 0, 0});
    return;
  }
  std::error_code ignored;
  open_files_.push_back(std::filesystem::weakly_canonical(path, ignored));
  read_main(file, path.parent_path());
}

void DeckReader::read_main(std::shared_ptr<const SourceFile> file, const std::filesystem::path& folder) {
  main_folder_ = folder;
  FileState state;
  state.file = std::move(file);
  state.folder = folder;
  state.context = std::make_shared<IncludeContext>();
  read(state);
}

std::size_t DeckReader::first_keyword(const FileState& state, int& line) {
  const std::string_view text = state.file->text;
  const std::size_t first = next_star(text, 0);
  const std::string_view head = text.substr(0, first);
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    diagnostics_.error("the file is written in UTF-16", "save it as plain text (ASCII or UTF-8)", {},
                       {state.file->name, 1, 0});
    return std::string_view::npos;
  }
  int number = 0;
  for (std::size_t start = 0; start < head.size();) {
    const std::size_t end = std::min(head.find('\n', start), head.size());
    const std::string_view content = trimmed(head.substr(start, end - start));
    ++number;
    if (!content.empty() && content[0] != '$') {
      diagnostics_.error("text before the first keyword", "a deck begins with *KEYWORD; comments begin with $", {},
                         {state.file->name, number, 1});
      break;
    }
    start = end + 1;
  }
  line = 1 + count_lines(head);
  return first;
}

void DeckReader::read(FileState& state) {
  const std::string_view all = state.file->text;
  deck_.files.push_back({state.file->name, all.size(), fnv1a(fnv1a_start, std::as_bytes(std::span(all)))});
  deck_.bytes += all.size();
  const std::string_view text = state.file->text;
  int line = 1;
  std::size_t at = first_keyword(state, line);
  while (at != std::string_view::npos) {
    const std::size_t end_of_line = std::min(text.find('\n', at), text.size());
    const std::size_t body_start = std::min(end_of_line + 1, text.size());
    const std::size_t next = next_star(text, body_start);
    const std::string_view body = text.substr(body_start, next == std::string_view::npos ? next : next - body_start);
    const KeywordLine keyword = split_keyword_line(trimmed(text.substr(at + 1, end_of_line - at - 1)));
    if (keyword.as_written == "*END") return;
    handle(state, make_block(state, keyword, body, line), keyword.rest);
    line += 1 + count_lines(body);
    at = next;
  }
}

DeckReader::KeywordLine DeckReader::split_keyword_line(std::string_view line) {
  KeywordLine keyword;
  const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
  std::string_view name = line.substr(0, end);
  keyword.rest = trimmed(line.substr(end));
  if (!name.empty() && std::string_view("%+-").find(name.back()) != std::string_view::npos) {
    keyword.suffix = name.back();
    name.remove_suffix(1);
  } else if (keyword.rest.size() >= 1 && std::string_view("%+-").find(keyword.rest[0]) != std::string_view::npos) {
    keyword.suffix = keyword.rest[0];
  }
  keyword.as_written = "*" + upper(name);
  return keyword;
}

Block DeckReader::make_block(const FileState& state, const KeywordLine& keyword, std::string_view body,
                             int line) const {
  Block block;
  block.as_written_ = keyword.as_written;
  block.where = {state.file->name, line, 1};
  block.text_ = body;
  block.first_line_ = block.cursor_line_ = line + 1;
  block.format_ = state.format;
  if (keyword.suffix == '%') block.format_ = CardFormat::i10;
  if (keyword.suffix == '+') block.format_ = CardFormat::long_format;
  if (keyword.suffix == '-') block.format_ = CardFormat::standard;
  block.has_commas_ = contains(body, ',');
  block.has_references_ = contains(body, '&') || contains(body, '<');
  block.has_tabs_ = contains(body, '\t');
  block.file_ = state.file;
  block.parameters_ = {parameters_, parameters_->now(), state.scope};
  block.context_ = state.context;
  block.diagnostics_ = &diagnostics_;
  return block;
}

void DeckReader::handle(FileState& state, Block&& block, std::string_view rest) {
  const std::string_view name = std::string_view(block.as_written_).substr(1);
  const KeywordMatch match = Schema::instance().match(name);
  if (match.info == nullptr) return unknown(block);
  block.info = match.info;
  block.keyword = match.info->name;
  block.options = {match.options.begin(), match.options.end()};
  const bool idle = !match.info->stops_if.empty() && block.peek("card0").real(match.info->stops_if) == 0;
  if (match.info->status == KeywordStatus::not_needed || idle) {
    if (named_.insert(block.keyword).second)
      diagnostics_.notice(fmt::format("read and not needed: {}", match.info->note), block.as_written_, block.where);
    return;
  }
  // A material whose law is not built is handed out all the same: its density counts, and the model builder refuses the
  // deformable parts made of it.
  const bool weighed = block.keyword.starts_with("MAT_") && match.info->find_card("card0") != nullptr;
  if ((match.info->status == KeywordStatus::stops || unwanted(block)) && !weighed && stopped(block)) return;
  if (!match.bad_option.empty()) {
    diagnostics_.error(fmt::format("*{} has no option {} here", block.keyword, match.bad_option),
                       "docs/keywords.md lists the options of each keyword", block.as_written_, block.where);
    return;
  }
  if (!handle_own(state, block, rest)) deck_.blocks.push_back(std::move(block));
}

bool DeckReader::unwanted(const Block& block) const {
  return (block.keyword.starts_with("CONTACT_") || block.keyword.starts_with("RIGIDWALL_")) && options_.without.contains("contact");
}

bool DeckReader::stopped(const Block& block) {
  if (!named_.insert(block.as_written_).second) return true;
  if (unwanted(block))
    diagnostics_.warning("left out at your wish (--without contact): parts may pass through each other", {},
                         block.as_written_, block.where);
  else
    diagnostics_.error(block.info->note, "docs/keywords.md lists what Kardan honours", block.as_written_, block.where);
  return true;
}

void DeckReader::unknown(const Block& block) {
  if (!named_.insert(block.as_written_).second) return;
  // Guessing is slow; beyond the errors that are shown it is left out.
  const bool shown = diagnostics_.error_count() < Diagnostics::error_limit;
  const std::string near =
      shown ? Schema::instance().nearest(std::string_view(block.as_written_).substr(1)) : std::string();
  diagnostics_.error(
      "unknown keyword; it may change the physics, so it is not passed over",
      near.empty() ? "docs/keywords.md lists what Kardan honours" : fmt::format("did you mean *{}?", near),
      block.as_written_, block.where);
}

bool DeckReader::handle_own(FileState& state, Block& block, std::string_view rest) {
  const std::string& name = block.keyword;
  if (name == "KEYWORD") {
    read_keyword_options(state, rest, block);
  } else if (name == "INCLUDE") {
    include(state, block);
  } else if (name == "INCLUDE_TRANSFORM") {
    include_transformed(state, block);
  } else if (name == "INCLUDE_PATH") {
    add_include_path(state, block);
  } else if (name == "PARAMETER") {
    if (block.has("EXPRESSION"))
      read_parameter_expressions(state, block);
    else
      read_parameters(state, block);
  } else if (name == "PARAMETER_DUPLICATION") {
    duplication_ = static_cast<int>(std::clamp<std::int64_t>(block.next_optional("card0").integer("dflag"), 1, 5));
  } else if (name == "DEFINE_TRANSFORMATION") {
    read_transformation(block);
  } else if (name != "COMMENT" && name != "END") {
    return false;
  }
  return true;
}

// *KEYWORD LONG=Y I10=Y …; LONG=S and LONG=K concern what LS-DYNA writes. MEMORY=, NCPU= and a bare number likewise.
void DeckReader::read_keyword_options(FileState& state, std::string_view rest, const Block& block) {
  const std::string options = upper(rest);
  std::size_t start = 0;
  while ((start = options.find_first_not_of(" \t,", start)) != std::string::npos) {
    const std::size_t end = std::min(options.find_first_of(" \t,", start), options.size());
    const std::string_view word = std::string_view(options).substr(start, end - start);
    if (word == "LONG=Y")
      state.format = CardFormat::long_format;
    else if (word == "I10=Y")
      state.format = CardFormat::i10;
    else if (word.starts_with("LONG=") && word != "LONG=S" && word != "LONG=K" && word != "LONG=N")
      block.warning(fmt::format("{} is not known; the standard widths are taken", word), "LONG=Y or LONG=S");
    start = end;
  }
}

void DeckReader::read_transformation(Block& block) {
  if (block.has("TITLE")) block.next_title();
  const Card head = block.next("card0");
  const std::int64_t id = head.integer("tranid");
  Transformation transformation;
  block.for_each("step", [&](const Card& step) { transformation.add(step); });
  if (!transformations_.emplace(id, transformation.result()).second)
    head.error("tranid", fmt::format("transformation {} is defined a second time", id));
}

Deck read_deck(const std::filesystem::path& path, const ReadOptions& options, Diagnostics& diagnostics) {
  DeckReader reader(options, diagnostics);
  reader.read_main(path);
  return reader.take();
}

Deck read_deck_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                    const ReadOptions& options, Diagnostics& diagnostics) {
  DeckReader reader(options, diagnostics);
  reader.read_main(SourceFile::from_text(std::move(text), name), folder);
  return reader.take();
}

}  // namespace kardan::deck

// The work behind read_deck: splits files into blocks, follows includes, keeps parameters and transformations.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "kardan/io/deck/deck.hpp"
#include "kardan/io/deck/source.hpp"
#include "kardan/io/deck/transformation.hpp"

namespace kardan::deck {

class DeckReader {
 public:
  DeckReader(const ReadOptions& options, Diagnostics& diagnostics);

  void read_main(const std::filesystem::path& path);
  void read_main(std::shared_ptr<const SourceFile> file, const std::filesystem::path& folder);
  Deck take() { return std::move(deck_); }

 private:
  using Path = std::filesystem::path;
  /// What holds within one file.
  struct FileState {
    std::shared_ptr<const SourceFile> file;
    Path folder;
    int scope = 0;
    CardFormat format = CardFormat::standard;  ///< of the file; a keyword may have its own
    std::shared_ptr<const IncludeContext> context;
  };
  /// A keyword line: "*NAME %  LONG=Y".
  struct KeywordLine {
    std::string as_written;  ///< "*" and the name in upper case
    std::string_view rest;   ///< what follows on the line
    char suffix = '\0';      ///< '%', '+', '-'
  };

  void read(FileState& state);
  std::size_t first_keyword(const FileState& state, int& line);
  static KeywordLine split_keyword_line(std::string_view line);
  Block make_block(const FileState& state, const KeywordLine& keyword, std::string_view body, int line) const;
  void handle(FileState& state, Block&& block, std::string_view rest);
  /// Keywords that the reader acts on itself; false: the block is for the consumer.
  bool handle_own(FileState& state, Block& block, std::string_view rest);
  /// A contact or wall that the user leaves out.
  bool unwanted(const Block& block) const;
  bool stopped(const Block& block);
  void unknown(const Block& block);

  void read_keyword_options(FileState& state, std::string_view rest, const Block& block);
  void read_parameters(FileState& state, Block& block);
  void read_parameter_expressions(FileState& state, Block& block);
  void define(const FileState& state, const Card& card, int column, std::string_view typed_name,
              std::string_view value_text, int value_column, bool is_expression);
  void store(const FileState& state, const Card& card, const std::string& name, ParameterValue value, bool local,
             int column);
  void read_transformation(Block& block);

  std::vector<std::pair<std::string, SourceLocation>> file_names(Block& block, bool only_first);
  void include(const FileState& state, Block& block);
  void include_transformed(const FileState& state, Block& block);
  void include_file(const FileState& state, const std::string& name, const SourceLocation& where, const Block& block,
                    std::shared_ptr<const IncludeContext> context);
  void add_include_path(const FileState& state, Block& block);
  Path locate(const FileState& state, const std::string& name, std::string& searched) const;
  bool allowed(const Path& path) const;

  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  Deck deck_;
  std::shared_ptr<Parameters> parameters_ = std::make_shared<Parameters>();
  std::map<std::int64_t, Affine> transformations_;
  Path main_folder_;
  std::vector<Path> include_paths_;
  std::vector<Path> open_files_;  // the chain of includes being read
  std::set<std::string> named_;   // keywords already reported as stopping, dropped or left out
  int duplication_ = 1;           // *PARAMETER_DUPLICATION DFLAG
};

}  // namespace kardan::deck

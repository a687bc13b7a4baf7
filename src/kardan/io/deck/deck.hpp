// The keyword reader: a deck's text -> a sequence of keyword blocks whose data lines are read card by card.
//
//   Diagnostics diagnostics;
//   Deck deck = read_deck("car.k", {}, diagnostics);
//   for (Block& block : deck.blocks)
//     if (block.keyword == "CONSTRAINED_JOINT_REVOLUTE")
//       while (!block.at_end()) {
//         Card id = block.next_if(block.has("ID"), "id");
//         Card card = block.next("card0");
//         use(card.id("n1", IdKind::node), card.real("rps"));
//       }
//
// Includes are expanded, parameters and expressions evaluated field by field, keywords that Kardan does not need
// dropped, and keywords that it cannot honour reported, before the blocks are handed out. Nothing here throws on bad
// input: every fault goes into the Diagnostics, with file, line, column, keyword and field, and the reading goes on.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/io/deck/number.hpp"
#include "kardan/io/deck/parameters.hpp"
#include "kardan/io/deck/schema.hpp"

namespace kardan::deck {

struct SourceFile;  // source.hpp
class Block;
class DeckReader;  // reader.hpp

/// Whose number an ID is: *INCLUDE_TRANSFORM shifts each kind by its own offset.
enum class IdKind { node, element, part, material, set, curve, define, other };

/// Powers of mass, length and time: the unit of a number, for *INCLUDE_TRANSFORM's unit factors.
struct Dimension {
  int mass = 0, length = 0, time = 0;
};
namespace dimension {
inline constexpr Dimension none{}, mass{1, 0, 0}, length{0, 1, 0}, time{0, 0, 1}, area{0, 2, 0}, density{1, -3, 0},
    velocity{0, 1, -1}, acceleration{0, 1, -2}, angular_velocity{0, 0, -1}, angular_acceleration{0, 0, -2},
    force{1, 1, -2}, moment{1, 2, -2}, stress{1, -1, -2}, inertia{1, 2, 0}, stiffness{1, 0, -2}, damping{1, 0, -1},
    rate{0, 0, -1}, rotational_stiffness{1, 2, -2}, rotational_damping{1, 2, -1};
}

/// x -> linear x + shift.
struct Affine {
  Mat3 linear = Mat3::identity();
  Vec3 shift{};
  bool is_identity = true;
  Vec3 point(const Vec3& x) const { return is_identity ? x : linear * x + shift; }
  Vec3 direction(const Vec3& v) const { return is_identity ? v : linear * v; }
};

/// What the chain of *INCLUDE_TRANSFORM above a block does to its data: numbers first to the main deck's units, then
/// points and directions through `affine`, IDs by `offset` (all of them already composed over nested includes).
struct IncludeContext {
  std::array<std::int64_t, 8> offset{};  ///< by IdKind
  double mass = 1, length = 1, time = 1;
  Affine affine;
  bool trivial = true;
  double factor(Dimension d) const;
};

/// One data line read with one card layout. Copyable and cheap; valid as long as its Block stays where it is.
/// A field is named (lower case) or addressed by its index in the layout, which is the fast way for large tables.
/// A malformed field is reported and its default returned; so is a field of a missing card, silently.
class Card {
 public:
  bool present() const { return present_; }    ///< false: the block had no line left
  int index_of(std::string_view field) const;  ///< asserts that the layout has it
  std::size_t field_count() const { return layout_->fields.size(); }

  bool blank(std::string_view field) const { return blank(index_of(field)); }
  bool blank(int field) const;
  bool all_blank() const;
  /// A number field is blank or holds the table's default (0 where the table gives none).
  bool is_default(std::string_view field) const { return is_default(index_of(field)); }
  bool is_default(int field) const {
    return blank(field) || real(field) == layout_->fields[static_cast<std::size_t>(field)].default_real;
  }

  /// An integer; where the field is blank the table's default. "12.0" and a real parameter of integral value are
  /// accepted.
  std::int64_t integer(std::string_view field) const { return integer(index_of(field)); }
  std::int64_t integer(int field) const;
  double real(std::string_view field) const { return real(index_of(field)); }
  double real(int field) const;
  /// The number in the main deck's units.
  double real(std::string_view field, Dimension d) const { return real(index_of(field), d); }
  double real(int field, Dimension d) const;
  /// Trimmed text; a whole-field &name of a character parameter is replaced.
  std::string text(std::string_view field) const { return text(index_of(field)); }
  std::string text(int field) const;
  /// A user's number shifted by the include's offset; 0 stays 0, a negative number keeps its sign.
  std::int64_t id(std::string_view field, IdKind kind) const { return id(index_of(field), kind); }
  std::int64_t id(int field, IdKind kind) const;
  /// Three consecutive fields as a point (length units, moved by the include's transformation) or a direction
  /// (unit-free).
  Vec3 point(std::string_view first_field) const;
  Vec3 direction(std::string_view first_field, Dimension d = dimension::none) const;

  const Block& block() const { return *block_; }
  SourceLocation where() const;
  SourceLocation where(std::string_view field) const { return where(index_of(field)); }
  SourceLocation where(int field) const;
  /// The line as it stands in the deck (without line end).
  std::string_view line() const { return line_; }
  /// Reports a fault of one field, or of the whole card, with location and keyword filled in.
  void error(std::string_view field, std::string message, std::string cure = {}) const;
  void error_on_card(std::string message, std::string cure = {}) const;
  void warning(std::string_view field, std::string message, std::string cure = {}) const;

 private:
  friend class Block;
  friend class DeckReader;
  std::string_view field_text(int field, int& column) const;
  std::string_view free_field(int position, bool to_end, int& column) const;
  /// Value of a field that refers to parameters; reports why there is none.
  std::optional<ParameterValue> evaluated(std::string_view text, const FieldLayout& field, int column) const;
  void malformed(const FieldLayout& field, int column, std::string_view found, NumberState state) const;
  void report(Severity severity, std::string field, int column, std::string message, std::string cure) const;

  const Block* block_ = nullptr;
  const CardLayout* layout_ = nullptr;
  std::string_view line_;
  std::string expanded_;  // the line with its tabs expanded; empty if it has none
  int line_number_ = 0;
  mutable int free_position_ = 0;  // the comma-separated value found last, and where it starts
  mutable std::size_t free_start_ = 0;
  CardFormat format_ = CardFormat::standard;
  bool present_ = false, free_ = false, has_references_ = false;
};

/// One occurrence of a keyword with its data lines. Comment lines never appear.
class Block {
 public:
  std::string keyword;            ///< canonical name without asterisk, e.g. "SET_NODE_LIST" for *SET_NODE_TITLE
  std::set<std::string> options;  ///< e.g. {"ID", "LOCAL"}
  SourceLocation where;           ///< of the keyword line
  const KeywordInfo* info = nullptr;

  bool has(std::string_view option) const { return options.contains(std::string(option)); }
  /// "*CONSTRAINED_JOINT_REVOLUTE_ID" as written, for messages.
  const std::string& as_written() const { return as_written_; }
  const IncludeContext& context() const { return *context_; }
  Diagnostics& diagnostics() const { return *diagnostics_; }

  /// True when only blank lines, or none, are left: the test for another round of a repeated entry.
  bool at_end() const;
  /// Data lines left, blank ones included.
  std::size_t lines_left() const;
  /// Takes the next data line and reads it with a card of the keyword's layout. A missing line is an error.
  Card next(std::string_view card);
  /// The same for a card that may be left out at the end of a block: then all of its fields are at their defaults.
  Card next_optional(std::string_view card);
  /// next(card) if `condition`, otherwise an absent card: for option cards.
  Card next_if(bool condition, std::string_view card) { return condition ? next(card) : absent(card); }
  /// The next data line, if there is one, with the layout of another keyword's card.
  Card next(const CardLayout& layout);
  /// Looks at the next data line without taking it.
  Card peek(std::string_view card) const;
  /// Takes the next data line as a title: the whole line, trimmed; empty where there is none.
  std::string next_title();
  /// Reads every line left with one layout, blank lines skipped; the fast way for large tables.
  template <class F>
  void for_each(std::string_view card_name, F&& f) {
    Card card = absent(card_name);
    while (advance(card)) f(std::as_const(card));
  }
  void rewind() {
    cursor_ = 0;
    cursor_line_ = first_line_;
  }
  void error(std::string message, std::string cure = {}) const;
  void warning(std::string message, std::string cure = {}) const;

 private:
  friend class Card;
  friend class DeckReader;
  Card absent(std::string_view card) const;
  bool advance(Card& card);                             // next non-blank line into `card`
  bool take_line(std::string_view& line, int& number);  // next data line, blank or not
  bool scan(std::size_t& cursor, int& next_number, std::string_view& line, int& number) const;
  void open(Card& card, std::string_view line, int number) const;

  std::string as_written_;
  std::string_view text_;  // the raw lines between this keyword and the next
  std::size_t cursor_ = 0;
  int first_line_ = 0, cursor_line_ = 0;
  CardFormat format_ = CardFormat::standard;
  bool has_commas_ = false, has_references_ = false, has_tabs_ = false;
  std::shared_ptr<const SourceFile> file_;
  ParameterView parameters_;
  std::shared_ptr<const IncludeContext> context_;
  Diagnostics* diagnostics_ = nullptr;
};

/// A file that was read, and what it held then.
struct DeckFile {
  std::string name;                ///< as shown in messages
  std::size_t bytes = 0;
  std::uint64_t hash = 0;          ///< of the text
};

/// A deck with its includes: the blocks in reading order: the honoured keywords, and materials that are not
/// built (for their density).
struct Deck {
  std::vector<Block> blocks;
  std::vector<DeckFile> files;     ///< every file read, the main one first
  std::size_t bytes = 0;           ///< of text read
};

struct ReadOptions {
  /// Keyword families left out at the user's wish, with a warning: "contact" (*CONTACT_…, *RIGIDWALL_…).
  std::set<std::string> without;
  /// Folders searched for includes after the including file's and the main deck's own.
  std::vector<std::filesystem::path> include_folders;
  /// If not empty: includes outside this folder are refused.
  std::filesystem::path confine_to;
  int max_include_depth = 64;
  std::size_t max_files = 10'000;
  std::size_t max_bytes = std::size_t{64} << 30;  ///< of text, all files together
};

/// Reads a deck and everything it includes. `diagnostics` must outlive the Deck: its blocks report into it while they
/// are consumed.
Deck read_deck(const std::filesystem::path& path, const ReadOptions& options, Diagnostics& diagnostics);

/// The same for a deck in memory; `name` stands in the messages, includes are searched from `folder`.
Deck read_deck_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                    const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace kardan::deck

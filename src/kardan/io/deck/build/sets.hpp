// *SET: members are resolved when first asked for, so that sets may name sets defined later.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

class Sets {
 public:
  explicit Sets(Builder& builder) : b_(builder) {}

  /// Notes the definition in a *SET block.
  void add(Block& block);
  /// Enters every set into the model.
  void resolve_all();
  /// Index of the set in the model's list of its kind; `none` and a message where it is 0 or not defined.
  Index reference(const Card& card, std::string_view field, SetKind kind);
  /// The same without a message; for numbers already read.
  Index find(SetKind kind, UserId id);
  /// Nodes of the parts' elements, and of nodal rigid bodies among the parts; without repeats.
  std::vector<NodeIndex> nodes_of_parts(const std::vector<PartIndex>& parts);

 private:
  using Members = std::vector<Index>;  // indices of nodes, parts or elements; of segments: into segments_
  using Segment = std::array<NodeIndex, 4>;

  struct Definition {
    UserId id = 0;
    std::string title;
    std::vector<Block*> blocks;  // several with _COLLECT
    SourceLocation where;
    enum { untouched, in_progress, done } state = untouched;
    Index index = none;  // in the model's list
  };

  /// Members gathered in order of first mention.
  struct Gathering {
    Members members;
    std::vector<double> attribute;
    std::vector<Segment> segments;
  };

  Index resolve(SetKind kind, Definition& definition);
  void read_block(SetKind kind, Block& block, Gathering& g);
  void read_list(SetKind kind, Block& block, Gathering& g);
  void read_generate(SetKind kind, Block& block, Gathering& g, bool increment);
  void read_column(SetKind kind, Block& block, Gathering& g);
  void read_add(SetKind kind, Block& block, Gathering& g);
  void read_advanced(Block& block, Gathering& g);
  void read_intersect(SetKind kind, Block& block, Gathering& g);
  void read_segments(Block& block, Gathering& g);
  void read_general(SetKind kind, Block& block, Gathering& g);
  void general_row(SetKind kind, const Card& row, Gathering& g);
  void collect_general(SetKind kind, const std::string& option, const Card& row, Gathering& g);
  void general_segments(const std::string& option, const Card& row, Gathering& g, bool remove);
  Index store(SetKind kind, const Definition& definition, Gathering& g);

  Index find_member(SetKind kind, UserId id) const;
  IdKind id_kind(SetKind kind) const;
  const std::vector<UserId>& sorted_ids(SetKind kind);
  std::size_t count(SetKind kind) const;
  void append(SetKind kind, Gathering& g, const Members& members);
  void remove(Gathering& g, const Members& members);
  Members members_of_set(SetKind kind, Index set) const;
  /// Members of `kind` in a box, in a part, or belonging to an element set.
  Members in_box(SetKind kind, const Box& box) const;
  Members in_part(SetKind kind, PartIndex part) const;
  Members nodes_of_elements(ElementKind kind, const Members& elements) const;
  std::vector<Segment> segments_of_part(PartIndex part);
  std::vector<Segment> exterior_faces(const std::vector<Index>& solids) const;

  Builder& b_;
  std::array<std::map<UserId, Definition>, set_kinds> sets_;
  std::array<std::vector<UserId>, set_kinds> sorted_;  // made when a GENERATE first needs them
  std::vector<std::uint32_t> stamp_;                   // marks what the set being gathered holds
  std::uint32_t round_ = 0;
};

}  // namespace kardan::deck

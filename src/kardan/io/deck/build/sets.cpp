#include "kardan/io/deck/build/sets.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "kardan/io/deck/build/set_detail.hpp"

namespace kardan::deck {

using namespace set_detail;

namespace {

/// SET_<KIND>…; nothing for kinds that Kardan does not have.
std::optional<SetKind> kind_of(const std::string& keyword) {
  static constexpr std::array<const char*, set_kinds> prefixes{"SET_NODE",  "SET_PART", "SET_SEGMENT", "SET_SHELL",
                                                               "SET_SOLID", "SET_BEAM", "SET_DISCRETE"};
  for (std::size_t k = 0; k < set_kinds; ++k) {
    if (keyword.starts_with(prefixes[k])) return static_cast<SetKind>(k);
  }
  return std::nullopt;
}

}  // namespace

void register_set(Builder& b, Block& block) {
  b.sets->add(block);
}

void Sets::add(Block& block) {
  const std::optional<SetKind> kind = kind_of(block.keyword);
  if (!kind) {
    block.warning("Kardan has no elements of this kind; the set is not kept",
                  "nothing to do unless something names it");
    return;
  }
  std::string title;
  if (block.has("TITLE")) title = block.next_title();
  const Card card = block.next("card0");
  if (!card.present()) return;
  const UserId id = card.id("sid", IdKind::set);
  if (id <= 0) {
    card.error("sid", "found " + std::to_string(id) + ", expected the positive number of a set",
               "give the set a number");
    return;
  }
  Definition& d = sets_[at(*kind)][id];
  if (!d.blocks.empty() && !(block.has("COLLECT") && d.blocks.front()->has("COLLECT"))) {
    card.error("sid",
               std::string(kind_names[at(*kind)]) + " set " + std::to_string(id) + " is defined twice; first at " +
                   d.where.file + ":" + std::to_string(d.where.line),
               "give one of the two another number, or use _COLLECT on both");
    return;
  }
  if (d.blocks.empty()) {
    d.id = id;
    d.title = title;
    d.where = card.where();
  }
  d.blocks.push_back(&block);
}

void Sets::resolve_all() {
  for (const SetKind kind : {SetKind::part, SetKind::shell, SetKind::solid, SetKind::beam, SetKind::discrete,
                             SetKind::segment, SetKind::node}) {
    for (auto& [id, definition] : sets_[at(kind)]) resolve(kind, definition);
  }
}

Index Sets::find(SetKind kind, UserId id) {
  const auto hit = sets_[at(kind)].find(id);
  return hit == sets_[at(kind)].end() ? none : resolve(kind, hit->second);
}

Index Sets::reference(const Card& card, std::string_view field, SetKind kind) {
  const UserId id = card.id(field, IdKind::set);
  const std::string what = std::string(kind_names[at(kind)]) + " set";
  if (id == 0) {
    card.error(field, "is blank or 0, expected the number of a " + what, "name a " + what);
    return none;
  }
  const Index i = find(kind, id);
  if (i == none) {
    card.error(field, what + " " + std::to_string(id) + " is not defined",
               std::string("define it with *SET_") + upper(kind_names[at(kind)]) + " or correct the number");
  }
  return i;
}

Index Sets::resolve(SetKind kind, Definition& definition) {
  if (definition.state == Definition::done) return definition.index;
  if (definition.state == Definition::in_progress) {
    b_.diagnostics.error(std::string(kind_names[at(kind)]) + " set " + std::to_string(definition.id) +
                             " contains itself through other sets",
                         "remove the circle", definition.blocks.front()->as_written(), definition.where);
    return none;
  }
  definition.state = Definition::in_progress;
  Gathering g;
  for (Block* block : definition.blocks) read_block(kind, *block, g);
  definition.index = store(kind, definition, g);
  definition.state = Definition::done;
  return definition.index;
}

void Sets::read_block(SetKind kind, Block& block, Gathering& g) {
  const std::string& k = block.keyword;
  if (k.ends_with("_INTERSECT"))
    read_intersect(kind, block, g);
  else if (k.ends_with("_ADD_ADVANCED"))
    read_advanced(block, g);
  else if (k.ends_with("_ADD"))
    read_add(kind, block, g);
  else if (k.ends_with("_GENERAL"))
    read_general(kind, block, g);
  else if (k.ends_with("_COLUMN"))
    read_column(kind, block, g);
  else if (kind == SetKind::segment)
    read_segments(block, g);
  else if (block.has("GENERATE_INCREMENT"))
    read_generate(kind, block, g, true);
  else if (block.has("GENERATE"))
    read_generate(kind, block, g, false);
  else
    read_list(kind, block, g);
}

// -- members ----------------------------------------------------------------------------------------------------------

IdKind Sets::id_kind(SetKind kind) const {
  return kind == SetKind::node ? IdKind::node : (kind == SetKind::part ? IdKind::part : IdKind::element);
}

Index Sets::find_member(SetKind kind, UserId id) const {
  if (kind == SetKind::node) return b_.model.nodes.index_of.index(id);
  if (kind == SetKind::part) return b_.parts.find(id);
  return b_.elements[static_cast<std::size_t>(element_kind(kind))].index(id);
}

std::size_t Sets::count(SetKind kind) const {
  if (kind == SetKind::node) return b_.model.nodes.size();
  if (kind == SetKind::part) return b_.model.parts.size();
  return with_elements(b_.model, element_kind(kind), [](const auto& e) { return e.size(); });
}

const std::vector<UserId>& Sets::sorted_ids(SetKind kind) {
  std::vector<UserId>& ids = sorted_[at(kind)];
  if (ids.empty()) {
    if (kind == SetKind::node)
      ids = b_.model.nodes.id;
    else if (kind == SetKind::part)
      for (const Part& p : b_.model.parts) ids.push_back(p.id);
    else
      ids = with_elements(b_.model, element_kind(kind), [](const auto& e) { return e.id; });
    std::sort(ids.begin(), ids.end());
  }
  return ids;
}

void Sets::append(SetKind kind, Gathering& g, const Members& members) {
  // Sets may be resolved while another is being gathered, so membership is marked afresh for every addition.
  stamp_.resize(std::max(stamp_.size(), count(kind)), 0);
  ++round_;
  for (const Index m : g.members) stamp_[at(m)] = round_;
  for (const Index m : members) {
    if (stamp_[at(m)] == round_) continue;
    stamp_[at(m)] = round_;
    g.members.push_back(m);
  }
}

void Sets::remove(Gathering& g, const Members& members) {
  const std::set<Index> gone(members.begin(), members.end());
  std::erase_if(g.members, [&](Index m) { return gone.contains(m); });
}

Sets::Members Sets::members_of_set(SetKind kind, Index set) const {
  if (kind == SetKind::node) return b_.model.node_sets[at(set)].nodes;
  if (kind == SetKind::part) return b_.model.part_sets[at(set)].parts;
  return b_.model.element_sets[at(set)].elements;
}

Sets::Members Sets::in_box(SetKind kind, const Box& box) const {
  Members found;
  if (kind == SetKind::node) {
    for (std::size_t n = 0; n < b_.model.nodes.size(); ++n) {
      if (inside(box, b_.model.nodes.x[n])) found.push_back(static_cast<Index>(n));
    }
  } else if (kind != SetKind::part) {
    with_elements(b_.model, element_kind(kind), [&](const auto& block) {
      for (std::size_t e = 0; e < block.size(); ++e) {
        bool all = true;
        for (const NodeIndex n : block.nodes[e]) all = all && (n == none || inside(box, b_.model.nodes.x[at(n)]));
        if (all) found.push_back(static_cast<Index>(e));
      }
      return 0;
    });
  }
  return found;
}

Sets::Members Sets::nodes_of_elements(ElementKind kind, const Members& elements) const {
  Members nodes;
  with_elements(b_.model, kind, [&](const auto& block) {
    const std::size_t used = kind == ElementKind::beam ? 2 : block.nodes.empty() ? 0 : block.nodes.front().size();
    for (const Index e : elements) {
      for (std::size_t i = 0; i < used; ++i) {  // a beam's third node only orients it
        if (const NodeIndex n = block.nodes[at(e)][i]; n != none) nodes.push_back(n);
      }
    }
    return 0;
  });
  return nodes;
}

Sets::Members Sets::in_part(SetKind kind, PartIndex part) const {
  if (kind == SetKind::part) return {part};
  Members found;
  const auto elements_of = [&](ElementKind k) {
    Members elements;
    with_elements(b_.model, k, [&](const auto& block) {
      for (std::size_t e = 0; e < block.size(); ++e) {
        if (block.part[e] == part) elements.push_back(static_cast<Index>(e));
      }
      return 0;
    });
    return elements;
  };
  if (kind != SetKind::node) return elements_of(element_kind(kind));
  for (const ElementKind k : {ElementKind::shell, ElementKind::solid, ElementKind::beam, ElementKind::discrete}) {
    const Members nodes = nodes_of_elements(k, elements_of(k));
    found.insert(found.end(), nodes.begin(), nodes.end());
  }
  return found;
}

std::vector<NodeIndex> Sets::nodes_of_parts(const std::vector<PartIndex>& parts) {
  Gathering g;
  for (const PartIndex p : parts) {
    append(SetKind::node, g, in_part(SetKind::node, p));
    const Index body = b_.model.parts[at(p)].nodal_rigid_body;
    if (body != none) append(SetKind::node, g, b_.model.nodal_rigid_bodies[at(body)].nodes);
  }
  return g.members;
}

// -- forms of a definition --------------------------------------------------------------------------------------------

void Sets::read_list(SetKind kind, Block& block, Gathering& g) {
  Members members;
  block.for_each("list", [&](const Card& row) {
    for (int i = 0; i < 8; ++i) {
      const UserId id = row.id(i, id_kind(kind));
      if (id == 0) continue;
      const Index m = find_member(kind, id);
      if (m != none)
        members.push_back(m);
      else
        row.error(field_name("id", i + 1),
                  std::string(kind_names[at(kind)]) + " " + std::to_string(id) + " is not defined",
                  "define it or take it out of the set");
    }
  });
  append(kind, g, members);
}

void Sets::read_generate(SetKind kind, Block& block, Gathering& g, bool increment) {
  Members members;
  const auto add_range = [&](const Card& row, int first_field, std::int64_t step) {
    const UserId begin = row.id(first_field, id_kind(kind)), end = row.id(first_field + 1, id_kind(kind));
    if (begin == 0 && end == 0) return;
    if (end < begin || begin <= 0 || step <= 0) {
      row.error_on_card(std::string("the range ") + std::to_string(begin) + " to " + std::to_string(end) + " by " +
                            std::to_string(step) + " is not ascending",
                        "give the smaller number first and a positive increment");
      return;
    }
    const std::vector<UserId>& ids = sorted_ids(kind);
    for (auto it = std::lower_bound(ids.begin(), ids.end(), begin); it != ids.end() && *it <= end; ++it) {
      if ((*it - begin) % step == 0) members.push_back(find_member(kind, *it));
    }
  };
  if (increment) {
    block.for_each("increment",
                   [&](const Card& row) { add_range(row, 0, row.integer("incr") == 0 ? 1 : row.integer("incr")); });
  } else {
    block.for_each("generate", [&](const Card& row) {
      for (int i = 0; i < 8; i += 2) add_range(row, i, 1);
    });
  }
  append(kind, g, members);
}

void Sets::read_column(SetKind kind, Block& block, Gathering& g) {
  Members members;
  std::map<Index, double> attribute;
  block.for_each("column", [&](const Card& row) {
    const UserId id = row.id("id", id_kind(kind));
    const Index m = find_member(kind, id);
    if (m == none) {
      row.error("id", std::string(kind_names[at(kind)]) + " " + std::to_string(id) + " is not defined",
                "define it or take it out of the set");
      return;
    }
    members.push_back(m);
    attribute.emplace(m, row.real("a1", dimension::length));
  });
  append(kind, g, members);
  if (kind == SetKind::part) {
    for (const Index m : g.members) g.attribute.push_back(attribute.contains(m) ? attribute.at(m) : 0.0);
  }
}

void Sets::read_add(SetKind kind, Block& block, Gathering& g) {
  block.for_each("list", [&](const Card& row) {
    for (int i = 1; i <= 8; ++i) {
      const std::string field = field_name("id", i);
      if (row.id(field, IdKind::set) == 0) continue;
      const Index set = reference(row, field, kind);
      if (set == none) continue;
      if (kind == SetKind::segment) {
        const auto& s = b_.model.segment_sets[at(set)].segments;
        g.segments.insert(g.segments.end(), s.begin(), s.end());
      } else {
        append(kind, g, members_of_set(kind, set));
      }
    }
  });
}

void Sets::read_advanced(Block& block, Gathering& g) {
  // TYPE: 1 node set, 2 shell set, 3 beam set, 4 solid set, 5 segment set, 6 discrete set.
  static constexpr std::array<SetKind, 6> types{SetKind::node,  SetKind::shell,   SetKind::beam,
                                                SetKind::solid, SetKind::segment, SetKind::discrete};
  block.for_each("advanced", [&](const Card& row) {
    for (int i = 1; i <= 4; ++i) {
      const std::string field = field_name("sid", i), type_field = field_name("type", i);
      if (row.id(field, IdKind::set) == 0) continue;
      const std::int64_t type = row.integer(type_field);
      if (type < 1 || type > 6) {
        row.error(type_field, "found " + std::to_string(type) + ", expected a kind of set that Kardan has (1 to 6)",
                  "correct the type");
        continue;
      }
      const SetKind kind = types[static_cast<std::size_t>(type - 1)];
      const Index set = reference(row, field, kind);
      if (set == none) continue;
      Members nodes;
      if (kind == SetKind::node)
        nodes = members_of_set(kind, set);
      else if (kind == SetKind::segment)
        for (const Segment& s : b_.model.segment_sets[at(set)].segments) nodes.insert(nodes.end(), s.begin(), s.end());
      else
        nodes = nodes_of_elements(element_kind(kind), members_of_set(kind, set));
      append(SetKind::node, g, nodes);
    }
  });
}

void Sets::read_intersect(SetKind kind, Block& block, Gathering& g) {
  bool first = true;
  block.for_each("list", [&](const Card& row) {
    for (int i = 1; i <= 8; ++i) {
      const std::string field = field_name("id", i);
      if (row.id(field, IdKind::set) == 0) continue;
      const Index set = reference(row, field, kind);
      if (set == none) continue;
      const Members members = members_of_set(kind, set);
      if (first) {
        append(kind, g, members);
        first = false;
      } else {
        const std::set<Index> kept(members.begin(), members.end());
        std::erase_if(g.members, [&](Index m) { return !kept.contains(m); });
      }
    }
  });
}

void Sets::read_segments(Block& block, Gathering& g) {
  block.for_each("segment", [&](const Card& row) {
    Segment s{b_.node(row, "n1"), b_.node(row, "n2"), b_.node(row, "n3"), none};
    s[3] = row.id("n4", IdKind::node) == 0 ? s[2] : b_.node(row, "n4");
    if (std::find(s.begin(), s.end(), none) == s.end()) g.segments.push_back(s);
  });
}

// -- into the model ---------------------------------------------------------------------------------------------------

Index Sets::store(SetKind kind, const Definition& d, Gathering& g) {
  Model& m = b_.model;
  const auto last = [](const auto& list) { return static_cast<Index>(list.size()) - 1; };
  if (kind == SetKind::node) {
    m.node_sets.push_back({d.id, d.title, std::move(g.members)});
    return last(m.node_sets);
  }
  if (kind == SetKind::part) {
    if (g.attribute.size() != g.members.size()) g.attribute.clear();
    m.part_sets.push_back({d.id, d.title, std::move(g.members), std::move(g.attribute)});
    return last(m.part_sets);
  }
  if (kind == SetKind::segment) {
    m.segment_sets.push_back({d.id, d.title, std::move(g.segments)});
    return last(m.segment_sets);
  }
  m.element_sets.push_back({d.id, d.title, element_kind(kind), std::move(g.members)});
  return last(m.element_sets);
}

}  // namespace kardan::deck

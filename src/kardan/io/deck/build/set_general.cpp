// *SET_…_GENERAL: members by parts, boxes, elements and other sets, and their deletion.
#include <algorithm>
#include <map>
#include <set>

#include "kardan/io/deck/build/set_detail.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

using namespace set_detail;

namespace {

bool lacks_node(const std::array<NodeIndex, 4>& s) {
  return std::find(s.begin(), s.end(), none) != s.end();
}

std::array<NodeIndex, 4> sorted_corners(std::array<NodeIndex, 4> s) {
  std::sort(s.begin(), s.end());
  return s;
}

}  // namespace

void Sets::read_general(SetKind kind, Block& block, Gathering& g) {
  block.for_each("general", [&](const Card& row) { general_row(kind, row, g); });
}

void Sets::general_row(SetKind kind, const Card& row, Gathering& g) {
  std::string option = upper(row.text("option"));
  if (option == "DBOX" || option == "DPART" || option == "DNODE" || option == "DELEM" || option == "DSEG" ||
      option == "DSHELL" || option == "DSOLID" || option == "DBEAM" || option == "DDISCRETE") {
    option.erase(0, 1);
    if (kind == SetKind::segment) return general_segments(option, row, g, true);
    Gathering gone;
    collect_general(kind, option, row, gone);
    return remove(g, gone.members);
  }
  if (kind == SetKind::segment) return general_segments(option, row, g, false);
  collect_general(kind, option, row, g);
}

void Sets::collect_general(SetKind kind, const std::string& option, const Card& row, Gathering& g) {
  static const std::map<std::string, SetKind> element_options{
      {"SHELL", SetKind::shell}, {"SOLID", SetKind::solid}, {"BEAM", SetKind::beam}, {"DISCRETE", SetKind::discrete}};
  static const std::map<std::string, SetKind> set_options{
      {"SET_NODE", SetKind::node},       {"SET_SHELL", SetKind::shell},       {"SET_SOLID", SetKind::solid},
      {"SET_BEAM", SetKind::beam},       {"SET_DISCRETE", SetKind::discrete}, {"SET_DISCR", SetKind::discrete},
      {"SET_SEGMENT", SetKind::segment}, {"SET_SGMT", SetKind::segment},      {"SET_PART", SetKind::part}};
  const bool elements = kind != SetKind::node && kind != SetKind::part;
  if (option == "ALL" || option.empty()) {
    Members all(count(kind));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    return append(kind, g, all);
  }
  const auto set_option = set_options.find(option);
  const auto element_option = element_options.find(option);
  const bool own = (option == "NODE" && kind == SetKind::node) || (option == "ELEM" && elements);
  const bool others_elements =
      element_option != element_options.end() && (kind == SetKind::node || kind == element_option->second);
  const bool known = own || others_elements || option == "PART" || (option == "BOX" && kind != SetKind::part) ||
                     (set_option != set_options.end() && (kind == SetKind::node || kind == set_option->second));
  if (!known) {
    row.error("option",
              "found " + option + ", expected ALL, PART, BOX, " + (elements ? "ELEM" : "NODE") +
                  " or a name that begins with D or SET_ of these, for a " + kind_names[at(kind)] + " set",
              "correct the option");
    return;
  }
  for (int i = 1; i <= 7; ++i) {
    const std::string field = field_name("e", i);
    if (row.blank(field) || row.integer(field) == 0) continue;
    Members found;
    if (option == "PART") {
      const PartIndex p = b_.reference(row, field, b_.parts);
      if (p != none) found = in_part(kind, p);
    } else if (option == "BOX") {
      const Index box = b_.reference(row, field, b_.boxes);
      if (box != none) found = in_box(kind, b_.box_list[at(box)]);
    } else if (set_option != set_options.end()) {
      const Index set = reference(row, field, set_option->second);
      if (set == none) continue;
      if (set_option->second == kind)
        found = members_of_set(kind, set);
      else if (set_option->second == SetKind::segment)
        for (const Segment& s : b_.model.segment_sets[at(set)].segments) found.insert(found.end(), s.begin(), s.end());
      else if (set_option->second == SetKind::part)
        for (const PartIndex p : b_.model.part_sets[at(set)].parts) {
          const Members m = in_part(kind, p);
          found.insert(found.end(), m.begin(), m.end());
        }
      else
        found = nodes_of_elements(element_kind(set_option->second), members_of_set(set_option->second, set));
    } else {
      const SetKind member_kind = own ? kind : element_option->second;
      const UserId id = row.id(field, id_kind(member_kind));
      const Index m = find_member(member_kind, id);
      if (m == none)
        row.error(field, std::string(kind_names[at(member_kind)]) + " " + std::to_string(id) + " is not defined",
                  "define it or take it out of the set");
      else
        found = member_kind == kind ? Members{m} : nodes_of_elements(element_kind(member_kind), {m});
    }
    append(kind, g, found);
  }
}

std::vector<Sets::Segment> Sets::exterior_faces(const std::vector<Index>& solids) const {
  static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::map<Segment, std::pair<Segment, int>> seen_faces;
  std::vector<Segment> order;
  for (const Index e : solids) {
    for (const auto& face : faces) {
      Segment s{};
      for (std::size_t i = 0; i < 4; ++i) s[i] = b_.model.solids.nodes[at(e)][face[i]];
      // Degenerate faces: drop repeated corners; a face of fewer than three corners is an edge.
      std::vector<NodeIndex> corners;
      for (const NodeIndex n : s) {
        if (std::find(corners.begin(), corners.end(), n) == corners.end()) corners.push_back(n);
      }
      if (corners.size() < 3) continue;
      s = {corners[0], corners[1], corners[2], corners.size() == 4 ? corners[3] : corners[2]};
      auto& entry = seen_faces[sorted_corners(s)];
      if (entry.second++ == 0) {
        entry.first = s;
        order.push_back(sorted_corners(s));
      }
    }
  }
  std::vector<Segment> exterior;
  for (const Segment& key : order) {
    const auto& [face, times] = seen_faces.at(key);
    if (times == 1) exterior.push_back(face);
  }
  return exterior;
}

std::vector<Sets::Segment> Sets::segments_of_part(PartIndex part) {
  std::vector<Segment> segments;
  for (const Index e : in_part(SetKind::shell, part)) segments.push_back(b_.model.shells.nodes[at(e)]);
  const std::vector<Segment> faces = exterior_faces(in_part(SetKind::solid, part));
  segments.insert(segments.end(), faces.begin(), faces.end());
  // An element may name nodes that are not defined (reported where it stands): no segment of a set lacks a node.
  std::erase_if(segments, lacks_node);
  return segments;
}

void Sets::general_segments(const std::string& option, const Card& row, Gathering& g, bool remove_them) {
  std::vector<Segment> found;
  if (option == "ALL" || option.empty()) {
    for (std::size_t p = 0; p < b_.model.parts.size(); ++p) {
      const auto s = segments_of_part(static_cast<PartIndex>(p));
      found.insert(found.end(), s.begin(), s.end());
    }
  } else if (option == "SEG") {
    Segment s{b_.node(row, "e1"), b_.node(row, "e2"), b_.node(row, "e3"), none};
    s[3] = row.id("e4", IdKind::node) == 0 ? s[2] : b_.node(row, "e4");
    found.push_back(s);
  } else if (option == "PART" || option == "BOX" || option == "SHELL" || option == "SET_SHELL" ||
             option == "SET_SEGMENT" || option == "SET_SGMT") {
    for (int i = 1; i <= 7; ++i) {
      const std::string field = field_name("e", i);
      if (row.blank(field) || row.integer(field) == 0) continue;
      std::vector<Segment> some;
      if (option == "PART") {
        if (const PartIndex p = b_.reference(row, field, b_.parts); p != none) some = segments_of_part(p);
      } else if (option == "BOX") {
        const Index box = b_.reference(row, field, b_.boxes);
        for (std::size_t p = 0; box != none && p < b_.model.parts.size(); ++p) {
          for (const Segment& s : segments_of_part(static_cast<PartIndex>(p))) {
            if (std::all_of(s.begin(), s.end(),
                            [&](NodeIndex n) { return inside(b_.box_list[at(box)], b_.model.nodes.x[at(n)]); }))
              some.push_back(s);
          }
        }
      } else if (option == "SHELL") {
        const UserId id = row.id(field, IdKind::element);
        const Index e = find_member(SetKind::shell, id);
        if (e == none)
          row.error(field, "shell " + std::to_string(id) + " is not defined", "define it or take it out of the set");
        else
          some.push_back(b_.model.shells.nodes[at(e)]);
      } else if (option == "SET_SHELL") {
        const Index set = reference(row, field, SetKind::shell);
        if (set != none)
          for (const Index e : members_of_set(SetKind::shell, set)) some.push_back(b_.model.shells.nodes[at(e)]);
      } else if (const Index set = reference(row, field, SetKind::segment); set != none) {
        some = b_.model.segment_sets[at(set)].segments;
      }
      found.insert(found.end(), some.begin(), some.end());
    }
  } else {
    row.error("option",
              "found " + option +
                  ", expected ALL, PART, BOX, SEG, SHELL, SET_SHELL or SET_SEGMENT (with D in front to delete)",
              "correct the option");
  }
  std::erase_if(found, lacks_node);
  if (!remove_them) {
    g.segments.insert(g.segments.end(), found.begin(), found.end());
    return;
  }
  std::set<Segment> gone;
  for (const Segment& s : found) gone.insert(sorted_corners(s));
  std::erase_if(g.segments, [&](const Segment& s) { return gone.contains(sorted_corners(s)); });
}

}  // namespace kardan::deck

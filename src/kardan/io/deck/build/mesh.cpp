// *NODE and *ELEMENT: the large tables, read by field index.
#include <algorithm>
#include <array>
#include <set>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/measure.hpp"

namespace kardan::deck {

namespace {

/// Dof bits of the codes 0-7 of TC and RC: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz.
constexpr std::array<std::uint8_t, 8> code_bits{0, 1, 2, 4, 3, 6, 5, 7};

std::string id_text(UserId id) {
  return std::to_string(id);
}

std::size_t kind_index(ElementKind kind) {
  return static_cast<std::size_t>(kind);
}

constexpr int first_node = 2;  // field of N1 on the element cards

/// Reads the number, the part and the nodes of an element line; false where it cannot be entered.
class ElementLine {
 public:
  ElementLine(Builder& builder, ElementKind kind, const char* what) : builder_(builder), kind_(kind), what_(what) {}

  /// Part and number; false (reported) where one is wrong.
  bool head(const Card& card, int eid_field, int pid_field, Index index) {
    id_ = card.id(eid_field, IdKind::element);
    const UserId pid = card.id(pid_field, IdKind::part);
    part_ = builder_.parts.find(pid);
    if (id_ <= 0) {
      card.error("eid", "found " + id_text(id_) + ", expected the positive number of an element");
      return false;
    }
    if (!builder_.elements[kind_index(kind_)].emplace(id_, index).second) {
      card.error("eid", std::string(what_) + " " + id_text(id_) + " is defined twice",
                 "give each element its own number");
      return false;
    }
    if (part_ == none && missing_parts_.insert(pid).second) {
      card.error("pid", "part " + id_text(pid) + " of " + what_ + " " + id_text(id_) + " is not defined",
                 "define it with *PART or correct the number");
    }
    return true;
  }

  /// Node of the field that stands `field - n1` after N1; 0 gives none without a message.
  NodeIndex node(const Card& card, int field, int n1 = first_node) {
    const UserId n = card.id(field, IdKind::node);
    if (n == 0) return none;
    const NodeIndex i = builder_.model.nodes.index_of.index(n);
    if (i == none) missing_node(card, "n" + std::to_string(field - n1 + 1), n);
    return i;
  }

  void repeated(const Card& card, NodeIndex n) {
    card.error_on_card("node " + id_text(builder_.model.nodes.id[static_cast<std::size_t>(n)]) + " is repeated in " +
                           what_ + " " + id_text(id_),
                       "correct the connectivity");
  }
  void absent(const Card& card, const char* field) {
    card.error(field, std::string("is blank or 0 in ") + what_ + " " + id_text(id_) + ", expected a node");
  }

  UserId id() const { return id_; }
  PartIndex part() const { return part_; }

 private:
  void missing_node(const Card& card, const std::string& field, UserId n) {
    card.error(field, "node " + id_text(n) + " of " + what_ + " " + id_text(id_) + " is not defined",
               "define it with *NODE or correct the connectivity");
  }

  Builder& builder_;
  ElementKind kind_;
  const char* what_;
  UserId id_ = 0;
  PartIndex part_ = none;
  std::set<UserId> missing_parts_;  // each is reported once in a block
};

/// Enters a quadrilateral or triangle; returns whether it was entered.
bool add_shell(Builder& b, ElementLine& line, const Card& card) {
  ShellElements& shells = b.model.shells;
  if (!line.head(card, 0, 1, static_cast<Index>(shells.size()))) return false;
  std::array<NodeIndex, 4> n{};
  for (int i = 0; i < 4; ++i) n[static_cast<std::size_t>(i)] = line.node(card, first_node + i);
  if (card.id(first_node + 3, IdKind::node) == 0) n[3] = n[2];
  for (int i = 0; i < 3; ++i) {
    if (card.id(first_node + i, IdKind::node) == 0) line.absent(card, i == 0 ? "n1" : (i == 1 ? "n2" : "n3"));
  }
  const bool all = n[0] != none && n[1] != none && n[2] != none && n[3] != none;
  if (all) {
    if (n[0] == n[1] || n[0] == n[2] || n[0] == n[3])
      line.repeated(card, n[0]);
    else if (n[1] == n[2] || n[1] == n[3])
      line.repeated(card, n[1]);
  }
  for (int i = 4; i < 8; ++i) {
    if (card.id(first_node + i, IdKind::node) != 0) {
      b.unsupported(card, "n5", "an 8-node shell is not available", "use 4-node shells");
      break;
    }
  }
  shells.id.push_back(line.id());
  shells.part.push_back(line.part());
  shells.nodes.push_back(n);
  return true;
}

/// Fills the corners of a solid from up to ten nodes given and enters it.
void add_solid(Builder& b, ElementLine& line, const Card& card, const std::array<NodeIndex, 10>& given, bool ten) {
  SolidElements& solids = b.model.solids;
  std::array<NodeIndex, 8> n{};
  std::copy_n(given.begin(), 8, n.begin());
  if (ten && given[8] != none && given[9] != none && given[8] != given[7] && given[9] != given[7]) {
    b.unsupported(card, "n9", "a 10-node tetrahedron is not available", "use 4-node tetrahedra");
    for (std::size_t i = 4; i < 8; ++i) n[i] = n[3];
  }
  for (std::size_t i = 4; i < 8; ++i) {  // a shorter list ends in zeros: the last node is repeated
    if (n[i] == none) n[i] = n[i - 1];
  }
  std::array<NodeIndex, 8> corners = n;
  std::sort(corners.begin(), corners.end());
  const auto distinct = std::unique(corners.begin(), corners.end()) - corners.begin();
  if (corners[0] == none) {
    card.error_on_card("solid " + id_text(line.id()) + " has fewer than four nodes that exist",
                       "correct the connectivity");
  } else if (distinct < 4) {
    card.error_on_card("solid " + id_text(line.id()) + " has only " + std::to_string(distinct) + " different nodes",
                       "a tetrahedron needs four");
  }
  solids.id.push_back(line.id());
  solids.part.push_back(line.part());
  solids.nodes.push_back(n);
}

}  // namespace

void build_nodes(Builder& b, Block& block) {
  Nodes& nodes = b.model.nodes;
  const IncludeContext& context = block.context();
  const std::size_t before = nodes.size(), expected = before + block.lines_left();
  nodes.id.reserve(expected);
  nodes.x.reserve(expected);
  nodes.constrained.reserve(expected);
  block.for_each("card0", [&](const Card& card) {
    const UserId id = card.id(0, IdKind::node);
    if (id <= 0) {
      card.error("nid", "found " + id_text(id) + ", expected the positive number of a node");
      return;
    }
    const Vec3 x = context.trivial ? Vec3{card.real(1), card.real(2), card.real(3)} : card.point("x");
    const auto entered = nodes.index_of.emplace(id, static_cast<NodeIndex>(nodes.size()));
    if (!entered.second) {
      const auto first = static_cast<std::size_t>(entered.first->second);
      if (nodes.x[first] == x) {
        card.warning("nid", "node " + id_text(id) + " is defined twice with the same coordinates; the first one holds");
      } else {
        card.error("nid", "node " + id_text(id) + " is defined twice with different coordinates",
                   "remove one of the two or give it another number");
      }
      return;
    }
    const std::int64_t tc = card.blank(4) ? 0 : card.integer(4), rc = card.blank(5) ? 0 : card.integer(5);
    std::uint8_t bits = 0;
    for (const auto& [code, name, shift] : {std::tuple{tc, "tc", 0}, std::tuple{rc, "rc", 3}}) {
      if (code < 0 || code > 7) {
        card.error(name, "found " + std::to_string(code) + ", expected a constraint code from 0 to 7");
      } else {
        bits = static_cast<std::uint8_t>(bits | code_bits[static_cast<std::size_t>(code)] << shift);
      }
    }
    nodes.id.push_back(id);
    nodes.x.push_back(x);
    nodes.constrained.push_back(bits);
  });
}

void build_shells(Builder& b, Block& block) {
  ShellElements& shells = b.model.shells;
  const std::size_t expected = shells.size() + block.lines_left();
  shells.id.reserve(expected);
  shells.part.reserve(expected);
  shells.nodes.reserve(expected);
  ElementLine line(b, ElementKind::shell, "shell");
  const bool thickness = block.has("THICKNESS"), beta = block.has("BETA"), mcid = block.has("MCID"),
             offset = block.has("OFFSET");
  if (!thickness && !beta && !mcid && !offset) {
    block.for_each("card0", [&](const Card& card) { add_shell(b, line, card); });
    return;
  }
  while (!block.at_end()) {
    const Card card = block.next("card0");
    const bool added = add_shell(b, line, card);
    if (thickness || beta || mcid) {
      const Card sizes = block.next("thickness");
      std::array<double, 4> t{sizes.real("thic1", dimension::length), sizes.real("thic2", dimension::length),
                              sizes.real("thic3", dimension::length), sizes.real("thic4", dimension::length)};
      if (t[0] != 0) {
        for (std::size_t i = 1; i < 4; ++i) {
          if (t[i] == 0) t[i] = t[0];
        }
        if (added) shells.thickness[static_cast<Index>(shells.size()) - 1] = t;
      }
    }
    if (offset) {
      const double height = block.next("offset").real("offset", dimension::length);
      if (added) shells.offset[static_cast<Index>(shells.size()) - 1] = height;
    }
  }
}

void build_solids(Builder& b, Block& block) {
  if (block.at_end()) return;
  SolidElements& solids = b.model.solids;
  const std::size_t expected = solids.size() + block.lines_left();
  solids.id.reserve(expected);
  solids.part.reserve(expected);
  solids.nodes.reserve(expected);
  ElementLine line(b, ElementKind::solid, "solid");
  std::array<NodeIndex, 10> n{};
  const Card first = block.peek("card0");
  bool two_lines = true;
  for (int i = 0; i < 8 && two_lines; ++i) two_lines = first.blank(first_node + i);
  if (!two_lines) {
    block.for_each("card0", [&](const Card& card) {
      if (!line.head(card, 0, 1, static_cast<Index>(solids.size()))) return;
      n.fill(none);
      for (int i = 0; i < 8; ++i) n[static_cast<std::size_t>(i)] = line.node(card, first_node + i);
      add_solid(b, line, card, n, false);
    });
    return;
  }
  while (!block.at_end()) {
    const Card head = block.next("head");
    const Card nodes = block.next("nodes");
    if (!line.head(head, 0, 1, static_cast<Index>(solids.size()))) continue;
    n.fill(none);
    for (int i = 0; i < 10; ++i) n[static_cast<std::size_t>(i)] = line.node(nodes, i, 0);
    add_solid(b, line, nodes, n, true);
  }
}

namespace {

/// PARM1 to PARM5 of *ELEMENT_BEAM_THICKNESS mean what the section's sizes mean.
std::array<double, 5> read_beam_sizes(Builder& b, const Card& card, PartIndex part) {
  const Index section = part == none ? none : b.model.parts[static_cast<std::size_t>(part)].section;
  const int elform = section == none ? 1 : b.model.sections[static_cast<std::size_t>(section)].beam.elform;
  const Dimension length = dimension::length, area = dimension::area, moment{0, 4, 0};
  std::array<Dimension, 5> unit{length, length, length, length, length};
  if (elform == 2 || elform == 3 || elform == 12 || elform == 13) unit = {area, moment, moment, moment, area};
  if (elform == 6) {
    unit = {Dimension{0, 3, 0}, dimension::inertia, dimension::none, area, length};
    b.refuse_nonzero(card, "parm3", "a coordinate system by element", "give CID of *SECTION_BEAM");
  }
  std::array<double, 5> sizes{};
  for (std::size_t i = 0; i < 5; ++i) sizes[i] = card.real("parm" + std::to_string(i + 1), unit[i]);
  return sizes;
}

}  // namespace

void build_beams(Builder& b, Block& block) {
  BeamElements& beams = b.model.beams;
  ElementLine line(b, ElementKind::beam, "beam");
  const bool thickness = block.has("THICKNESS"), parts = block.has("PID"), orientation = block.has("ORIENTATION");
  while (!block.at_end()) {
    const Card card = block.next("card0");
    const auto e = static_cast<Index>(beams.size());
    const bool good = line.head(card, 0, 1, e);
    if (good) {
      const std::array<NodeIndex, 3> n{line.node(card, 2), line.node(card, 3), line.node(card, 4)};
      if (card.id(2, IdKind::node) == 0) line.absent(card, "n1");
      if (card.id(3, IdKind::node) == 0) line.absent(card, "n2");
      if (n[0] != none && n[0] == n[1]) line.repeated(card, n[0]);
      for (const char* release : {"rt1", "rr1", "rt2", "rr2"}) {
        b.refuse_nonzero(card, release, "a release of the beam's end", "model it with a joint, or leave it out");
      }
      beams.id.push_back(line.id());
      beams.part.push_back(line.part());
      beams.nodes.push_back(n);
    }
    if (thickness) {
      const Card sizes = block.next("thickness");
      if (good) beams.sizes[e] = read_beam_sizes(b, sizes, line.part());
    }
    if (parts) block.next("parts");  // the parts that a spot weld joins: for output and the search of a weld's partners only
    if (orientation) {
      const Vec3 vector = block.next("orientation").direction("vx");
      if (good && norm(vector) > 0) beams.orientation[e] = vector;
    }
  }
}

void build_discretes(Builder& b, Block& block) {
  DiscreteElements& elements = b.model.discretes;
  ElementLine line(b, ElementKind::discrete, "discrete element");
  block.for_each("card0", [&](const Card& card) {
    if (!line.head(card, 0, 1, static_cast<Index>(elements.size()))) return;
    std::array<NodeIndex, 2> n{line.node(card, 2), line.node(card, 3)};
    const bool first = card.id(2, IdKind::node) != 0, second = card.id(3, IdKind::node) != 0;
    if (!first && !second) line.absent(card, "n1");
    if (!first && second) std::swap(n[0], n[1]);  // the node that exists is the first, ground the second
    if (n[0] != none && n[0] == n[1]) line.repeated(card, n[0]);
    elements.id.push_back(line.id());
    elements.part.push_back(line.part());
    elements.nodes.push_back(n);
    elements.orientation.push_back(b.optional_reference(card, "vid", b.sd_orientations));
    elements.scale.push_back(Builder::real_or(card, "s", 1.0));
    const std::int64_t print = card.integer("pf");
    elements.print.push_back(print == 0 ? 0 : 1);
    // The offset is a rotation for torsional elements, a length otherwise; the section decides.
    const PartIndex p = line.part();
    const Index section = p == none ? none : b.model.parts[static_cast<std::size_t>(p)].section;
    const bool torsional = section != none && b.model.sections[static_cast<std::size_t>(section)].discrete.dro == 1;
    elements.offset.push_back(card.real("offset", torsional ? dimension::none : dimension::length));
  });
}

void build_mass(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    const NodeIndex n = b.node(card, "nid");
    const double mass = card.real("mass", dimension::mass);
    if (mass < 0) card.error("mass", "is negative", "give a positive mass");
    b.model.masses.push_back({card.id("eid", IdKind::element), n, mass, b.optional_reference(card, "pid", b.parts)});
  });
}

void build_mass_node_set(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    const double mass = card.real("mass", dimension::mass);
    if (mass < 0) card.error("mass", "is negative", "give a positive mass");
    const PartIndex part = b.optional_reference(card, "pid", b.parts);
    for (const NodeIndex n : b.node_set(card, "nsid")) {
      b.model.masses.push_back({card.id("eid", IdKind::element), n, mass, part});
    }
  });
}

void build_mass_part(Builder& b, Block& block) {
  const bool by_set = block.has("SET");
  block.for_each("card0", [&](const Card& card) {
    b.refuse_nonzero(card, "lcid", "a curve for the added mass", "leave it out: the mass is then constant");
    std::vector<PartIndex> parts;
    if (by_set)
      parts = b.part_set(card, "id");
    else if (const PartIndex p = b.reference(card, "id", b.parts); p != none)
      parts = {p};
    const double added = card.real("addmass", dimension::mass), final_mass = card.real("finmass", dimension::mass);
    if ((added == 0) == (final_mass == 0)) {
      card.error("addmass", "expected one of ADDMASS and FINMASS, found " + std::string(added == 0 ? "none" : "both"));
      return;
    }
    if (const std::string fault = distribute_mass(b.model, parts, added, final_mass, card.integer("mwd") == 1);
        !fault.empty()) {
      card.error("id", fault, "name a part with shells, solids or beams and a density");
    }
  });
}

void build_inertia(Builder& b, Block& block) {
  while (!block.at_end()) {
    const Card card = block.next("card0");
    const Card tensor = block.next("card1");
    PointInertia inertia;
    inertia.id = card.id("eid", IdKind::element);
    inertia.node = b.node(card, "nid");
    inertia.frame = b.optional_reference(card, "csid", b.frames);
    inertia.mass = tensor.real("mass", dimension::mass);
    inertia.inertia = read_inertia(tensor);
    if (block.has("OFFSET")) {
      const Card offset = block.next("offset");
      for (const char* field : {"x_off", "y_off", "z_off"}) {
        b.refuse_nonzero(offset, field, "an offset of the inertia from its node", "put a node where the mass is");
      }
    }
    b.model.inertias.push_back(inertia);
  }
}

}  // namespace kardan::deck

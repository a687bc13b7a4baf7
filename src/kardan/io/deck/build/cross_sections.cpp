// *DATABASE_CROSS_SECTION_SET and _PLANE.
#include <algorithm>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A plane, or a piece of it.
struct Plane {
  Vec3 tail, normal;
  double radius = 0;          ///< > 0: a disc about the tail
  Vec3 along{}, across{};     ///< edges L and M of a rectangle whose corner is the tail
  double lengths[2] = {0, 0}; ///< of the edges; 0 = unlimited

  double distance(const Vec3& x) const { return dot(x - tail, normal); }
  bool holds(const Vec3& x) const {
    const Vec3 d = x - tail;
    if (radius > 0) return norm(d - normal * dot(d, normal)) <= radius;
    if (!(lengths[0] > 0) || !(lengths[1] > 0)) return true;
    const double l = dot(d, along), m = dot(d, across);
    return l >= 0 && l <= lengths[0] && m >= 0 && m <= lengths[1];
  }
};

Plane read_plane(const Card& card, const Card& edges) {
  Plane p;
  p.tail = card.point("xct");
  const Vec3 n = card.point("xch") - p.tail;
  if (!(norm(n) > 0)) {
    card.error("xch", "is the same point as the tail", "give the head of the plane's normal");
    return p;
  }
  p.normal = n * (1 / norm(n));
  p.radius = card.real("radius", dimension::length);
  p.lengths[0] = edges.real("lenl", dimension::length);
  p.lengths[1] = edges.real("lenm", dimension::length);
  if (p.radius > 0 || !(p.lengths[0] > 0) || !(p.lengths[1] > 0)) return p;
  const Vec3 edge = edges.point("xhev") - p.tail, flat = edge - p.normal * dot(edge, p.normal);
  if (!(norm(flat) > 0)) {
    edges.error("xhev", "does not lie beside the normal", "give the head of the edge vector L in the plane");
    return p;
  }
  p.along = flat * (1 / norm(flat));
  p.across = cross(p.normal, p.along);
  return p;
}

/// Elements of one kind that the plane cuts, and their nodes on the head's side.
template <class Block>
void cut(const Model& model, const Block& block, std::size_t nodes_used, const std::vector<bool>& wanted, const Plane& plane,
         std::vector<Index>& elements, std::vector<NodeIndex>& nodes) {
  for (std::size_t e = 0; e < block.size(); ++e) {
    if (!wanted[at(block.part[e])] || model.rigid_part(block.part[e])) continue;
    std::vector<NodeIndex> head, tail;
    for (std::size_t a = 0; a < nodes_used; ++a) {
      const NodeIndex n = block.nodes[e][a];
      if (n != none) (plane.distance(model.nodes.x[at(n)]) > 0 ? head : tail).push_back(n);
    }
    if (head.empty() || tail.empty()) continue;
    Vec3 middle;
    for (const NodeIndex h : head) {
      for (const NodeIndex t : tail) {
        const Vec3 &x = model.nodes.x[at(h)], &y = model.nodes.x[at(t)];
        const double dx = plane.distance(x), dy = plane.distance(y);
        middle += x + (y - x) * (dx / (dx - dy));
      }
    }
    if (!plane.holds(middle * (1.0 / static_cast<double>(head.size() * tail.size())))) continue;
    elements.push_back(static_cast<Index>(e));
    nodes.insert(nodes.end(), head.begin(), head.end());
  }
}

CrossSection read_plane_section(Builder& b, Block& block, const Card& card, const Card& edges) {
  CrossSection section;
  if (card.real("radius") < 0) b.unsupported(card, "radius", "a radius taken from a part is not available", "give the radius itself");
  std::vector<bool> wanted(b.model.parts.size(), card.integer("psid") == 0);
  if (card.integer("psid") != 0) {
    for (const PartIndex p : b.part_set(card, "psid")) wanted[at(p)] = true;
  }
  const Plane plane = read_plane(card, edges);
  const Model& m = b.model;
  const auto of = [&](ElementKind kind) -> std::vector<Index>& { return section.elements[static_cast<std::size_t>(kind)]; };
  cut(m, m.shells, 4, wanted, plane, of(ElementKind::shell), section.nodes);
  cut(m, m.solids, 8, wanted, plane, of(ElementKind::solid), section.nodes);
  cut(m, m.beams, 2, wanted, plane, of(ElementKind::beam), section.nodes);
  cut(m, m.discretes, 2, wanted, plane, of(ElementKind::discrete), section.nodes);
  if (section.nodes.empty()) block.warning("the plane cuts no deformable element: its forces will be zero", "check the plane");
  return section;
}

CrossSection read_set_section(Builder& b, const Card& card) {
  CrossSection section;
  section.nodes = b.node_set(card, "nsid");
  const auto add = [&](const char* field, SetKind kind, ElementKind element) {
    if (card.integer(field) == 0) return;
    const Index set = b.sets->reference(card, field, kind);
    if (set != none) section.elements[static_cast<std::size_t>(element)] = b.model.element_sets[at(set)].elements;
  };
  add("hsid", SetKind::solid, ElementKind::solid);
  add("bsid", SetKind::beam, ElementKind::beam);
  add("ssid", SetKind::shell, ElementKind::shell);
  add("dsid", SetKind::discrete, ElementKind::discrete);
  b.ignored(card, "tsid", "thick shells are not computed");
  return section;
}

}  // namespace

void build_cross_section(Builder& b, Block& block) {
  do {
    const Card head = block.next_if(block.has("ID"), "id");
    const Card card = block.next("card0");
    if (!card.present()) return;
    const bool plane = block.keyword == "DATABASE_CROSS_SECTION_PLANE";
    const Card edges = plane ? block.next_optional("card1") : card;
    CrossSection section = plane ? read_plane_section(b, block, card, edges) : read_set_section(b, card);
    std::sort(section.nodes.begin(), section.nodes.end());
    section.nodes.erase(std::unique(section.nodes.begin(), section.nodes.end()), section.nodes.end());
    section.id = head.present() ? head.id("csid", IdKind::other) : static_cast<UserId>(b.model.cross_sections.size()) + 1;
    if (head.present()) section.title = head.text("heading");
    if (edges.integer("itype") == 2)
      section.frame = b.reference(edges, "id", b.frames);
    else
      b.ignored(edges, "id", "the forces are given in global axes, not in those of a rigid body or accelerometer");
    b.model.cross_sections.push_back(std::move(section));
  } while (!block.at_end());
}

}  // namespace kardan::deck

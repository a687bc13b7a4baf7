// *RIGIDWALL_PLANAR.
#include <algorithm>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

namespace {

/// Nodes of the set, or all; without those of NSIDEX, outside of BOXID or farther than OFFSET.
std::vector<NodeIndex> tracked_nodes(Builder& b, const Card& card, const RigidWall& wall) {
  std::vector<NodeIndex> nodes;
  if (card.id("nsid", IdKind::set) != 0) {
    nodes = b.node_set(card, "nsid");
  } else {
    nodes.resize(b.model.nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<NodeIndex>(n);
  }
  std::sort(nodes.begin(), nodes.end());
  if (card.id("nsidex", IdKind::set) != 0) {
    std::vector<NodeIndex> exempt = b.node_set(card, "nsidex");
    std::sort(exempt.begin(), exempt.end());
    std::erase_if(nodes, [&](NodeIndex n) { return std::binary_search(exempt.begin(), exempt.end(), n); });
  }
  const auto place = [&](NodeIndex n) -> const Vec3& { return b.model.nodes.x[static_cast<std::size_t>(n)]; };
  if (const Index box = b.optional_reference(card, "boxid", b.boxes); box != none) {
    const Box& bounds = b.box_list[static_cast<std::size_t>(box)];
    std::erase_if(nodes, [&](NodeIndex n) {
      const Vec3& x = place(n);
      for (std::size_t k = 0; k < 3; ++k)
        if (x[k] < bounds.low[k] || x[k] > bounds.high[k]) return true;
      return false;
    });
  }
  if (const double offset = card.real("offset", dimension::length); offset > 0)
    std::erase_if(nodes, [&](NodeIndex n) { return dot(place(n) - wall.point, wall.normal) > offset; });
  return nodes;
}

}  // namespace

void build_rigid_wall(Builder& b, Block& block) {
  while (!block.at_end()) {
    RigidWall wall;
    wall.id = static_cast<UserId>(b.model.rigid_walls.size()) + 1;
    if (block.has("ID")) {
      const Card named = block.next("id");
      if (named.integer("id") != 0) wall.id = named.integer("id");
      wall.title = named.text("heading");
    }
    const Card who = block.next("card0");
    if (!who.present()) return;
    const Card where = block.next("card1");
    wall.point = where.point("xt");
    const Vec3 normal = where.point("xh") - wall.point;
    if (!(norm(normal) > 0)) {
      where.error("xh", "the head of the normal lies at its tail", "give the vector two different ends");
      return;
    }
    wall.normal = normalized(normal);
    wall.friction = where.real("fric");
    if (wall.friction < 0 || wall.friction > 1) {
      b.unsupported(where, "fric", "nodes that are welded to the wall (FRIC = " + where.text("fric") + ") are not available",
                    "give 0 (frictionless), Coulomb's coefficient below 1, or 1 (no sliding)");
    }
    wall.birth = who.real("birth", dimension::time);
    wall.death = Builder::time_or(who, "death", 1e20);
    wall.nodes = tracked_nodes(b, who, wall);
    b.model.rigid_walls.push_back(std::move(wall));
  }
}

}  // namespace kardan::deck

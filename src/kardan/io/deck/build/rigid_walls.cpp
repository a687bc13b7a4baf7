// *RIGIDWALL_PLANAR_…, *RIGIDWALL_GEOMETRIC_….
#include <algorithm>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

/// Nodes of the set, or all; without those of NSIDEX, outside of BOXID or farther than OFFSET.
std::vector<NodeIndex> tracked_nodes(Builder& b, const Card& card, const RigidWall& wall, double offset) {
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
  if (offset > 0)
    std::erase_if(nodes, [&](NodeIndex n) { return dot(place(n) - wall.point, wall.normal) > offset; });
  return nodes;
}

/// Unit vector of three fields; an error where they are all zero.
bool read_direction(const Card& card, std::string_view field, const Vec3& given, const char* what, Vec3& direction) {
  if (!(norm(given) > 0)) {
    card.error(field, what, "give it a length");
    return false;
  }
  direction = normalized(given);
  return true;
}

/// FRIC and WVEL. Welds are fields of planar walls only.
void read_friction(Builder& b, const Block& block, const Card& card, RigidWall& wall) {
  const double friction = card.real("fric");
  const bool planar = block.keyword == "RIGIDWALL_PLANAR";
  if (friction < 0 || friction > 3 || (friction > 1 && friction != 2 && friction != 3)) {
    card.error("fric", "FRIC is 0 (frictionless), Coulomb's coefficient below 1, 1 (no sliding), or of planar walls 2 or 3 (nodes are welded)");
    return;
  }
  if (friction > 1 && !planar) {
    b.unsupported(card, "fric", "nodes that are welded to the wall (FRIC = " + card.text("fric") + ") are available for planar walls only",
                  "give 0 (frictionless), Coulomb's coefficient below 1, or 1 (no sliding)");
    return;
  }
  wall.welds = friction > 1;
  wall.friction = wall.welds ? friction - 2 : friction;
  if (planar) wall.weld_velocity = card.real("wvel", dimension::velocity);
}

void read_orthotropic_friction(Builder& b, Block& block, RigidWall& wall) {
  const Card friction = block.next("friction"), direction = block.next("direction");
  OrthotropicFriction o;
  o.statical = {friction.real("sfrica"), friction.real("sfricb")};
  o.dynamic = {friction.real("dfrica"), friction.real("dfricb")};
  constexpr Dimension per_velocity{0, -1, 1};
  o.decay = {friction.real("decaya", per_velocity), friction.real("decayb", per_velocity)};
  o.node1 = b.optional_node(direction, "node1");
  o.node2 = b.optional_node(direction, "node2");
  const bool by_nodes = o.node1 != none && o.node2 != none && o.node1 != o.node2;
  if (!by_nodes) {
    o.node1 = o.node2 = none;
    o.direction = direction.direction("d1");
    if (!(norm(cross(o.direction, wall.normal)) > 1e-9 * norm(o.direction)))
      direction.error("d1", "friction of _ORTHO has no direction in the wall's plane", "give NODE1 and NODE2, or D1, D2, D3");
  }
  if (wall.friction > 0 || wall.welds) b.ignored(direction, "node1", "FRIC has no effect beside _ORTHO");
  wall.friction = 0;
  wall.welds = false;
  wall.orthotropic = o;
}

/// XHEV … and the lengths of a finite plane or a prism.
bool read_edges(const Card& card, RigidWall& wall) {
  wall.length_l = card.real("lenl", dimension::length);
  wall.length_m = card.real("lenm", dimension::length);
  if (wall.shape == RigidWall::Shape::prism) wall.length_p = card.real("lenp", dimension::length);
  if (wall.length_l < 0 || wall.length_m < 0 || wall.length_p < 0) {
    card.error("lenl", "lengths of a wall cannot be negative", "0 makes it infinite in that direction");
    return false;
  }
  if (wall.length_l == 0 && wall.length_m == 0) return true;
  const Vec3 edge = card.point("xhev") - wall.point;
  if (!read_direction(card, "xhev", edge - wall.normal * dot(edge, wall.normal),
                      "the head of the edge vector l lies on the wall's normal", wall.edge_l))
    return false;
  wall.edge_m = cross(wall.normal, wall.edge_l);
  return true;
}

bool read_cylinder(Builder& b, Block& block, RigidWall& wall) {
  const Card card = block.next("cylinder");
  wall.radius = card.real("radcyl", dimension::length);
  wall.length_p = card.real("lencyl", dimension::length);
  wall.interior = block.has("INTERIOR");
  if (!(wall.radius > 0) || wall.length_p < 0) {
    card.error("radcyl", "a cylinder needs a radius, and a length that is not negative", "LENCYL = 0 makes it infinite");
    return false;
  }
  const std::int64_t sections = card.integer("nsegs");
  if (sections > 0) b.ignored(card, "nsegs", "the wall's force is reported as a whole, not by sections of the cylinder");
  for (std::int64_t i = 0; i < sections && !block.at_end(); ++i) block.next("section");
  return true;
}

/// The cards between FRIC and the options of a geometric wall.
bool read_shape(Builder& b, Block& block, RigidWall& wall) {
  using Shape = RigidWall::Shape;
  if (block.keyword == "RIGIDWALL_GEOMETRIC_FLAT") return read_edges(block.next("edges"), wall);
  if (block.keyword == "RIGIDWALL_GEOMETRIC_PRISM") {
    wall.shape = Shape::prism;
    return read_edges(block.next("edges"), wall);
  }
  if (block.keyword == "RIGIDWALL_GEOMETRIC_CYLINDER") {
    wall.shape = Shape::cylinder;
    return read_cylinder(b, block, wall);
  }
  wall.shape = Shape::sphere;
  const Card card = block.next("sphere");
  wall.radius = card.real("radsph", dimension::length);
  if (!(wall.radius > 0)) card.error("radsph", "a sphere needs a radius");
  return wall.radius > 0;
}

void read_motion(Builder& b, const Card& card, RigidWall& wall) {
  wall.motion = b.curve_or_constant(card, "lcid");
  wall.motion_is_displacement = b.integer_in(card, "opt", 0, 1) == 1;
  read_direction(card, "vx", card.direction("vx"), "the wall's motion has no direction", wall.motion_direction);
}

void read_forces(Builder& b, const Card& card, RigidWall& wall) {
  wall.soft_cycles = b.integer_in(card, "soft", 0, 65535);
  if (card.id("ssid", IdKind::set) == 0) return;
  if (const Index set = b.sets->reference(card, "ssid", SetKind::segment); set != none) wall.segments = b.model.segment_sets[set].segments;
}

/// The options of a planar wall: cards in the order of the manual.
bool read_planar_options(Builder& b, Block& block, RigidWall& wall) {
  if (block.has("ORTHO")) read_orthotropic_friction(b, block, wall);
  if (block.has("FINITE") && !read_edges(block.next("edges"), wall)) return false;
  if (block.has("MOVING")) {
    const Card card = block.next("moving");
    wall.mass = card.real("mass", dimension::mass);
    wall.velocity = card.real("v0", dimension::velocity);
    if (!(wall.mass > 0)) card.error("mass", "a wall that moves freely needs a mass");
  }
  if (block.has("FORCES")) read_forces(b, block.next("forces"), wall);
  return true;
}

/// @return false where what follows in the block cannot be read.
bool read_wall(Builder& b, Block& block, RigidWall& wall) {
  wall.id = static_cast<UserId>(b.model.rigid_walls.size()) + 1;
  if (block.has("ID")) {
    const Card named = block.next("id");
    if (named.integer("id") != 0) wall.id = named.integer("id");
    wall.title = named.text("heading");
  }
  const bool planar = block.keyword == "RIGIDWALL_PLANAR", sphere = block.keyword == "RIGIDWALL_GEOMETRIC_SPHERE";
  const Card who = block.next("card0");
  if (!who.present()) return false;
  const Card where = block.next("card1");
  wall.point = where.point("xt");
  wall.birth = who.real("birth", dimension::time);
  wall.death = Builder::time_or(who, "death", 1e20);
  const Vec3 normal = where.point("xh") - wall.point;
  if (!sphere && !read_direction(where, "xh", normal, "the head of the normal lies at its tail", wall.normal)) return false;
  read_friction(b, block, where, wall);
  if (!(planar ? read_planar_options(b, block, wall) : read_shape(b, block, wall))) return false;
  if (block.has("MOTION")) read_motion(b, block.next("motion"), wall);
  // What a picture of the wall looks like.
  if (block.has("DISPLAY") && !planar && !block.at_end()) block.next("display");
  if (planar) wall.penalty_scale = Builder::real_or(who, "rwksf", 1.0);
  wall.nodes = tracked_nodes(b, who, wall, planar ? who.real("offset", dimension::length) : 0.0);
  return true;
}

}  // namespace

void build_rigid_wall(Builder& b, Block& block) {
  while (!block.at_end()) {
    RigidWall wall;
    if (!read_wall(b, block, wall)) return;
    b.model.rigid_walls.push_back(std::move(wall));
  }
}

}  // namespace kardan::deck

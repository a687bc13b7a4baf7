// Nodal rigid bodies, merges, extra nodes, stoppers.
#include <algorithm>
#include <cmath>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void build_nodal_rigid_body(Builder& b, Block& block) {
  while (!block.at_end()) {
    NodalRigidBody body;
    if (block.has("TITLE")) body.title = block.next_title();
    const Card card = block.next("card0");
    if (!card.present()) return;
    body.id = card.id("pid", IdKind::part);
    body.frame = b.optional_reference(card, "cid", b.frames);
    const std::int64_t print_node = card.id("pnode", IdKind::node);
    if (print_node != 0) {
      body.print_node = b.model.nodes.index_of.index(std::abs(print_node));
      if (body.print_node == none) {
        card.error("pnode", "node " + std::to_string(std::abs(print_node)) + " is not defined",
                   "define it with *NODE or leave PNODE at 0");
      }
    }
    body.print = b.integer_in(card, "iprt", -2, 2);
    body.drflag = b.integer_in(card, "drflag", -7, 7);
    body.rrflag = b.integer_in(card, "rrflag", -7, 7);
    for (const char* release : {"drflag", "rrflag"}) {
      b.refuse_nonzero(card, release, "a release of the nodes of a nodal rigid body",
                       "connect the nodes by a joint instead");
    }
    if (block.has("SPC")) {
      const BodyConstraint c = read_body_constraint(b, block.next("spc"));
      body.cmo = c.cmo;
      body.con1 = c.con1;
      body.con2 = c.con2;
      body.constraint_frame = c.frame;
      body.constraint_point = c.point;
      body.constraint_node = c.node;
    }
    if (block.has("INERTIA")) body.inertia = read_given_inertia(b, block, "cid2");
    if (!b.parts.enter(card, "pid", static_cast<PartIndex>(b.model.parts.size()))) continue;

    // NSID = 0: the set has the number of the body. Numbers of sets are shifted by an include, so from the raw number.
    UserId set = card.id("nsid", IdKind::set);
    const bool default_set = set == 0;
    if (default_set) set = card.id("pid", IdKind::set);
    body.part = static_cast<PartIndex>(b.model.parts.size());
    Part part;
    part.id = body.id;
    part.title = body.title.empty() ? "nodal rigid body" : body.title;
    part.nodal_rigid_body = static_cast<Index>(b.model.nodal_rigid_bodies.size());
    b.model.parts.push_back(std::move(part));
    b.part_where.push_back({card.where(), false, false});
    b.pending_bodies.push_back({card, static_cast<Index>(b.model.nodal_rigid_bodies.size()), set, default_set});
    b.model.nodal_rigid_bodies.push_back(std::move(body));
  }
}

void finish_nodal_rigid_bodies(Builder& b) {
  for (const Builder::PendingBody& pending : b.pending_bodies) {
    const std::string_view field = pending.default_set ? "pid" : "nsid";
    const Index set = b.sets->find(SetKind::node, pending.set);
    if (set == none) {
      pending.card.error(field, "node set " + std::to_string(pending.set) + " is not defined",
                         "define it with *SET_NODE; NSID = 0 means the set that has the number of the body");
      continue;
    }
    const std::vector<NodeIndex>& nodes = b.model.node_sets[at(set)].nodes;
    if (nodes.empty())
      pending.card.error(field, "node set " + std::to_string(pending.set) + " is empty", "a rigid body needs nodes");
    b.model.nodal_rigid_bodies[at(pending.body)].nodes = nodes;
  }
}

void build_rigid_bodies(Builder& b, Block& block) {
  // Old decks write this keyword in columns of eight.
  static const CardLayout eight = [] {
    CardLayout layout;
    layout.name = "card0";
    int column = 0;
    for (const char* name : {"pidl", "pidc", "iflag"}) {
      FieldLayout field;
      field.name = name;
      field.type = 'I';
      field.position = column / 8;
      field.column = {column, column / 8 * 10, column / 8 * 20};
      field.width = {8, 10, 20};
      layout.fields.push_back(field);
      column += 8;
    }
    return layout;
  }();
  const auto known = [&](const Card& card) {
    return b.parts.find(card.id("pidl", IdKind::part)) != none && b.parts.find(card.id("pidc", IdKind::part)) != none;
  };
  while (!block.at_end()) {
    Block again = block;
    Card card = block.next("card0");
    if (!known(card)) {
      const Card narrow = again.next(eight);
      if (known(narrow)) card = narrow;
    }
    RigidBodyMerge merge{b.body(card, "pidl"), b.body(card, "pidc"), b.integer_in(card, "iflag", 0, 1)};
    if (merge.lead == none || merge.constrained == none) continue;
    if (merge.lead == merge.constrained) {
      card.error("pidc", "the part is merged with itself", "name two different parts");
      continue;
    }
    b.model.merges.push_back(merge);
  }
}

void build_extra_nodes(Builder& b, Block& block) {
  const bool by_set = block.keyword.ends_with("_SET");
  block.for_each("card0", [&](const Card& card) {
    ExtraNodes extra;
    extra.part = b.body(card, "pid");
    extra.iflag = b.integer_in(card, "iflag", 0, 1);
    if (by_set)
      extra.nodes = b.node_set(card, "nsid");
    else if (const NodeIndex n = b.node(card, "nid"); n != none)
      extra.nodes = {n};
    if (extra.part != none && !extra.nodes.empty()) b.model.extra_nodes.push_back(std::move(extra));
  });
}

void build_stoppers(Builder& b, Block& block) {
  const auto limit = [&](const Card& card, const char* field) {
    const UserId id = card.id(field, IdKind::curve);
    RigidBodyStopper::Limit l;
    l.displacement = id < 0;
    if (id != 0) l.curve = b.curve_of_id(card, field, std::abs(id));
    return l;
  };
  const auto followers = [&](const Card& card, const char* field) {
    std::vector<RigidBodyStopper::Follower> list;
    if (card.id(field, IdKind::set) == 0) return list;
    const Index set = b.sets->reference(card, field, SetKind::part);
    if (set == none) return list;
    const PartSet& parts = b.model.part_sets[at(set)];
    for (std::size_t i = 0; i < parts.parts.size(); ++i) {
      list.push_back({parts.parts[i], parts.attribute.empty() ? 0.0 : parts.attribute[i]});
    }
    return list;
  };
  while (!block.at_end()) {
    const Card card = block.next("card0");
    const Card times = block.next("card1");
    RigidBodyStopper s;
    s.part = b.body(card, "pid");
    s.maximum = limit(card, "lcmax");
    s.minimum = limit(card, "lcmin");
    s.followers_maximum = followers(card, "psidmx");
    s.followers_minimum = followers(card, "psidmn");
    s.velocity = b.optional_curve(card, "lcvmnx");
    s.direction = b.integer_in(card, "dir", 1, 8);
    s.vector = s.direction == 4 || s.direction == 8 ? b.reference(card, "vid", b.vectors) : none;
    s.birth = times.real("tb", dimension::time);
    s.death = Builder::time_or(times, "td", 1e21);
    if (s.part != none) b.model.stoppers.push_back(std::move(s));
  }
}

}  // namespace kardan::deck

// *DEFORMABLE_TO_RIGID, _AUTOMATIC.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <variant>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Gives part p a rigid material of its own with density and stiffness of its deformable one.
void make_rigid(Builder& b, const Card& card, PartIndex p) {
  Part& part = b.model.parts[at(p)];
  if (part.material == none || b.model.rigid_part(p)) return;  // reported elsewhere; rigid already
  Material material = b.model.materials[at(part.material)];
  RigidMaterial rigid;
  std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.density, law.youngs_modulus, law.poissons_ratio; }) {
          rigid.density = law.density;
          rigid.youngs_modulus = law.youngs_modulus;
          rigid.poissons_ratio = law.poissons_ratio;
        }
      },
      material.law);
  if (!(rigid.density > 0)) {
    card.error("pid", "part " + std::to_string(part.id) + " has a material without density: it cannot be a rigid body",
               "switch parts of solids, shells or beams");
    return;
  }
  material.law = rigid;
  part.material = static_cast<Index>(b.model.materials.size());
  b.model.materials.push_back(std::move(material));
  b.material_where.push_back({card.where(), card.block().as_written()});
}

/// The parts of a line: PID is a part or, by PTYPE, a part set.
std::vector<PartIndex> switched_parts(Builder& b, const Card& card) {
  const std::string type = card.text("ptype");
  if (type == "PSET") return b.part_set(card, "pid");
  if (type != "PART" && !type.empty()) {
    card.error("ptype", "found " + type + ", expected PART or PSET", "correct the value");
    return {};
  }
  const PartIndex p = b.reference(card, "pid", b.parts);
  return p == none ? std::vector<PartIndex>{} : std::vector<PartIndex>{p};
}

}  // namespace

void build_deformable_to_rigid(Builder& b, Block& block) {
  block.for_each("card0", [&](const Card& card) {
    const std::vector<PartIndex> parts = switched_parts(b, card);
    const PartIndex lead = b.optional_reference(card, "lrb", b.parts);
    for (const PartIndex p : parts) {
      make_rigid(b, card, p);
      if (lead != none && lead != p) b.model.merges.push_back({lead, p, 0});
      if (lead == none) b.switched_from_start.emplace_back(card, p);
    }
  });
}

void build_automatic_switch(Builder& b, Block& block) {
  while (!block.at_end()) {
    const Card card = block.next("card0");
    const Card more = block.next("card1");
    if (!more.present()) return;
    if (card.integer("code") != 0)
      b.unsupported(card, "code", "a switch by contact or wall forces (CODE = " + card.text("code") + ") is not available",
                    "use CODE = 0, a switch at TIME1");
    for (const char* field : {"relsw", "paired"}) b.refuse_nonzero(card, field, "a switch that waits for another one", "give its time");
    for (const char* field : {"nrbf", "ncsf", "rwf"})
      b.refuse_nonzero(more, field, "removal of constraints or walls by a switch", "leave the flag at 0");
    b.ignored(more, "dtmax", "the step is not lengthened: the elements of a part that is switched to rigid are still computed");
    const double time = card.real("time1", dimension::time);
    for (std::int64_t i = 0; i < more.integer("d2r"); ++i) {
      const Card line = block.next("to_rigid");
      const PartIndex lead = b.optional_reference(line, "lrb", b.parts);
      for (const PartIndex p : switched_parts(b, line)) b.part_switches.push_back({line, p, lead, time, true});
    }
    for (std::int64_t i = 0; i < more.integer("r2d"); ++i) {
      const Card line = block.next("to_deformable");
      for (const PartIndex p : switched_parts(b, line)) b.part_switches.push_back({line, p, none, time, false});
    }
  }
}

namespace {

/// The switch of part p to a rigid one, and back; nothing where there is none.
const Builder::PartSwitch* find_switch(const Builder& b, PartIndex p, bool to_rigid) {
  const auto hit = std::find_if(b.part_switches.begin(), b.part_switches.end(),
                                [&](const Builder::PartSwitch& s) { return s.part == p && s.to_rigid == to_rigid; });
  return hit == b.part_switches.end() ? nullptr : &*hit;
}

double end_of(const Builder& b, PartIndex p) {
  const Builder::PartSwitch* back = find_switch(b, p, false);
  return back ? back->time : 1e20;
}

bool valid(Builder& b, const Builder::PartSwitch& s) {
  const std::string name = "part " + std::to_string(b.model.parts[at(s.part)].id);
  const Builder::PartSwitch* first = find_switch(b, s.part, s.to_rigid);
  if (first != &s) {
    b.unsupported(s.card, "pid", name + " is switched twice in the same direction", "switch each part once, and back once");
  } else if (b.model.body_part(s.part)) {
    b.unsupported(s.card, "pid", name + " is rigid by its material or by *DEFORMABLE_TO_RIGID: it cannot be switched",
                  "give it a deformable material and switch it to rigid at TIME1 = 0");
  } else if (!s.to_rigid) {
    const Builder::PartSwitch* start = find_switch(b, s.part, true);
    if (start && start->time < s.time) return true;
    s.card.error("pid", name + " is made deformable without having been rigid before", "switch it to rigid at an earlier TIME1");
  } else if (s.lead != none && s.lead != s.part) {
    const Builder::PartSwitch* lead = find_switch(b, s.lead, true);
    if (lead && (lead->lead == none || lead->lead == s.lead) && lead->time == s.time && end_of(b, s.lead) == end_of(b, s.part)) return true;
    b.unsupported(s.card, "lrb", "a lead part that is not switched to rigid and back at the same times is not available",
                  "switch the lead part together with the others");
  } else {
    return true;
  }
  return false;
}

/// Three of the nodes span a plane: two rigid bodies that share them are one.
bool span_a_plane(const Nodes& nodes, const std::vector<NodeIndex>& shared) {
  if (shared.size() < 3) return false;
  const Vec3& origin = nodes.x[at(shared[0])];
  Vec3 longest{};
  for (const NodeIndex n : shared)
    if (const Vec3 arm = nodes.x[at(n)] - origin; norm(arm) > norm(longest)) longest = arm;
  return std::any_of(shared.begin(), shared.end(), [&](NodeIndex n) {
    const Vec3 arm = nodes.x[at(n)] - origin;
    return norm(cross(arm, longest)) > 1e-6 * dot(longest, longest);
  });
}

/// Deformable parts share nodes with others; where *DEFORMABLE_TO_RIGID makes both rigid, they are one body.
void join_neighbours(Builder& b) {
  const auto nodes_of = [&](PartIndex p) {
    std::vector<NodeIndex> nodes = b.sets->nodes_of_parts({p});
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (const auto& [card, part] : b.switched_from_start) {
    const std::vector<NodeIndex> own = nodes_of(part);
    for (std::size_t i = 0; i < b.model.parts.size(); ++i) {
      const auto other = static_cast<PartIndex>(i);
      const bool met_already = std::any_of(b.switched_from_start.begin(), b.switched_from_start.end(),
                                           [&](const auto& s) { return s.second == other && other < part; });
      const bool merged = std::any_of(b.model.merges.begin(), b.model.merges.end(), [&](const RigidBodyMerge& m) {
        return (m.lead == part && m.constrained == other) || (m.lead == other && m.constrained == part);
      });
      if (other == part || met_already || merged || !b.model.rigid_part(other)) continue;
      const std::vector<NodeIndex> theirs = nodes_of(other);
      std::vector<NodeIndex> shared;
      std::set_intersection(own.begin(), own.end(), theirs.begin(), theirs.end(), std::back_inserter(shared));
      if (!span_a_plane(b.model.nodes, shared)) continue;
      card.warning("pid", "part " + std::to_string(b.model.parts[at(part)].id) + " shares " + std::to_string(shared.size()) + " nodes with rigid part " +
                              std::to_string(b.model.parts[i].id) + ": the two are one rigid body",
                   "name the lead part in LRB to say so");
      b.model.merges.push_back({other, part, 0});
    }
  }
}

}  // namespace

void finish_switches(Builder& b) {
  join_neighbours(b);
  std::map<PartIndex, std::vector<PartIndex>> bodies;  // by lead part
  for (const Builder::PartSwitch& s : b.part_switches) {
    if (valid(b, s) && s.to_rigid) bodies[s.lead == none ? s.part : s.lead].push_back(s.part);
  }
  for (const auto& [lead, parts] : bodies) {
    const Builder::PartSwitch* start = find_switch(b, lead, true);
    if (start == nullptr) continue;  // reported
    RigidGroup group;
    group.name = "part " + std::to_string(b.model.parts[at(lead)].id) + ", switched to rigid,";
    group.nodes = b.sets->nodes_of_parts(parts);
    group.birth = start->time;
    group.death = end_of(b, lead);
    if (!group.nodes.empty()) b.model.rigid_groups.push_back(std::move(group));
  }
}

}  // namespace kardan::deck

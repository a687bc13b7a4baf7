// *CONSTRAINED_JOINT and *CONSTRAINED_JOINT_STIFFNESS.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

namespace {

/// What distinguishes the joints: how many of the points 1 to 6 they need.
struct JointRow {
  JointKind kind;
  int points;
};

const std::map<std::string, JointRow>& joint_rows() {
  static const std::map<std::string, JointRow> rows{{"SPHERICAL", {JointKind::spherical, 2}},
                                                    {"REVOLUTE", {JointKind::revolute, 4}},
                                                    {"CYLINDRICAL", {JointKind::cylindrical, 4}},
                                                    {"PLANAR", {JointKind::planar, 4}},
                                                    {"UNIVERSAL", {JointKind::universal, 4}},
                                                    {"TRANSLATIONAL", {JointKind::translational, 6}},
                                                    {"LOCKING", {JointKind::locking, 6}},
                                                    {"TRANSLATIONAL_MOTOR", {JointKind::translational_motor, 4}},
                                                    {"ROTATIONAL_MOTOR", {JointKind::rotational_motor, 4}},
                                                    {"GEARS", {JointKind::gears, 4}},
                                                    {"RACK_AND_PINION", {JointKind::rack_and_pinion, 4}},
                                                    {"CONSTANT_VELOCITY", {JointKind::constant_velocity, 4}},
                                                    {"PULLEY", {JointKind::pulley, 4}},
                                                    {"SCREW", {JointKind::screw, 4}}};
  return rows;
}

const char* const node_fields[6] = {"n1", "n2", "n3", "n4", "n5", "n6"};

/// Dimension of PARM: the rack's distance is a length, the screw's helix ratio length per radian, ratios have none.
Dimension parameter_dimension(JointKind kind) {
  return kind == JointKind::rack_and_pinion || kind == JointKind::screw ? dimension::length : dimension::none;
}

void read_joint_nodes(Builder& b, const Card& card, const JointRow& row, Joint& joint) {
  // Gears and pulleys take points 5 and 6 only where R1 does not give the radius; a cylindrical joint may leave N3 out.
  for (std::size_t i = 0; i < 6; ++i) {
    const char* field = node_fields[i];
    const bool optional = static_cast<int>(i) >= row.points || (joint.kind == JointKind::cylindrical && i == 2);
    joint.nodes[i] = optional ? b.optional_node(card, field) : b.node(card, field);
  }
  for (std::size_t i = 0; i < 6; i += 2) {
    if (joint.nodes[i] != none && joint.nodes[i] == joint.nodes[i + 1]) {
      card.error(node_fields[i + 1],
                 "node " + std::to_string(b.model.nodes.id[static_cast<std::size_t>(joint.nodes[i])]) +
                     " is named for both bodies",
                 "a joint needs two nodes at one place, one of each body");
    }
  }
  joint.rps = Builder::real_or(card, "rps", 1.0);
  joint.damp = Builder::real_or(card, "damp", 1.0);
}

void read_joint_points(Builder& b, Block& block, const Card& card, const JointRow& row, Joint& joint) {
  joint.part_a = b.body(card, "rbid_a");
  joint.part_b = b.body(card, "rbid_b");
  joint.rps = Builder::real_or(card, "rps", 1.0);
  joint.damp = Builder::real_or(card, "damp", 1.0);
  b.refuse_nonzero(card, "tmass", "mass lumped at a joint", "use *ELEMENT_MASS");
  b.refuse_nonzero(card, "rmass", "inertia lumped at a joint", "use *ELEMENT_INERTIA");
  b.refuse_nonzero(card, "rbidc", "a harmonic gear's third body", "leave it at 0");
  const int points = row.points == 2 ? 2 : (row.points == 4 && block.info->find_card("card1") == nullptr ? 4 : 6);
  joint.points.emplace();
  for (int i = 0; i < points; ++i) {
    const Card point = block.next("point");
    auto& place = (*joint.points)[static_cast<std::size_t>(i)];
    // A blank even point of joints whose pairs coincide is that of body A.
    place = i % 2 == 1 && point.all_blank() ? (*joint.points)[static_cast<std::size_t>(i - 1)] : point.point("x");
  }
}

void read_joint_parameters(Builder& b, const Card& card, Joint& joint) {
  joint.parameter = card.real("parm", parameter_dimension(joint.kind));
  joint.radius_1 = card.real("r1", dimension::length);
  joint.motor_type = b.integer_in(card, "type", 0, 3);
  const bool motor = joint.kind == JointKind::translational_motor || joint.kind == JointKind::rotational_motor;
  if (motor) {
    joint.curve = b.curve_or_constant(card, "lcid");
  } else if (card.id("lcid", IdKind::curve) != 0) {
    b.ignored(card, "lcid", "only motors are driven by a curve");
  }
  b.refuse_nonzero(card, "h_angle", "a helix angle between gears", "leave it at 0");
  const bool needs_ratio = joint.kind == JointKind::gears || joint.kind == JointKind::pulley ||
                           joint.kind == JointKind::screw || joint.kind == JointKind::rack_and_pinion;
  if (needs_ratio && joint.parameter == 0) {
    card.error("parm", "is blank or 0, expected the joint's ratio (R2/R1, h, or the helix ratio)", "give PARM");
  }
}

Joint::Failure read_failure(Builder& b, Block& block) {
  const Card first = block.next("failure0");
  const Card second = block.next("failure1");
  Joint::Failure failure;
  failure.frame = b.optional_reference(first, "cid", b.frames);
  failure.time = Builder::time_or(first, "tfail", 1e20);
  failure.coupling = first.real("coupl");
  failure.limits = {second.real("nxx", dimension::force),  second.real("nyy", dimension::force),
                    second.real("nzz", dimension::force),  second.real("mxx", dimension::moment),
                    second.real("myy", dimension::moment), second.real("mzz", dimension::moment)};
  return failure;
}

/// Some decks end a constant-velocity joint with the parameter card of the coupled joints, which it does not have.
void skip_parameter_card(Block& block) {
  if (block.at_end()) return;
  Block ahead = block;
  const Card extra = ahead.next("card0");
  if (!ahead.at_end() || !extra.blank("n2")) return;
  extra.warning("n1", "a constant-velocity joint has no parameter card: the line is not used", "remove it");
  block = ahead;
}

}  // namespace

void build_joint(Builder& b, Block& block) {
  std::string name = block.keyword.substr(std::string("CONSTRAINED_JOINT_").size());
  const bool coordinates = name.starts_with("COOR_");
  if (coordinates) name.erase(0, 5);
  const auto row = joint_rows().find(name);
  if (row == joint_rows().end()) {
    b.unsupported(block, "a joint of this kind is not available", "use another joint");
    return;
  }
  while (!block.at_end()) {
    Joint joint;
    joint.kind = row->second.kind;
    const Card head = block.next_if(block.has("ID"), "id");
    const Card card = block.next("card0");
    if (!card.present()) return;
    if (coordinates)
      read_joint_points(b, block, card, row->second, joint);
    else
      read_joint_nodes(b, card, row->second, joint);
    if (block.info->find_card("card1") != nullptr) read_joint_parameters(b, block.next("card1"), joint);
    if (joint.kind == JointKind::constant_velocity && !coordinates) skip_parameter_card(block);
    if (block.has("LOCAL")) {
      const Card local = block.next("local");
      joint.local_system = b.integer_in(local, "lst", 0, 1);
      if (joint.local_system == 1) {
        b.unsupported(local, "lst", "an accelerometer as the joint's output system is not available",
                      "name a rigid body with LST = 0");
      } else {
        joint.local_body = b.body(local, "raid");
      }
    }
    if (block.has("FAILURE")) joint.failure = read_failure(b, block);
    joint.id = static_cast<UserId>(b.model.joints.size()) + 1;
    if (head.present()) {
      joint.title = head.text("heading");
      if (head.id("id", IdKind::other) != 0) {
        joint.id = head.id("id", IdKind::other);
        b.joint_ids.enter(head, "id", static_cast<Index>(b.model.joints.size()));
      }
    }
    b.model.joints.push_back(std::move(joint));
    b.joint_where.push_back(card);
  }
}

namespace {

/// Field names of one relative coordinate on the cards 1 to 3; nullptr where the keyword has none.
struct CoordinateFields {
  const char *curve, *damping, *elastic, *friction, *negative, *positive;
};

struct StiffnessRow {
  const char* suffix;
  JointStiffnessKind kind;
  std::array<CoordinateFields, 3> fields;
  std::array<bool, 3> angle;
};

constexpr std::array<StiffnessRow, 4> stiffness_rows{{{"GENERALIZED",
                                                       JointStiffnessKind::generalized,
                                                       {{{"lcidph", "dlcidph", "esph", "fmph", "nsaph", "psaph"},
                                                         {"lcidt", "dlcidt", "est", "fmt", "nsat", "psat"},
                                                         {"lcidps", "dlcidps", "esps", "fmps", "nsaps", "psaps"}}},
                                                       {true, true, true}},
                                                      {"FLEXION-TORSION",
                                                       JointStiffnessKind::flexion_torsion,
                                                       {{{"lcidal", "dlcidal", "esal", "fmal", nullptr, "saal"},
                                                         {nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
                                                         {"lcidbt", "dlcidbt", "esbt", "fmbt", "nsabt", "psabt"}}},
                                                       {true, true, true}},
                                                      {"TRANSLATIONAL",
                                                       JointStiffnessKind::translational,
                                                       {{{"lcidx", "dlcidx", "esx", "ffx", "nsdx", "psdx"},
                                                         {"lcidy", "dlcidy", "esy", "ffy", "nsdy", "psdy"},
                                                         {"lcidz", "dlcidz", "esz", "ffz", "nsdz", "psdz"}}},
                                                       {false, false, false}},
                                                      {"CYLINDRICAL",
                                                       JointStiffnessKind::cylindrical,
                                                       {{{"lcidr", "dlcidr", "esr", "ffr", nullptr, "psdr"},
                                                         {nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
                                                         {"lcidz", "dlcidz", "esz", "ffz", "nsdz", "psdz"}}},
                                                       {false, false, false}}}};

JointStiffness::Coordinate read_coordinate(Builder& b, const std::array<Card, 3>& cards, const CoordinateFields& f,
                                           bool angle) {
  constexpr double degree = std::numbers::pi / 180;
  JointStiffness::Coordinate c;
  if (f.curve == nullptr) return c;
  c.moment = b.optional_curve(cards[0], f.curve);
  c.damping = b.optional_curve(cards[0], f.damping);
  c.elastic = cards[1].real(f.elastic, angle ? dimension::rotational_stiffness : dimension::stiffness);
  const double limit = cards[1].real(f.friction);
  if (limit < 0) {
    // FM < 0: the limit is curve |FM| of the angle (a table of angle and joint force where a JID is given).
    const UserId id = std::llround(-limit) + cards[1].block().context().offset[static_cast<std::size_t>(IdKind::curve)];
    if (b.tables.find(id) != none) {
      b.unsupported(cards[1], f.friction, "a table of friction limits against the joint's force is not available",
                    "name a curve");
    } else {
      c.friction_curve = b.curve_of_id(cards[1], f.friction, id);
    }
  } else {
    c.friction = cards[1].real(f.friction, angle ? dimension::moment : dimension::force);
  }
  const Dimension size = angle ? dimension::none : dimension::length;
  const double factor = angle ? degree : 1.0;
  if (f.negative != nullptr) c.stop_negative = factor * cards[2].real(f.negative, size);
  c.stop_positive = factor * cards[2].real(f.positive, size);
  if (c.elastic == 0 && (limit != 0 || c.stop_negative != 0 || c.stop_positive != 0)) {
    cards[1].warning(f.elastic, "is 0: the friction and the stops of this coordinate are not active",
                     "give an elastic stiffness if they are to act");
  }
  return c;
}

}  // namespace

void build_joint_stiffness(Builder& b, Block& block) {
  const auto row = std::find_if(stiffness_rows.begin(), stiffness_rows.end(),
                                [&](const StiffnessRow& r) { return block.keyword.ends_with(r.suffix); });
  if (row == stiffness_rows.end()) {
    b.unsupported(block, "a joint stiffness of this kind is not available", "use _GENERALIZED or _TRANSLATIONAL");
    return;
  }
  while (!block.at_end()) {
    if (block.has("TITLE")) block.next_title();
    const Card card = block.next("card0");
    if (!card.present()) return;
    const std::array<Card, 3> cards{block.next_optional("card1"), block.next_optional("card2"),
                                    block.next_optional("card3")};
    JointStiffness s;
    s.kind = row->kind;
    s.id = card.id("jsid", IdKind::other);
    s.part_a = b.body(card, "pida");
    s.part_b = b.body(card, "pidb");
    s.frame_a = b.reference(card, "cida", b.frames);
    s.frame_b = card.id("cidb", IdKind::define) == 0 ? s.frame_a : b.reference(card, "cidb", b.frames);
    s.joint = card.id("jid", IdKind::other);
    if (s.joint != 0) b.joint_references.push_back(card);
    if (Builder::has_field(block, "card0", "rps")) s.rps = Builder::real_or(card, "rps", 1.0);
    for (std::size_t i = 0; i < 3; ++i) s.coordinate[i] = read_coordinate(b, cards, row->fields[i], row->angle[i]);
    if (s.kind == JointStiffnessKind::flexion_torsion) {
      s.moment_scale = b.optional_curve(cards[0], "lcidg");
      s.damping_scale = b.optional_curve(cards[0], "dlcidg");
    }
    if (s.kind == JointStiffnessKind::translational || s.kind == JointStiffnessKind::cylindrical) {
      for (auto& c : s.coordinate) {
        c.static_coefficient = cards[2].real("fs");
        c.dynamic_coefficient = cards[2].real("fd");
      }
      if ((cards[2].real("fs") != 0 || cards[2].real("fd") != 0) && s.joint == 0) {
        b.unsupported(cards[2], "fs", "friction from the joint's force needs the joint",
                      "give its id as JID on the first card, or the limits FFX, FFY, FFZ");
      }
    }
    if (s.kind == JointStiffnessKind::cylindrical) {
      for (const char* field : {"dlcidp", "lcidt", "dlcidt"})
        b.refuse_nonzero(cards[0], field, "this curve of the cylindrical stiffness", "leave it at 0");
      for (const char* field : {"rad1", "rad2"})
        b.refuse_nonzero(cards[1], field, "a radius of the cylindrical stiffness", "leave it at 0");
    }
    if (s.part_a != none && s.part_a == s.part_b)
      card.error("pidb", "both bodies are the same part", "name two bodies");
    if (b.joint_stiffness_ids.enter(card, "jsid", static_cast<Index>(b.model.joint_stiffnesses.size()))) {
      b.model.joint_stiffnesses.push_back(std::move(s));
    }
  }
}

}  // namespace kardan::deck

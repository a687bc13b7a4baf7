// *CONTACT_…: one table of what the keywords mean, one order of cards for all of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

enum class ThirdCard { no_card, eroding, rigid, tiebreak_nodes, tiebreak_surfaces, tiebreak_automatic };

/// What a keyword means.
struct Meaning {
  ContactLaw law = ContactLaw::penalty;
  bool single = false, two_way = false, automatic = false, edges = false, tool = false;  // tool: the reference side is a forming tool
  ThirdCard third = ThirdCard::no_card;
  Tie::Holding holding = Tie::Holding::constraint;
  bool rotations = false, torsion = false;
};

constexpr Dimension decay_dimension{0, -1, 1};  // of DC, on a speed

using Law = ContactLaw;
using Holding = Tie::Holding;

const std::map<std::string, Meaning>& meanings() {
  static const std::map<std::string, Meaning> table{
      {"AUTOMATIC_SINGLE_SURFACE", {.single = true, .automatic = true}},
      {"AUTOMATIC_GENERAL", {.single = true, .automatic = true, .edges = true}},
      {"SINGLE_SURFACE", {.single = true, .automatic = true}},
      {"AUTOMATIC_SURFACE_TO_SURFACE", {.two_way = true, .automatic = true}},
      {"AUTOMATIC_NODES_TO_SURFACE", {.automatic = true}},
      {"AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", {.automatic = true}},
      {"SURFACE_TO_SURFACE", {.two_way = true}},
      {"ONE_WAY_SURFACE_TO_SURFACE", {}},
      {"NODES_TO_SURFACE", {}},
      {"FORMING_ONE_WAY_SURFACE_TO_SURFACE", {.automatic = true, .tool = true}},
      {"ERODING_SINGLE_SURFACE", {.single = true, .automatic = true, .third = ThirdCard::eroding}},
      {"ERODING_SURFACE_TO_SURFACE", {.two_way = true, .third = ThirdCard::eroding}},
      {"ERODING_NODES_TO_SURFACE", {.third = ThirdCard::eroding}},
      {"RIGID_NODES_TO_RIGID_BODY", {.third = ThirdCard::rigid}},
      {"RIGID_BODY_ONE_WAY_TO_RIGID_BODY", {.third = ThirdCard::rigid}},
      {"RIGID_BODY_TWO_WAY_TO_RIGID_BODY", {.two_way = true, .third = ThirdCard::rigid}},
      {"FORCE_TRANSDUCER_PENALTY", {.law = Law::transducer}},
      {"FORCE_TRANSDUCER", {.law = Law::transducer}},
      {"TIED_NODES_TO_SURFACE", {.law = Law::tied}},
      {"TIED_NODES_TO_SURFACE_OFFSET", {.law = Law::tied, .holding = Holding::offset}},
      {"TIED_NODES_TO_SURFACE_CONSTRAINED_OFFSET", {.law = Law::tied, .holding = Holding::constrained_offset}},
      {"TIED_SURFACE_TO_SURFACE", {.law = Law::tied}},
      {"TIED_SURFACE_TO_SURFACE_OFFSET", {.law = Law::tied, .holding = Holding::offset}},
      {"TIED_SURFACE_TO_SURFACE_CONSTRAINED_OFFSET", {.law = Law::tied, .holding = Holding::constrained_offset}},
      {"TIED_SHELL_EDGE_TO_SURFACE", {.law = Law::tied, .rotations = true}},
      {"TIED_SHELL_EDGE_TO_SURFACE_OFFSET", {.law = Law::tied, .holding = Holding::offset, .rotations = true}},
      {"TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET", {.law = Law::tied, .holding = Holding::constrained_offset, .rotations = true}},
      {"TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET", {.law = Law::tied, .holding = Holding::beam_offset, .rotations = true}},
      {"SPOTWELD", {.law = Law::tied, .rotations = true}},
      {"SPOTWELD_BEAM_OFFSET", {.law = Law::tied, .holding = Holding::beam_offset, .rotations = true}},
      {"SPOTWELD_WITH_TORSION", {.law = Law::tied, .rotations = true, .torsion = true}},
      {"TIEBREAK_NODES_TO_SURFACE", {.law = Law::tiebreak, .third = ThirdCard::tiebreak_nodes}},
      {"TIEBREAK_SURFACE_TO_SURFACE", {.law = Law::tiebreak, .two_way = true, .third = ThirdCard::tiebreak_surfaces}},
      {"AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK",
       {.law = Law::tiebreak, .two_way = true, .automatic = true, .third = ThirdCard::tiebreak_automatic}},
      {"AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK",
       {.law = Law::tiebreak, .automatic = true, .third = ThirdCard::tiebreak_automatic}}};
  return table;
}

/// SURFATYP, SURFBTYP.
enum SideType : std::int64_t { segment_set, shell_set, part_set, one_part, node_set, all, all_but_part_set };

std::vector<PartIndex> meshed_parts(const Model& model) {
  std::vector<PartIndex> parts;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (model.parts[p].nodal_rigid_body == none) parts.push_back(static_cast<PartIndex>(p));
  return parts;
}

/// Names of the fields of one side.
struct SideFields {
  const char *id, *type, *box, *report, *stiffness, *thickness, *thickness_scale;
};
constexpr SideFields tracked_fields{"surfa", "surfatyp", "saboxid", "sapr", "sfsa", "sast", "sfsat"};
constexpr SideFields reference_fields{"surfb", "surfbtyp", "sbboxid", "sbpr", "sfsb", "sbst", "sfsbt"};

void read_members(Builder& b, const Card& card, const SideFields& f, ContactSide& side) {
  const std::int64_t type = card.integer(f.type), id = card.integer(f.id);
  if (id == 0 || type == all) {
    side.kind = ContactSide::Kind::everything;
    return;
  }
  switch (type) {
    case segment_set:
      side.kind = ContactSide::Kind::segments;
      if (const Index set = b.sets->reference(card, f.id, SetKind::segment); set != none) side.segments = b.model.segment_sets[at(set)].segments;
      break;
    case shell_set:
      side.kind = ContactSide::Kind::segments;
      if (const Index set = b.sets->reference(card, f.id, SetKind::shell); set != none)
        for (const Index shell : b.model.element_sets[at(set)].elements) side.segments.push_back(segment_of_shell(b, shell));
      break;
    case part_set:
      side.kind = ContactSide::Kind::parts;
      side.parts = b.part_set(card, f.id);
      break;
    case one_part:
      side.kind = ContactSide::Kind::parts;
      if (const PartIndex p = b.reference(card, f.id, b.parts); p != none) side.parts = {p};
      break;
    case node_set:
      side.kind = ContactSide::Kind::nodes;
      side.nodes = b.node_set(card, f.id);
      break;
    case all_but_part_set: {
      side.kind = ContactSide::Kind::parts;
      std::vector<PartIndex> left_out = b.part_set(card, f.id);
      std::sort(left_out.begin(), left_out.end());
      side.parts = meshed_parts(b.model);
      std::erase_if(side.parts, [&](PartIndex p) { return std::binary_search(left_out.begin(), left_out.end(), p); });
      break;
    }
    default:
      b.unsupported(card, f.type, "a side of this type (" + card.text(f.type) + ") is not available",
                    "give 0 segment set, 1 shell set, 2 part set, 3 part, 4 node set, 5 everything, or 6 all but a part set");
  }
  std::sort(side.parts.begin(), side.parts.end());
  side.parts.erase(std::unique(side.parts.begin(), side.parts.end()), side.parts.end());
  std::sort(side.nodes.begin(), side.nodes.end());
}

ContactSide read_side(Builder& b, const Card& who, const Card& scales, const SideFields& f) {
  ContactSide side;
  read_members(b, who, f, side);
  if (const Index box = b.optional_reference(who, f.box, b.boxes); box != none) {
    const Box& bounds = b.box_list[at(box)];
    side.box = {bounds.low, bounds.high};
  }
  side.report_nodes = who.integer(f.report) != 0;
  side.stiffness_scale = Builder::real_or(scales, f.stiffness, 1.0);
  side.thickness = scales.real(f.thickness, dimension::length);
  side.thickness_scale = Builder::real_or(scales, f.thickness_scale, 1.0);
  if (side.kind != ContactSide::Kind::everything && side.parts.empty() && side.nodes.empty() && side.segments.empty())
    who.warning(f.id, "this side of the contact has no members: nothing touches it", "name a set that has members");
  return side;
}

/// The cards of one *CONTACT, in their order.
struct Cards {
  Card who, friction, scales;
  std::vector<Card> special;         ///< of the keyword
  Card a, b, c, d;                   ///< optional cards A to D; E to G hold nothing that Kardan could honour or ignore in silence
};

int special_cards(ThirdCard third, const Block& block) {
  if (third == ThirdCard::no_card) return 0;
  if (third != ThirdCard::tiebreak_automatic) return 1;
  const std::int64_t option = std::abs(block.peek("tiebreak_automatic").integer("option"));
  return option == 9 || option == 11 ? 2 : option == 13 || option == 14 ? 4 : 1;
}

const char* special_name(ThirdCard third) {
  switch (third) {
    case ThirdCard::eroding: return "eroding";
    case ThirdCard::rigid: return "rigid";
    case ThirdCard::tiebreak_nodes: return "tiebreak_nodes";
    case ThirdCard::tiebreak_surfaces: return "tiebreak_surfaces";
    default: return "tiebreak_automatic";
  }
}

Cards read_cards(Block& block, const Meaning& meaning) {
  Cards cards;
  cards.who = block.next("who");
  cards.friction = block.next("friction");
  cards.scales = block.next("scales");
  for (int left = special_cards(meaning.third, block); left > 0; --left) cards.special.push_back(block.next(special_name(meaning.third)));
  cards.a = block.next_optional("option_a");
  cards.b = block.next_optional("option_b");
  cards.c = block.next_optional("option_c");
  cards.d = block.next_optional("option_d");
  return cards;
}

void read_friction(Builder& b, const Cards& cards, Contact& contact) {
  const Card& card = cards.friction;
  const double fs = card.real("fs"), fd = card.real("fd");
  const double scale = Builder::real_or(cards.scales, "fsf", 1.0);
  if (fs == -1) {
    contact.friction_source = Contact::FrictionSource::part;
  } else if (fs == -2) {
    contact.friction_source = Contact::FrictionSource::table;
    contact.friction_table = fd == 0 && !b.model.friction_tables.empty() ? 0 : b.friction_tables.find(static_cast<UserId>(fd));
    if (contact.friction_table == none)
      card.error("fd", "friction table " + card.text("fd") + " is not defined", "define it with *DEFINE_FRICTION or correct the number");
  } else if (fs < 0 || fs >= 2) {
    b.unsupported(card, "fs", "a friction of this kind (FS = " + card.text("fs") + ") is not available", "give a coefficient, -1 (of the parts) or -2 (of a table)");
  }
  contact.friction = {scale * fs, scale * fd, card.real("dc", decay_dimension),
                      Builder::real_or(cards.scales, "vsf", 1.0) * card.real("vc", dimension::stress)};
  contact.damping = card.real("vdc") / 100;
  if (contact.damping < 0) card.error("vdc", "is negative", "give the per cent of critical damping");
  contact.birth = card.real("bt", dimension::time);
  contact.death = Builder::time_or(card, "dt", 1e20);
  if (contact.birth < 0 || contact.death < 0)
    b.unsupported(card, contact.birth < 0 ? "bt" : "dt", "a curve of times of birth and death is not available", "give a time");
  b.ignored(card, "penchk", "nodes are not set free for being deep inside; they are pushed out");
}

void read_options(Builder& b, const Cards& cards, Contact& contact) {
  contact.soft = b.integer_in(cards.a, "soft", 0, 6);
  if (contact.soft > 2) b.unsupported(cards.a, "soft", "a contact of this kind (SOFT = " + cards.a.text("soft") + ") is not available", "give 0, 1 or 2");
  contact.soft_scale = Builder::real_or(cards.a, "sofscl", 0.1);
  contact.depth = static_cast<int>(cards.a.integer("depth"));
  b.refuse_nonzero(cards.a, "lcidab", "contact of an airbag's layers", "leave it at 0");
  contact.largest_penetration = cards.b.real("penmax");
  contact.shell_thickness = static_cast<int>(cards.b.integer("shlthk"));
  contact.solid_thickness = cards.b.real("sldthk", dimension::length);
  contact.solid_stiffness = cards.b.real("sldstf", dimension::stress);
  b.ignored(cards.b, "isym", "faces on a symmetry plane belong to the surface");
  contact.initial_penetration = static_cast<int>(cards.c.integer("ignore"));
  contact.step_of_stiffness = cards.c.real("dtstif", dimension::time);
  if (contact.step_of_stiffness < 0) b.unsupported(cards.c, "dtstif", "a curve for DTSTIF is not available", "give a time step");
  b.ignored(cards.c, "dprfac", "an initial penetration stays until the surfaces part");
  for (const char* field : {"edgek", "flangl"}) b.ignored(cards.c, field, "contact is as without it");
  b.refuse_nonzero(cards.d, "fnlscl", "a penalty that grows with the penetration", "leave FNLSCL at 0");
  for (const char* field : {"q2tri", "dtpchk", "sfnbr", "tcso"}) b.ignored(cards.d, field, "contact is as without it");
}

/// Fields of *CONTROL_CONTACT are the defaults of single contacts, whichever stands first in the deck.
void take_defaults(const Builder::ContactDefaults& defaults, Contact& contact) {
  if (contact.shell_thickness == 0) contact.shell_thickness = defaults.shell_thickness;
  if (contact.initial_penetration == 0) contact.initial_penetration = defaults.initial_penetration;
}

void read_tie(Builder& b, const Cards& cards, const Meaning& meaning, Contact& contact) {
  Tie& tie = contact.tie;
  tie.holding = meaning.holding;
  tie.rotations = meaning.rotations;
  tie.torsion = meaning.torsion;
  if (contact.tracked.thickness < 0) {
    tie.distance = -contact.tracked.thickness;
    contact.tracked.thickness = 0;
  }
  if (meaning.third == ThirdCard::tiebreak_nodes) {
    const Card& card = cards.special.front();
    tie.normal_limit = Builder::real_or(card, "nflf", 0.0, dimension::force);
    tie.shear_limit = Builder::real_or(card, "sflf", 0.0, dimension::force);
    tie.normal_exponent = Builder::real_or(card, "nen", 2.0);
    tie.shear_exponent = Builder::real_or(card, "mes", 2.0);
  } else if (meaning.third == ThirdCard::tiebreak_surfaces) {
    const Card& card = cards.special.front();
    tie.option = 2;
    tie.normal_limit = card.real("nfls", dimension::stress);
    tie.shear_limit = card.real("sfls", dimension::stress);
    b.refuse_nonzero(card, "tblcid", "a curve of stress against opening", "leave it at 0");
    b.ignored(card, "thkoff", "offsets of shells are kept in any case");
  } else if (meaning.third == ThirdCard::tiebreak_automatic) {
    const Card& card = cards.special.front();
    tie.option = static_cast<int>(card.integer("option"));
    if (tie.option != 2 && tie.option != 6)
      b.unsupported(card, "option", "a tiebreak of this kind (OPTION = " + card.text("option") + ") is not available", "give 2 (stress) or 6 (stress, then damage)");
    tie.normal_limit = card.real("nfls", dimension::stress);
    tie.shear_limit = card.real("sfls", dimension::stress);
    if (tie.option == 6) tie.critical_distance = card.real("param", dimension::length);
  }
}

void read_rigid_law(Builder& b, const Cards& cards, Contact& contact) {
  const Card& card = cards.special.front();
  contact.rigid_curve = true;
  contact.curve = b.reference(card, "lcid", b.curves);
  contact.curve_method = static_cast<int>(card.integer("fcm"));
  if (contact.curve_method < 1 || contact.curve_method > 3)
    b.unsupported(card, "fcm", "a force of this kind (FCM = " + card.text("fcm") + ") is not available", "give 1 (sum of all forces), 2 (force of a node) or 3 (pressure)");
  contact.unload_stiffness = card.real("us", dimension::stiffness);
  contact.damping_curve = b.optional_curve(card, "lcdc");
  contact.damping_scale = Builder::real_or(card, "dsf", 1.0);
  b.refuse_nonzero(card, "unlcid", "a curve of unloading", "give the unloading stiffness US");
}

}  // namespace

void build_contact(Builder& b, Block& block) {
  const Meaning& meaning = meanings().at(block.keyword.substr(std::string("CONTACT_").size()));
  Contact contact;
  contact.id = static_cast<UserId>(b.model.contacts.size()) + 1;
  contact.keyword = "*" + block.keyword;
  if (block.has("ID") || block.has("TITLE")) {
    const Card named = block.next("id");
    if (named.integer("id") != 0) contact.id = named.integer("id");
    contact.title = named.text("heading");
  }
  if (block.has("MPP")) {
    contact.initial_penetration = static_cast<int>(block.next("mpp").integer("ignore"));
    if (block.peek("title").line().starts_with("&")) block.next("mpp");
  }
  const Cards cards = read_cards(block, meaning);
  if (!cards.who.present()) return;
  contact.law = meaning.law;
  contact.single = meaning.single;
  contact.two_way = meaning.two_way;
  contact.automatic = meaning.automatic;
  contact.edges = meaning.edges;
  contact.eroding = meaning.third == ThirdCard::eroding;
  contact.tracked = read_side(b, cards.who, cards.scales, tracked_fields);
  const bool needs_reference = !meaning.single && meaning.law != Law::transducer;
  if (needs_reference || cards.who.integer("surfb") != 0) contact.reference = read_side(b, cards.who, cards.scales, reference_fields);
  if (meaning.single && contact.reference.kind != ContactSide::Kind::nothing) {
    cards.who.warning("surfb", "is not used: this contact is of one surface with itself", "leave it at 0");
    contact.reference = {};
  }
  if (contact.reference.kind == ContactSide::Kind::nodes)
    cards.who.error("surfbtyp", "nodes cannot be the surface that others touch", "exchange the sides, or name parts or segments");
  if (meaning.tool) contact.reference.thickness = -1;
  const int ignore = contact.initial_penetration;
  read_friction(b, cards, contact);
  read_options(b, cards, contact);
  if (contact.initial_penetration == 0) contact.initial_penetration = ignore;
  if (meaning.law == Law::tied || meaning.law == Law::tiebreak) read_tie(b, cards, meaning, contact);
  if (meaning.third == ThirdCard::rigid) read_rigid_law(b, cards, contact);
  b.model.contacts.push_back(std::move(contact));
}

void finish_contacts(Builder& b) {
  for (Contact& contact : b.model.contacts) take_defaults(b.contact_defaults, contact);
}

namespace {

Friction friction_of(const Card& card, const std::array<const char*, 4>& fields) {
  return {card.real(fields[0]), card.real(fields[1]), card.real(fields[2], decay_dimension), card.real(fields[3], dimension::stress)};
}

}  // namespace

void build_friction_table(Builder& b, Block& block) {
  const Card head = block.next("card0");
  FrictionTable table;
  table.id = head.id("id", IdKind::define);
  table.otherwise = friction_of(head, {"fs_d", "fd_d", "dc_d", "vc_d"});
  block.for_each("card1", [&](const Card& card) {
    const auto parts_of = [&](const char* field, const char* type) -> std::vector<PartIndex> {
      if (card.text(type) == "PSET") return b.part_set(card, field);
      const PartIndex p = b.reference(card, field, b.parts);
      return p == none ? std::vector<PartIndex>{} : std::vector<PartIndex>{p};
    };
    table.rows.push_back({parts_of("pid_i", "ptypei"), parts_of("pid_j", "ptypej"), friction_of(card, {"fs_ij", "fd_ij", "dc_ij", "vc_ij"})});
  });
  if (table.id == 0 || b.friction_tables.enter(head, "id", static_cast<Index>(b.model.friction_tables.size())))
    b.model.friction_tables.push_back(std::move(table));
}

PartContact read_part_contact(const Card& card) {
  PartContact contact;
  contact.friction = friction_of(card, {"fs", "fd", "dc", "vc"});
  contact.thickness = card.real("optt", dimension::length);
  contact.thickness_scale = Builder::real_or(card, "sft", 1.0);
  contact.stiffness_scale = Builder::real_or(card, "ssf", 1.0);
  return contact;
}

void read_control_contact(Builder& b, Block& block) {
  const Card card = block.next("card0");
  const Card search = block.next_optional("card1"), friction = block.next_optional("card2"), initial = block.next_optional("card3");
  const Card walls = block.next_optional("card4");
  ContactControl& c = b.model.control.contact;
  c.stiffness_scale = Builder::real_or(card, "slsfac", 0.1);
  c.wall_penalty = card.real("rwpnal");
  c.penalty_option = card.integer("penopt") == 0 ? 1 : b.integer_in(card, "penopt", 1, 5);
  c.thickness_changes = card.integer("thkchg") != 0;
  c.full_thickness = search.integer("ssthk") == 1;
  c.skip_walls = initial.integer("skiprwg") != 0;
  b.contact_defaults = {static_cast<int>(card.integer("shlthk")), static_cast<int>(initial.integer("ignore"))};
  b.ignored(card, "enmass", "nodes without elements are not in contact");
  b.ignored(search, "xpene", "nodes are not set free for being deep inside; they are pushed out");
  for (const char* field : {"usrstr", "usrfrc"}) b.refuse_nonzero(search, field, "a user's subroutine", "leave it at 0");
  for (const char* field : {"sfric", "dfric", "edc", "vfc", "th", "th_sf", "pen_sf"})
    b.refuse_nonzero(friction, field, "a default of *PART_CONTACT", "give it on *PART_CONTACT");
  b.ignored(walls, "isym", "faces on a symmetry plane belong to the surface");
}

}  // namespace kardan::deck
// *PART, *SECTION, *HOURGLASS.
#include <array>
#include <cmath>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

Mat3 read_inertia(const Card& card) {
  const double xx = card.real("ixx", dimension::inertia), xy = card.real("ixy", dimension::inertia),
               xz = card.real("ixz", dimension::inertia), yy = card.real("iyy", dimension::inertia),
               yz = card.real("iyz", dimension::inertia), zz = card.real("izz", dimension::inertia);
  return {{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}}};
}

namespace {

/// The tensor of a block turned with its include: R I R^T for the rotation of the transformation.
Mat3 turned(const Block& block, const Mat3& tensor) {
  const Affine& affine = block.context().affine;
  if (affine.is_identity) return tensor;
  return affine.linear * tensor * transpose(affine.linear);
}

/// Axes from a vector along x and one in the xy plane (IRCS = 1, *DEFINE_COORDINATE_VECTOR); none where they are
/// parallel.
std::optional<Mat3> axes_from(const Vec3& along_x, const Vec3& in_plane) {
  const Vec3 z = cross(along_x, in_plane);
  if (norm(z) <= 1e-12 * norm(along_x) * norm(in_plane)) return std::nullopt;
  const Vec3 x = normalized(along_x), k = normalized(z);
  return Mat3::columns(x, cross(k, x), k);
}

}  // namespace

GivenInertia read_given_inertia(Builder& b, Block& block, const std::string& frame_field) {
  GivenInertia given;
  const Card center = block.next("inertia0");
  const Card tensor = block.next("inertia1");
  const Card velocity = block.next_optional("inertia2");
  given.mass = center.real("tm", dimension::mass);
  given.center_node = b.optional_node(center, "nodeid");
  given.center =
      given.center_node == none ? center.point("xc") : b.model.nodes.x[static_cast<std::size_t>(given.center_node)];
  if (given.mass <= 0) {
    center.error("tm", "found " + center.text("tm") + ", expected a positive mass", "give the mass of the body");
  }
  given.inertia = read_inertia(tensor);
  for (const auto& [field, i] : {std::pair{"ixx", 0}, std::pair{"iyy", 1}, std::pair{"izz", 2}}) {
    if (given.inertia[static_cast<std::size_t>(i)][static_cast<std::size_t>(i)] <= 0) {
      tensor.error(field, "found " + tensor.text(field) + ", expected a positive moment of inertia",
                   "give the tensor about the centre of mass");
    }
  }
  if (velocity.present()) {
    given.velocity = velocity.direction("vtx", dimension::velocity);
    given.angular_velocity = velocity.direction("vrx", dimension::angular_velocity);
  }
  if (b.integer_in(center, "ircs", 0, 1) == 0) {
    given.inertia = turned(block, given.inertia);
    return given;
  }
  const Card axes = block.next("inertia3");
  if (const Index frame = b.optional_reference(axes, frame_field, b.frames); frame != none) {
    given.axes = b.model.frames[static_cast<std::size_t>(frame)].axes;
  } else if (axes.id(frame_field, IdKind::define) == 0) {
    given.axes = axes_from(axes.direction("xl"), axes.direction("xlip"));
    if (!given.axes) {
      axes.error("xl", "the local x-axis and the vector in the xy-plane are parallel or zero",
                 "give two directions that span a plane");
    }
  }
  return given;
}

void build_part(Builder& b, Block& block) {
  const bool inertia = block.has("INERTIA");
  while (!block.at_end()) {
    Part part;
    part.title = block.next_title();
    const Card card = block.next("card0");
    if (!card.present()) return;
    part.id = card.id("pid", IdKind::part);
    part.section = b.optional_reference(card, "secid", b.sections);
    part.material = b.optional_reference(card, "mid", b.materials);
    part.hourglass = b.optional_reference(card, "hgid", b.hourglasses);
    part.equation_of_state = b.optional_reference(card, "eosid", b.equations_of_state);
    b.ignored(card, "adpopt", "the mesh is not adapted");
    b.ignored(card, "tmid", "there is no thermal solution");
    if (inertia) part.inertia = read_given_inertia(b, block, "cid");
    if (block.has("CONTACT")) part.contact = read_part_contact(block.next("contact"));
    if (block.has("PRINT")) block.next("print");
    if (b.parts.enter(card, "pid", static_cast<PartIndex>(b.model.parts.size()))) {
      if (inertia && part.material != none && !b.model.materials[static_cast<std::size_t>(part.material)].rigid()) {
        card.error("mid", "the part has given inertia but its material is not *MAT_RIGID", "use *MAT_RIGID or *PART");
      }
      b.part_where.push_back(
          {card.where(), card.id("secid", IdKind::other) != 0, card.id("mid", IdKind::material) != 0});
      b.model.parts.push_back(std::move(part));
    }
  }
}

namespace {

/// Title (with _TITLE), number and room for a new section; nullptr where the number is taken.
Section* new_section(Builder& b, const std::string& title, const Card& card, ElementKind kind) {
  if (!b.sections.enter(card, "secid", static_cast<Index>(b.model.sections.size()))) return nullptr;
  Section& section = b.model.sections.emplace_back();
  section.id = card.id("secid", IdKind::other);
  section.title = title;
  section.kind = kind;
  return &section;
}

std::string title_of(Block& block) {
  return block.has("TITLE") ? block.next_title() : std::string();
}

int integer_or(const Card& card, std::string_view field, int fallback) {
  const std::int64_t value = card.integer(field);
  return value == 0 ? fallback : static_cast<int>(value);
}

}  // namespace

void build_integration_shell(Builder& b, Block& block) {
  while (!block.at_end()) {
    const Card card = block.next("card0");
    ShellRule rule;
    rule.id = card.id("irid", IdKind::other);
    rule.points = static_cast<int>(card.integer("nip"));
    rule.equal = card.integer("esop") == 1;
    if (rule.points < 1) card.error("nip", "found " + card.text("nip") + ", expected the number of points", "give NIP >= 1");
    b.ignored(card, "failopt", "a shell is deleted when its points have failed, as the material says");
    for (int i = 0; i < rule.points && !rule.equal && !block.at_end(); ++i) {
      const Card point = block.next("card1");
      rule.s.push_back(point.real("s"));
      rule.weight.push_back(point.real("wf"));
      b.refuse_nonzero(point, "pid", "a material of its own for a layer", "leave PID 0");
      if (std::abs(rule.s.back()) > 1 || !(rule.weight.back() > 0)) point.error("s", "lies outside -1 to 1, or has no weight", "give -1 <= S <= 1 and WF > 0");
    }
    if (!rule.equal && static_cast<int>(rule.s.size()) != rule.points) card.error("nip", "has more points than cards follow", "give a card for each point");
    if (b.shell_rules.enter(card, "irid", static_cast<Index>(b.model.shell_rules.size()))) b.model.shell_rules.push_back(std::move(rule));
  }
}

void build_section_shell(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    const Card sizes = block.next("card1");
    if (card.integer("icomp") == 1) {  // angles of the layers, eight on a line: of no effect on isotropic materials
      for (std::int64_t left = card.integer("nip"); left > 0 && !block.at_end(); left -= 8) block.next("card1");
    }
    Section* section = new_section(b, title, card, ElementKind::shell);
    if (section == nullptr) continue;
    ShellSection& s = section->shell;
    s.elform = static_cast<int>(card.integer("elform"));
    if (card.blank("elform") || s.elform == 0) s.elform = b.model.control.shell_theory;
    s.shrf = Builder::real_or(card, "shrf", 1.0);
    s.nip = integer_or(card, "nip", 2);
    if (const std::int64_t rule = card.integer("qr_irid"); rule < 0) {
      s.rule = b.shell_rules.find(-rule);
      if (s.rule == none) card.error("qr_irid", "rule " + std::to_string(-rule) + " is not defined", "define it by *INTEGRATION_SHELL");
    } else if (rule != 0) {
      b.unsupported(card, "qr_irid", "the quadrature rule " + card.text("qr_irid") + " is not available", "use 0, or *INTEGRATION_SHELL");
    }
    if (card.integer("setyp") > 1) b.unsupported(card, "setyp", "the section type " + card.text("setyp") + " is not available", "use SETYP = 1");
    s.thickness = {sizes.real("t1", dimension::length), sizes.real("t2", dimension::length),
                   sizes.real("t3", dimension::length), sizes.real("t4", dimension::length)};
    for (std::size_t i = 1; i < 4; ++i) {
      if (s.thickness[i] == 0) s.thickness[i] = s.thickness[0];
    }
    if (s.thickness[0] < 0) sizes.error("t1", "is negative", "give a positive thickness");
    s.nloc = sizes.real("nloc");
    s.mass_per_area = sizes.real("marea", {1, -2, 0});
  }
}

void build_section_solid(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    if (Section* section = new_section(b, title, card, ElementKind::solid)) {
      section->solid.elform = integer_or(card, "elform", 1);
    }
  }
}

namespace {

void read_truss(Builder& b, BeamSection& s, const Card& sizes) {
  s.area = sizes.real("a", dimension::area);
  b.refuse_nonzero(sizes, "stress", "an initial stress of the truss", "leave it out");
}

void read_resultant(Builder& b, BeamSection& s, const Card& sizes) {
  s.area = sizes.real("a", dimension::area);
  s.iss = sizes.real("iss", {0, 4, 0});
  s.itt = sizes.real("itt", {0, 4, 0});
  s.j = sizes.real("j", {0, 4, 0});
  s.shear_s = sizes.real("sas", dimension::area);
  s.shear_t = Builder::real_or(sizes, "sat", s.shear_s, dimension::area);
  b.refuse_nonzero(sizes, "ist", "a product moment of area", "give the moments about the principal axes and orient the beam along them");
  b.refuse_nonzero(sizes, "itorm", "another inertia of torsion", "leave ITORM at 0");
}

void read_discrete_beam(Builder& b, BeamSection& s, const Card& head, const Card& sizes) {
  s.scoor = static_cast<int>(head.real("scoor"));
  s.volume = sizes.real("vol", {0, 3, 0});
  const double inertia = sizes.real("iner");
  s.inertia = inertia < 0 ? inertia : sizes.real("iner", dimension::inertia);
  if (inertia < 0 && inertia != -1)
    b.unsupported(sizes, "iner", "an inertia matched to the time step (" + sizes.text("iner") + ") is not available", "give the inertia");
  s.frame = b.optional_reference(sizes, "cid", b.frames);
  s.cable_area = sizes.real("ca_dofn1", dimension::area);
  s.cable_offset = sizes.real("offset_dofn2", dimension::length);
  for (const char* field : {"rrcon_null", "srcon_null", "trcon_null"}) {
    b.refuse_nonzero(sizes, field, "a rotation that the local axes do not follow", "leave it at 0");
  }
}

void read_integrated(Builder& b, BeamSection& s, const Card& sizes) {
  s.ts = {sizes.real("ts1", dimension::length), sizes.real("ts2", dimension::length)};
  s.tt = {sizes.real("tt1", dimension::length), sizes.real("tt2", dimension::length)};
  if (s.ts[1] == 0) s.ts[1] = s.ts[0];
  if (s.tt[1] == 0) s.tt[1] = s.tt[0];
  if (s.cst == 0 && s.tt[0] == 0) s.tt = s.ts;
  if (s.elform == 9) {
    s.twists_freely = sizes.real("itoff") == 1;
    return;
  }
  for (const char* field : {"nsloc", "ntloc"}) b.refuse_nonzero(sizes, field, "an offset of the beam's reference axis", "leave it at 0, or move the nodes");
  b.refuse_nonzero(sizes, "itorm", "another inertia of torsion", "leave ITORM at 0");
}

}  // namespace

void build_section_beam(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    const int elform = integer_or(card, "elform", 1);
    const bool resultant = elform == 2 || elform == 12 || elform == 13, truss = elform == 3, discrete = elform == 6, weld = elform == 9;
    const Card sizes =
        block.next(resultant ? "resultant" : (truss ? "truss" : (discrete ? "discrete" : (weld ? "weld" : "integrated"))));
    Section* section = new_section(b, title, card, ElementKind::beam);
    if (section == nullptr) continue;
    BeamSection& s = section->beam;
    s.elform = elform;
    s.shrf = Builder::real_or(card, "shrf", 1.0);
    s.rule = static_cast<int>(Builder::real_or(card, "qr_irid", 2));  // often written "2.0"
    s.cst = static_cast<int>(card.real("cst"));
    b.refuse_nonzero(card, "nsm", "non-structural mass of the section", "use *ELEMENT_MASS");
    b.refuse_nonzero(card, "naupd", "an update of the neutral axis", "leave NAUPD at 0");
    if (card.real("qr_irid") < 0)
      b.unsupported(card, "qr_irid", "an integration rule of *INTEGRATION is not available", "use 1 to 5");
    if (truss)
      read_truss(b, s, sizes);
    else if (resultant)
      read_resultant(b, s, sizes);
    else if (discrete)
      read_discrete_beam(b, s, card, sizes);
    else
      read_integrated(b, s, sizes);
  }
}

void build_section_discrete(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    const Card limits = block.next_optional("card1");
    Section* section = new_section(b, title, card, ElementKind::discrete);
    if (section == nullptr) continue;
    DiscreteSection& s = section->discrete;
    s.dro = b.integer_in(card, "dro", 0, 1);
    const Dimension size = s.dro == 1 ? dimension::none : dimension::length;
    s.kd = card.real("kd");
    s.v0 = card.real("v0", s.dro == 1 ? dimension::angular_velocity : dimension::velocity);
    s.cl = card.real("cl", size);
    s.fd = card.real("fd", size);
    s.cdl = limits.real("cdl", size);
    s.tdl = limits.real("tdl", size);
  }
}

void build_equation_of_state(Builder& b, Block& block) {
  const bool gruneisen = block.keyword == "EOS_GRUNEISEN";
  while (!block.at_end()) {
    title_of(block);
    const Card card = block.next("card0");
    const Card state = block.next_optional("card1");
    EquationOfState e;
    e.id = card.id("eosid", IdKind::other);
    e.keyword = block.as_written();
    if (gruneisen) {
      e.form = EquationOfState::Form::gruneisen;
      e.constants = {card.real("c", dimension::velocity), card.real("s1"), card.real("s2"), card.real("s3"), card.real("gamma0"), card.real("a"), 0};
      b.refuse_nonzero(state, "lcid", "an energy that a curve adds (LCID)", "set LCID = 0");
    } else {
      for (std::size_t i = 0; i < 7; ++i) {
        e.constants[i] = card.real("c" + std::to_string(i), i < 4 ? dimension::stress : dimension::none);
      }
    }
    e.initial_energy = gruneisen ? card.real("e0", dimension::stress) : state.real("e0", dimension::stress);
    e.initial_volume = state.real("v0");
    if (b.equations_of_state.enter(card, "eosid", static_cast<Index>(b.model.equations_of_state.size()))) {
      b.model.equations_of_state.push_back(std::move(e));
    }
  }
}

void build_hourglass(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    if (!b.hourglasses.enter(card, "hgid", static_cast<Index>(b.model.hourglasses.size()))) continue;
    Hourglass h;
    h.id = card.id("hgid", IdKind::other);
    h.title = title;
    h.type = static_cast<int>(card.integer("ihq"));
    h.coefficient = card.real("qm");
    h.bulk_type = static_cast<int>(card.integer("ibq"));
    if (h.bulk_type < 0) card.warning("ibq", "shells have no bulk viscosity; solids have the standard one");
    if (h.bulk_type > 1) b.unsupported(card, "ibq", "this type of bulk viscosity is not available", "use IBQ = 1");
    h.q1 = card.real("q1");
    h.q2 = card.real("q2");
    h.bending = card.real("qb_vdc");
    h.warping = card.real("qw");
    b.model.hourglasses.push_back(h);
  }
}

}  // namespace kardan::deck

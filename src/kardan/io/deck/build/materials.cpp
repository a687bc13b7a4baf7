// *MAT: what Kardan computes, and what it only weighs.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/material_fields.hpp"

namespace kardan::deck {

namespace {

/// Dof bits of the six digits of CON2 (CMO < 0): 100000 x … 000001 z-rotation.
int digits_to_dofs(std::int64_t code) {
  int bits = 0;
  for (int i = 5; i >= 0; --i, code /= 10) {
    if (code % 10 == 1)
      bits |= 1 << i;
    else if (code % 10 != 0)
      return -1;
  }
  return code == 0 ? bits : -1;
}

}  // namespace

BodyConstraint read_body_constraint(Builder& b, const Card& card) {
  BodyConstraint c;
  c.cmo = card.real("cmo");
  if (c.cmo != 0 && std::fabs(c.cmo) != 1 && std::fabs(c.cmo) != 2) {
    card.error("cmo", "found " + card.text("cmo") + ", expected -2, -1, 0, 1 or 2", "correct the value");
    c.cmo = 0;
  }
  if (c.cmo > 0) {
    c.con1 = b.integer_in(card, "con1", 0, 7);
    c.con2 = b.integer_in(card, "con2", 0, 7);
  } else if (c.cmo < 0) {
    c.frame = b.optional_reference(card, "con1", b.frames);
    c.con2 = digits_to_dofs(card.integer("con2"));
    if (c.con2 < 0) {
      card.error("con2", "found " + card.text("con2") + ", expected six digits of 0 and 1",
                 "x, y, z, rx, ry, rz: 1 is held, 0 is free");
      c.con2 = 0;
    }
  }
  if (std::fabs(c.cmo) == 2) {
    c.node = b.optional_node(card, "spcnid");
    // Held at a point or at the centre of mass is the same where no rotation is left.
    const int translations = c.cmo > 0 ? c.con1 : c.con2 & dof_translations;
    const bool turns = c.cmo > 0 ? c.con2 != 7 : (c.con2 & dof_rotations) != dof_rotations;
    if (translations != 0 && turns) {
      b.unsupported(card, "cmo", "a constraint of the body at a point (|CMO| = 2) is not available",
                    "use CMO = 1 or -1 (at the centre of mass) or a joint to a fixed body");
    }
    c.point = c.node == none ? card.point("xspc") : b.model.nodes.x[static_cast<std::size_t>(c.node)];
  }
  return c;
}

namespace {

RigidMaterial read_rigid(Builder& b, Block& block, const Card& card) {
  RigidMaterial m;
  m.density = card.real("ro", dimension::density);
  m.youngs_modulus = card.real("e", dimension::stress);
  m.poissons_ratio = card.real("pr");
  b.refuse_nonzero(card, "couple", "coupling of the rigid body to MADYMO or CAL3D", "leave N, COUPLE and M at 0");
  b.refuse_nonzero(card, "m", "coupling of the rigid body to MADYMO or CAL3D", "leave N, COUPLE and M at 0");
  b.refuse_nonzero(card, "n", "coupling of the rigid body to MADYMO or CAL3D", "leave N, COUPLE and M at 0");
  const BodyConstraint constraint = read_body_constraint(b, block.next_optional("card1"));
  m.cmo = constraint.cmo;
  m.con1 = constraint.con1;
  m.con2 = constraint.con2;
  m.frame = constraint.frame;
  m.constraint_point = constraint.point;
  m.constraint_node = constraint.node;

  const Card local = block.next_optional("card2");
  m.a = local.direction("lco_or_a1");
  m.v = local.direction("v1");
  // The first field is a frame's number where the others are blank and it is one; else the first component of a vector.
  const double first = local.real("lco_or_a1");
  const bool alone = norm(m.v) == 0 && local.real("a2") == 0 && local.real("a3") == 0;
  if (alone && first != 0) {
    if (first > 0 && first == std::floor(first))
      m.output_frame = b.reference(local, "lco_or_a1", b.frames);
    else
      local.error("lco_or_a1", "found " + local.text("lco_or_a1") + ", expected a coordinate system",
                  "name one, or give A and V");
    m.a = {};
  }
  return m;
}

ElasticMaterial read_elastic_constants(const Card& card) {
  ElasticMaterial m;
  m.density = card.real("ro", dimension::density);
  m.youngs_modulus = card.real("e", dimension::stress);
  m.poissons_ratio = card.real("pr");
  if (m.youngs_modulus <= 0)
    card.error("e", "found " + card.text("e") + ", expected a positive modulus", "give Young's modulus");
  if (m.poissons_ratio <= -1 || m.poissons_ratio >= 0.5) {
    card.error("pr", "found " + card.text("pr") + ", expected a Poisson's ratio between -1 and 0.5",
               "correct the value");
  }
  return m;
}

ElasticMaterial read_elastic(const Card& card) {
  ElasticMaterial m = read_elastic_constants(card);
  m.da = card.real("da");
  m.db = card.real("db");
  return m;
}

void read_hardening_points(PiecewisePlasticMaterial& m, const Card& strains, const Card& stresses) {
  const auto field = [](const char* name, int i) { return name + std::to_string(i + 1); };
  for (int i = 0; i < 8; ++i) {
    m.strain[i] = strains.real(field("eps", i));
    m.stress[i] = stresses.real(field("es", i), dimension::stress);
  }
  int n = 1;
  while (n < 8 && m.strain[n] > m.strain[n - 1]) ++n;
  for (int i = n; i < 8; ++i) {
    if (m.strain[i] == 0) continue;
    strains.error(field("eps", i), "found " + strains.text(field("eps", i)) + " after " + strains.text(field("eps", n - 1)) +
                                       ", expected plastic strains that ascend",
                  "correct the strains, or leave the rest of them blank");
    return;
  }
  if (n >= 2)
    m.points = n;
  else if (std::any_of(m.stress.begin(), m.stress.end(), [](double s) { return s != 0; }))
    stresses.warning("es1", "has stresses, but EPS1 to EPS8 do not ascend: SIGY and ETAN are taken", "give EPS1 to EPS8, or a curve LCSS");
}

void read_piecewise_failure(Builder& b, PiecewisePlasticMaterial& m, const Card& card) {
  const double fail = card.real("fail");
  if (fail < 0) b.unsupported(card, "fail", "failure by a user's subroutine (" + card.text("fail") + ") is not available", "give FAIL >= 0");
  m.failure_strain = fail < 1e20 ? fail : 0;  // 1e21 is written by programs for "none"
  m.smallest_step = card.real("tdel", dimension::time);
  if (m.smallest_step < 0) card.error("tdel", "found " + card.text("tdel") + ", expected a time step", "give TDEL >= 0");
}

void read_piecewise_rate(Builder& b, PiecewisePlasticMaterial& m, const Card& rate) {
  m.rate_constant = rate.real("c", dimension::rate);
  m.rate_exponent = rate.real("p");
  if (m.rate_constant < 0 || m.rate_exponent < 0) {
    rate.error("c", "found C = " + rate.text("c") + ", P = " + rate.text("p") + ", expected positive numbers",
               "give C and P of Cowper and Symonds, or 0");
  }
  if (const Index table = b.tables.find(rate.present() ? rate.id("lcss", IdKind::curve) : 0); table != none)
    m.table = table;
  else
    m.curve = b.optional_curve(rate, "lcss");
  m.rate_curve = b.optional_curve(rate, "lcsr");
  if (m.rate_curve != none && m.rate_constant > 0 && m.rate_exponent > 0 && m.table == none)
    b.unsupported(rate, "lcsr", "a curve LCSR beside C and P is not available", "give LCSR, or C and P");
  if (m.table != none && (m.rate_curve != none || m.rate_constant > 0))
    rate.warning("lcss", "is a table of curves by strain rate: LCSR, C and P are not used", {});
  const double vp = rate.real("vp");
  m.formulation = static_cast<int>(vp);
  if (vp != -1 && vp != 0 && vp != 1 && vp != 3)
    b.unsupported(rate, "vp", "the rate formulation VP = " + rate.text("vp") + " is not available", "set VP = -1, 0, 1 or 3");
  if (m.formulation == 3) {
    const bool given = Builder::has_field(rate.block(), "card1", "rfiltf");
    m.filter = given && rate.real("rfiltf") != 0 ? rate.real("rfiltf") : 0.95;
    if (!(m.filter >= 0 && m.filter < 1)) rate.error("vp", "asks for an average with RFILTF outside [0, 1)", "give 0 <= RFILTF < 1");
  }
}

PiecewisePlasticMaterial read_piecewise_plastic(Builder& b, Block& block, const Card& card) {
  const ElasticMaterial elastic = read_elastic_constants(card);
  PiecewisePlasticMaterial m;
  m.density = elastic.density;
  m.youngs_modulus = elastic.youngs_modulus;
  m.poissons_ratio = elastic.poissons_ratio;
  m.yield_stress = card.real("sigy", dimension::stress);
  m.tangent_modulus = card.real("etan", dimension::stress);
  read_piecewise_failure(b, m, card);
  const Card rate = block.next_optional("card1");
  read_piecewise_rate(b, m, rate);
  if (block.keyword == "MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY") {
    m.modified = true;
    m.thinning = rate.real("epsthin");
    m.major_strain = rate.real("epsmaj");
    m.failing_points = rate.real("numint");
    if (m.thinning < 0) b.unsupported(rate, "epsthin", "thinning of the whole element is not available", "give EPSTHIN > 0 (of each point)");
    if (m.major_strain < 0) b.unsupported(rate, "epsmaj", "an averaged major strain is not available", "give EPSMAJ > 0");
  }
  const Card strains = block.next_optional("card2");
  const Card stresses = block.next_optional("card3");
  if (m.curve == none) read_hardening_points(m, strains, stresses);
  return m;
}

struct SpringLayout {
  SpringLaw law;
  std::array<const char*, 6> reals;
  std::array<const char*, 2> curves;
  bool second_curve_optional;
};

const std::map<std::string, SpringLayout>& spring_layouts() {
  static const std::map<std::string, SpringLayout> layouts{
      {"MAT_SPRING_ELASTIC", {SpringLaw::elastic_spring, {"k"}, {}, false}},
      {"MAT_DAMPER_VISCOUS", {SpringLaw::viscous_damper, {"dc"}, {}, false}},
      {"MAT_SPRING_ELASTOPLASTIC", {SpringLaw::elastoplastic_spring, {"k", "kt", "fy"}, {}, false}},
      {"MAT_SPRING_NONLINEAR_ELASTIC", {SpringLaw::nonlinear_elastic_spring, {}, {"lcd", "lcr"}, true}},
      {"MAT_DAMPER_NONLINEAR_VISCOUS", {SpringLaw::nonlinear_viscous_damper, {}, {"lcdr"}, false}},
      {"MAT_SPRING_GENERAL_NONLINEAR",
       {SpringLaw::general_nonlinear_spring, {"beta", "tyi", "cyi"}, {"lcdl", "lcdu"}, false}},
      {"MAT_SPRING_MAXWELL", {SpringLaw::maxwell_spring, {"k0", "ki", "beta", "tc", "fc", "copt"}, {}, false}},
      {"MAT_SPRING_INELASTIC", {SpringLaw::inelastic_spring, {"ku", "ctf"}, {"lcfd"}, false}}};
  return layouts;
}

SpringMaterial read_spring(Builder& b, const Block& block, const Card& card, const SpringLayout& layout) {
  SpringMaterial m;
  m.law = layout.law;
  const IncludeContext& context = block.context();
  if (context.mass != 1 || context.length != 1 || context.time != 1) {
    b.unsupported(block,
                  "unit factors of *INCLUDE_TRANSFORM on a spring or damper are not available: whether it is "
                  "translational or torsional is not known here",
                  "convert the include's units before");
  }
  for (std::size_t i = 0; i < layout.reals.size(); ++i) {
    if (layout.reals[i] != nullptr) m.p[i] = card.real(layout.reals[i]);
  }
  for (std::size_t i = 0; i < layout.curves.size(); ++i) {
    if (layout.curves[i] == nullptr) continue;
    m.curve[i] = i == 1 && layout.second_curve_optional ? b.optional_curve(card, layout.curves[i])
                                                        : b.reference(card, layout.curves[i], b.curves);
  }
  return m;
}

/// Every field of the cards in the table; a keyword whose cards depend on its fields has its own reader.
FieldMaterial read_fields(Builder& b, Block& block, const Card& first, const MaterialFields& row) {
  FieldMaterial m;
  m.number = row.number;
  m.variant = row.variant;
  m.keyword = block.as_written();
  const auto read = [&](const CardLayout& layout, const Card& card, const std::string& number = {}) {
    for (const FieldLayout& field : layout.fields) {
      if (field.type == 'A' || field.name == "mid") continue;
      if (field.type == 'I' && field.name.starts_with("lc")) {
        const UserId id = card.present() ? card.id(field.name, IdKind::curve) : 0;
        if (const Index table = b.tables.find(id); id != 0 && table != none)
          m.tables[field.name] = table;
        else
          m.curves[field.name] = b.optional_curve(card, field.name);
        continue;
      }
      const auto known = row.dimensions.find(field.name);
      const Dimension d = field.name == "ro"                   ? dimension::density
                          : field.name == "e"                  ? dimension::stress
                          : known != row.dimensions.end() ? known->second
                                                              : dimension::none;
      m.values[field.name + number] = card.real(field.name, d);
    }
  };
  for (const CardLayout& layout : block.info->cards) {
    if (layout.name == row.repeated) {
      for (int i = 1; !block.at_end(); ++i) read(layout, block.next(layout.name), std::to_string(i));
    } else if (layout.name == "card0" || !row.has_card || row.has_card(m, layout.name)) {
      read(layout, layout.name == "card0" ? first : block.next_optional(layout.name));
    }
  }
  m.density = m.value("ro");
  m.youngs_modulus = m.value("e");
  m.poissons_ratio = m.value("pr");
  return m;
}

UnsupportedMaterial read_unsupported(const Block& block, const Card& card) {
  UnsupportedMaterial m;
  m.keyword = block.as_written();
  const CardLayout& layout = block.info->card("card0");
  if (layout.index_of("ro") >= 0) m.density = card.real("ro", dimension::density);
  if (layout.index_of("e") >= 0) m.youngs_modulus = card.real("e", dimension::stress);
  if (layout.index_of("pr") >= 0) m.poissons_ratio = card.real("pr");
  return m;
}

}  // namespace

void build_material(Builder& b, Block& block) {
  const auto spring = spring_layouts().find(block.keyword);
  const bool rigid = block.keyword == "MAT_RIGID", elastic = block.keyword == "MAT_ELASTIC";
  const bool plastic = block.keyword.ends_with("PIECEWISE_LINEAR_PLASTICITY");
  const MaterialFields* fields = material_fields(block.keyword);
  const bool known = plastic || rigid || elastic || fields || spring != spring_layouts().end();
  do {  // an unknown law's cards are not known either: only the first material of the block is read
    Material material;
    if (block.has("TITLE")) material.title = block.next_title();
    const Card card = block.next("card0");
    if (!card.present()) return;
    material.id = card.id("mid", IdKind::material);
    if (rigid)
      material.law = read_rigid(b, block, card);
    else if (elastic)
      material.law = read_elastic(card);
    else if (plastic)
      material.law = read_piecewise_plastic(b, block, card);
    else if (fields)
      material.law = read_fields(b, block, card, *fields);
    else if (known)
      material.law = read_spring(b, block, card, spring->second);
    else
      material.law = read_unsupported(block, card);
    if (b.materials.enter(card, "mid", static_cast<Index>(b.model.materials.size()))) {
      b.material_where.push_back({card.where(), block.as_written()});
      b.model.materials.push_back(std::move(material));
    }
  } while (known && !block.at_end());
}

}  // namespace kardan::deck

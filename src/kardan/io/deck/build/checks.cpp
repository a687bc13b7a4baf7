// What can only be said when the whole model stands.
#include <algorithm>
#include <variant>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

struct PartUse {
  std::array<std::size_t, 4> elements{};  // by ElementKind
  std::size_t total() const { return elements[0] + elements[1] + elements[2] + elements[3]; }
};

std::vector<PartUse> count_elements(const Model& model) {
  std::vector<PartUse> use(model.parts.size());
  const auto count = [&](const auto& block, ElementKind kind) {
    for (const PartIndex p : block.part)
      if (p != none) ++use[at(p)].elements[static_cast<std::size_t>(kind)];
  };
  count(model.shells, ElementKind::shell);
  count(model.solids, ElementKind::solid);
  count(model.beams, ElementKind::beam);
  count(model.discretes, ElementKind::discrete);
  return use;
}

constexpr std::array<const char*, 4> kind_names{"shell", "solid", "beam", "discrete"};

void check_part(Builder& b, PartIndex p, const PartUse& use) {
  const Part& part = b.model.parts[at(p)];
  const std::string name = "part " + std::to_string(part.id);
  const auto error = [&](std::string field, std::string message, std::string cure) {
    b.diagnostics.add({Severity::error, b.part_where[at(p)].where, part.inertia ? "*PART_INERTIA" : "*PART",
                       std::move(field), std::move(message), std::move(cure)});
  };
  if (use.total() == 0) return;
  if (part.nodal_rigid_body != none) {
    error("PID", name + " is a nodal rigid body but has elements", "give the elements a part of their own");
    return;
  }
  const Builder::PartPlace& place = b.part_where[at(p)];
  if (part.section == none && !place.names_section)
    error("SECID", name + " has elements but no section", "name a section of *SECTION");
  if (part.material == none && !place.names_material)
    error("MID", name + " has elements but no material", "name a material of *MAT");
  if (part.section != none) {
    const ElementKind kind = b.model.sections[at(part.section)].kind;
    for (std::size_t k = 0; k < 4; ++k) {
      if (use.elements[k] == 0 || static_cast<ElementKind>(k) == kind) continue;
      error("SECID",
            name + " has " + kind_names[k] + " elements but section " +
                std::to_string(b.model.sections[at(part.section)].id) + " is one for " +
                kind_names[static_cast<std::size_t>(kind)] + " elements",
            std::string("name a section of *SECTION_") + kind_names[k]);
    }
    if (kind == ElementKind::shell && use.elements[0] != 0 &&
        b.model.sections[at(part.section)].shell.thickness[0] <= 0) {
      const auto& own = b.model.shells.thickness;
      const auto& parts = b.model.shells.part;
      for (std::size_t e = 0; e < parts.size(); ++e) {
        if (parts[e] != p || own.contains(static_cast<Index>(e))) continue;
        error("SECID", name + " has shells without a thickness",
              "give T1 in *SECTION_SHELL or *ELEMENT_SHELL_THICKNESS");
        break;
      }
    }
  }
  if (part.material == none) return;
  const Material& material = b.model.materials[at(part.material)];
  const bool spring = std::holds_alternative<SpringMaterial>(material.law);
  const bool unknown = std::holds_alternative<UnsupportedMaterial>(material.law);
  if (!unknown && (spring != (use.elements[3] != 0) || (spring && use.total() != use.elements[3]))) {
    error("MID",
          name + (spring ? " has a spring or damper material but elements that are not discrete"
                         : " has discrete elements but a material that is no spring or damper"),
          spring ? "use a material for solids, shells or beams" : "use *MAT_SPRING or *MAT_DAMPER");
  }
  if (const auto* law = std::get_if<UnsupportedMaterial>(&material.law)) {
    const auto& [where, keyword] = b.material_where[at(part.material)];
    b.model.unsupported.push_back(
        {Severity::error, where, keyword, "",
         "material " + std::to_string(material.id) + " of the deformable part " + std::to_string(part.id) +
             " has a law that Kardan cannot compute yet",
         law->density > 0 ? "use *MAT_ELASTIC or *MAT_RIGID" : "use a material with a density"});
  }
}

void check_joints(Builder& b) {
  for (const Card& card : b.joint_references) {
    const UserId id = card.id("jid", IdKind::other);
    if (b.joint_ids.find(id) == none) {
      card.error("jid", "joint " + std::to_string(id) + " is not defined",
                 "define it with *CONSTRAINED_JOINT_…_ID, or leave JID at 0");
    }
  }
}

/// A node that two joints' bodies, parts and nodal rigid bodies claim is the business of rigid/; here only what the
/// deck alone can say: a body needs something it is made of.
void check_empty_bodies(Builder& b, const std::vector<PartUse>& use) {
  std::vector<bool> fed(b.model.parts.size(), false);
  for (const ExtraNodes& extra : b.model.extra_nodes) fed[at(extra.part)] = true;
  for (const RigidBodyMerge& merge : b.model.merges) fed[at(merge.lead)] = true;
  for (std::size_t p = 0; p < b.model.parts.size(); ++p) {
    const Part& part = b.model.parts[p];
    if (part.nodal_rigid_body != none || part.inertia || fed[p] || use[p].total() != 0) continue;
    b.diagnostics.add({Severity::warning, b.part_where[p].where, "*PART", "PID",
                       "part " + std::to_string(part.id) + " has no elements",
                       "leave the part out, or check the part numbers of the elements"});
  }
}

}  // namespace

void check_model(Builder& b) {
  const std::vector<PartUse> use = count_elements(b.model);
  for (std::size_t p = 0; p < b.model.parts.size(); ++p) check_part(b, static_cast<PartIndex>(p), use[p]);
  check_empty_bodies(b, use);
  check_joints(b);
  for (BodyLoad& load : b.model.body_loads) load.parts = b.body_load_parts;
  if (!(b.model.control.termination.end_time > 0) && b.model.control.termination.end_cycle == 0 &&
      b.options.end_time <= 0) {
    b.diagnostics.add({Severity::warning,
                       {},
                       "*CONTROL_TERMINATION",
                       "ENDTIM",
                       "the deck gives no end time",
                       "give ENDTIM, or --end on the command line"});
  }
}

}  // namespace kardan::deck

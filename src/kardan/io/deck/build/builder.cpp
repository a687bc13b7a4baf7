#include "kardan/io/deck/build/builder.hpp"

#include <algorithm>
#include <cctype>
#include <memory>
#include <unordered_map>

#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

/// When a keyword's turn comes: everything it may name belongs to an earlier phase.
enum Phase : int {
  nodes_phase,
  control_phase,
  curves,
  frames,
  properties,
  parts_phase,
  elements_phase,
  sets_phase,
  switches,
  rest,
  phases
};

struct Entry {
  int phase;
  Handler handler;
};

const std::unordered_map<std::string, Entry>& table() {
  static const std::unordered_map<std::string, Entry> entries{
      {"NODE", {nodes_phase, build_nodes}},
      {"TITLE", {control_phase, build_title}},
      {"CONTROL_TERMINATION", {control_phase, build_control}},
      {"CONTROL_SHELL", {control_phase, build_control}},
      {"DEFINE_CURVE", {curves, build_curve}},
      {"DEFINE_CURVE_FUNCTION", {curves, build_curve_function}},
      {"DEFINE_TABLE", {frames, build_table}},
      {"DEFINE_COORDINATE_SYSTEM", {frames, build_coordinate_system}},
      {"DEFINE_COORDINATE_NODES", {frames, build_coordinate_nodes}},
      {"DEFINE_COORDINATE_VECTOR", {frames, build_coordinate_vector}},
      {"DEFINE_VECTOR", {properties, build_vector}},
      {"DEFINE_VECTOR_NODES", {properties, build_vector_nodes}},
      {"DEFINE_SD_ORIENTATION", {frames, build_sd_orientation}},
      {"DEFINE_BOX", {frames, build_box}},
      {"INTEGRATION_SHELL", {frames, build_integration_shell}},
      {"SECTION_SHELL", {properties, build_section_shell}},
      {"SECTION_SOLID", {properties, build_section_solid}},
      {"SECTION_BEAM", {properties, build_section_beam}},
      {"SECTION_DISCRETE", {properties, build_section_discrete}},
      {"HOURGLASS", {properties, build_hourglass}},
      {"EOS_LINEAR_POLYNOMIAL", {properties, build_equation_of_state}},
      {"EOS_GRUNEISEN", {properties, build_equation_of_state}},
      {"PART", {parts_phase, build_part}},
      {"ELEMENT_SHELL", {elements_phase, build_shells}},
      {"ELEMENT_SOLID", {elements_phase, build_solids}},
      {"ELEMENT_BEAM", {elements_phase, build_beams}},
      {"ELEMENT_DISCRETE", {elements_phase, build_discretes}},
      {"ELEMENT_MASS", {rest, build_mass}},
      {"ELEMENT_MASS_NODE_SET", {rest, build_mass_node_set}},
      {"ELEMENT_MASS_PART", {rest, build_mass_part}},
      {"ELEMENT_INERTIA", {rest, build_inertia}},
      {"MAT_ADD_EROSION", {rest, build_erosion}},
      {"DEFORMABLE_TO_RIGID", {switches, build_deformable_to_rigid}},
      {"DEFORMABLE_TO_RIGID_AUTOMATIC", {rest, build_automatic_switch}},
      {"CONSTRAINED_RIGID_BODIES", {rest, build_rigid_bodies}},
      {"CONSTRAINED_EXTRA_NODES_NODE", {rest, build_extra_nodes}},
      {"CONSTRAINED_EXTRA_NODES_SET", {rest, build_extra_nodes}},
      {"CONSTRAINED_RIGID_BODY_STOPPERS", {rest, build_stoppers}},
      {"BOUNDARY_SPC_NODE", {rest, build_spc}},
      {"BOUNDARY_SPC_SET", {rest, build_spc}},
      {"BOUNDARY_PRESCRIBED_MOTION_RIGID", {rest, build_prescribed_motion}},
      {"BOUNDARY_PRESCRIBED_MOTION_NODE", {rest, build_prescribed_motion}},
      {"BOUNDARY_PRESCRIBED_MOTION_SET", {rest, build_prescribed_motion}},
      {"INITIAL_STRESS_SHELL", {rest, build_initial_stress_shell}},
      {"INITIAL_STRESS_SHELL_SET", {rest, build_initial_stress_shell}},
      {"INITIAL_STRESS_SOLID", {rest, build_initial_stress_solid}},
      {"INITIAL_STRESS_SOLID_SET", {rest, build_initial_stress_solid}},
      {"INITIAL_STRESS_BEAM", {rest, build_initial_stress_beam}},
      {"INITIAL_VELOCITY", {rest, build_initial_velocity}},
      {"INITIAL_VELOCITY_NODE", {rest, build_initial_velocity_node}},
      {"INITIAL_VELOCITY_RIGID_BODY", {rest, build_initial_velocity_rigid}},
      {"INITIAL_VELOCITY_GENERATION", {rest, build_initial_velocity_generation}},
      {"LOAD_BODY_PARTS", {rest, build_body_load_parts}},
      {"LOAD_RIGID_BODY", {rest, build_point_load}},
      {"LOAD_NODE_POINT", {rest, build_point_load}},
      {"LOAD_NODE_SET", {rest, build_point_load}},
      {"LOAD_SEGMENT", {rest, build_pressure}},
      {"DATABASE_CROSS_SECTION_PLANE", {rest, build_cross_section}},
      {"DATABASE_CROSS_SECTION_SET", {rest, build_cross_section}},
      {"LOAD_SEGMENT_SET", {rest, build_pressure}},
      {"LOAD_SHELL_ELEMENT", {rest, build_pressure}},
      {"LOAD_SHELL_SET", {rest, build_pressure}},
      {"DAMPING_GLOBAL", {rest, build_damping_global}},
      {"DAMPING_PART_MASS", {rest, build_damping_part}},
      {"DAMPING_PART_STIFFNESS", {rest, build_damping_stiffness}},
      {"DAMPING_PART_STIFFNESS_SET", {rest, build_damping_stiffness}},
      {"DAMPING_PART_MASS_SET", {rest, build_damping_part}},
      {"DAMPING_RELATIVE", {rest, build_damping_relative}},
      {"BOUNDARY_NON_REFLECTING", {rest, build_non_reflecting}},
      {"CONSTRAINED_SPOTWELD", {rest, build_spotweld}},
      {"CONSTRAINED_GENERALIZED_WELD_SPOT", {rest, build_generalized_weld}},
      {"CONSTRAINED_GENERALIZED_WELD_FILLET", {rest, build_generalized_weld}},
      {"CONSTRAINED_GENERALIZED_WELD_BUTT", {rest, build_generalized_weld}},
      {"CONSTRAINED_NODE_SET", {rest, build_node_set_constraint}},
      {"CONSTRAINED_LINEAR_GLOBAL", {rest, build_linear_constraint}},
      {"CONSTRAINED_LINEAR_LOCAL", {rest, build_linear_constraint}},
      {"CONSTRAINED_INTERPOLATION", {rest, build_interpolation}},
      {"CONSTRAINED_INTERPOLATION_LOCAL", {rest, build_interpolation}},
      {"RIGIDWALL_PLANAR", {rest, build_rigid_wall}},
      {"DEFINE_FRICTION", {switches, build_friction_table}},
      {"RIGIDWALL_GEOMETRIC_FLAT", {rest, build_rigid_wall}},
      {"RIGIDWALL_GEOMETRIC_PRISM", {rest, build_rigid_wall}},
      {"RIGIDWALL_GEOMETRIC_CYLINDER", {rest, build_rigid_wall}},
      {"RIGIDWALL_GEOMETRIC_SPHERE", {rest, build_rigid_wall}}};
  return entries;
}

/// Families whose members differ by a suffix only.
struct Family {
  std::string_view prefix;
  Entry entry;
};
constexpr std::array<Family, 11> families{{{"SET_", {sets_phase, register_set}},
                                           {"CONTACT_", {rest, build_contact}},
                                           {"CONSTRAINED_JOINT_STIFFNESS", {rest, build_joint_stiffness}},
                                           {"CONSTRAINED_JOINT_", {rest, build_joint}},
                                           {"CONSTRAINED_NODAL_RIGID_BODY", {elements_phase, build_nodal_rigid_body}},
                                           {"BOUNDARY_PRESCRIBED_MOTION_RIGID", {rest, build_prescribed_motion}},
                                           {"LOAD_BODY_", {rest, build_body_load}},
                                           {"MAT_", {properties, build_material}},
                                           {"CONTROL_", {rest, build_control}},
                                           {"DATABASE_HISTORY_", {rest, build_history}},
                                           {"DATABASE_", {rest, build_database}}}};

const Entry* find_entry(const std::string& keyword) {
  const auto hit = table().find(keyword);
  if (hit != table().end()) return &hit->second;
  for (const Family& family : families) {
    if (keyword.starts_with(family.prefix)) return &family.entry;
  }
  return nullptr;
}

std::string quoted(std::string_view what, UserId id) {
  return std::string(what) + " " + std::to_string(id);
}

}  // namespace

bool builds(const std::string& keyword) {
  return find_entry(keyword) != nullptr;
}

Model build_model(Deck& deck, const BuildOptions& options, Diagnostics& diagnostics) {
  Model model;
  Builder(deck, options, model, diagnostics).build();
  return model;
}

bool IdSpace::enter(const Card& card, std::string_view field, Index index) {
  return enter_id(card, field, card.id(field, kind), index);
}

bool IdSpace::enter_id(const Card& card, std::string_view field, UserId id, Index index) {
  if (id <= 0) {
    card.error(field, "found " + std::to_string(id) + ", expected the positive number of a " + what,
               std::string("give the ") + what + " a number of its own");
    return false;
  }
  if (!map_.emplace(id, index).second) {
    const SourceLocation& first = where_[id];
    card.error(field, quoted(what, id) + " is defined twice; first at " + first.file + ":" + std::to_string(first.line),
               "remove one of the two or give it another number");
    return false;
  }
  where_.emplace(id, card.where());
  return true;
}

Builder::Builder(Deck& deck_, const BuildOptions& options_, Model& model_, Diagnostics& diagnostics_)
    : deck(deck_), options(options_), model(model_), diagnostics(diagnostics_), sets(std::make_unique<Sets>(*this)) {}
Builder::~Builder() = default;

void Builder::build() {
  for (int phase = 0; phase < phases; ++phase) {
    run_phase(phase);
    if (phase == sets_phase) {
      sets->resolve_all();
      finish_nodal_rigid_bodies(*this);
    }
  }
  finish_switches(*this);
  finish_contacts(*this);
  check_model(*this);
  replace_relative_motions(*this);
  finish_relaxation(*this);
  for (Curve& curve : model.curves) curve.prepare();
}

void Builder::run_phase(int phase) {
  for (Block& block : deck.blocks) {
    const Entry* entry = find_entry(block.keyword);
    if (entry == nullptr) {
      if (phase == 0) {
        block.error("is in the table of honoured keywords, but the model builder has no place for it",
                    "report this as a fault of Kardan");
      }
    } else if (entry->phase == phase) {
      entry->handler(*this, block);
    }
  }
}

Index Builder::reference(const Card& card, std::string_view field, const IdSpace& space) {
  const UserId id = card.id(field, space.kind);
  if (id == 0) {
    card.error(field, std::string("is blank or 0, expected the number of a ") + space.what,
               std::string("name a ") + space.what + " of " + space.keyword);
    return none;
  }
  const Index i = space.find(id);
  if (i == none) {
    card.error(field, quoted(space.what, id) + " is not defined",
               std::string("define it with ") + space.keyword + " or correct the number");
  }
  return i;
}

Index Builder::optional_reference(const Card& card, std::string_view field, const IdSpace& space) {
  return card.id(field, space.kind) == 0 ? none : reference(card, field, space);
}

NodeIndex Builder::node(const Card& card, std::string_view field) {
  const UserId id = card.id(field, IdKind::node);
  if (id == 0) {
    card.error(field, "is blank or 0, expected a node", "name a node of *NODE");
    return none;
  }
  const NodeIndex n = model.nodes.index_of.index(id);
  if (n == none)
    card.error(field, quoted("node", id) + " is not defined", "define it with *NODE or correct the number");
  return n;
}

NodeIndex Builder::optional_node(const Card& card, std::string_view field) {
  return card.id(field, IdKind::node) == 0 ? none : node(card, field);
}

PartIndex Builder::body(const Card& card, std::string_view field) {
  const PartIndex p = reference(card, field, parts);
  if (p == none || model.body_part(p)) return p;
  const Index material = model.parts[static_cast<std::size_t>(p)].material;
  if (material != none) {  // without a material the part itself has been reported
    card.error(field,
               quoted("part", model.parts[static_cast<std::size_t>(p)].id) + " is not rigid, expected a rigid body",
               "give the part *MAT_RIGID, or name a nodal rigid body");
  }
  return none;
}

CurveIndex Builder::curve_of_id(const Card& card, std::string_view field, UserId id) {
  const CurveIndex c = curves.find(id);
  if (c != none) return c;
  if (tables.find(id) != none) {
    card.error(field, "found table " + std::to_string(id) + ", expected a curve", "name a curve of *DEFINE_CURVE");
  } else {
    card.error(field, quoted("curve", id) + " is not defined", "define it with *DEFINE_CURVE or correct the number");
  }
  return none;
}

CurveIndex Builder::curve_or_constant(const Card& card, std::string_view field) {
  const UserId id = card.id(field, IdKind::curve);
  if (id < 0) {
    card.error(field, "found " + std::to_string(id) + ", expected a curve's number", "give a positive number");
    return none;
  }
  if (id > 0) return curve_of_id(card, field, id);
  card.warning(field, "no curve is named: the scale factor acts as a constant from the start",
               "name a *DEFINE_CURVE if the value is to change with time");
  if (constant_one == none) {
    constant_one = static_cast<CurveIndex>(model.curves.size());
    model.curves.push_back({0, "constant 1", {0.0}, {1.0}, {}, Curve::Phase::both});
  }
  return constant_one;
}

std::vector<NodeIndex> Builder::node_set(const Card& card, std::string_view field) {
  const Index set = sets->reference(card, field, SetKind::node);
  return set == none ? std::vector<NodeIndex>{} : model.node_sets[static_cast<std::size_t>(set)].nodes;
}

std::vector<PartIndex> Builder::part_set(const Card& card, std::string_view field) {
  const Index set = sets->reference(card, field, SetKind::part);
  return set == none ? std::vector<PartIndex>{} : model.part_sets[static_cast<std::size_t>(set)].parts;
}

void Builder::unsupported(const Card& card, std::string_view field, std::string message, std::string cure) {
  std::string name(field);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  model.unsupported.push_back({Severity::error, field.empty() ? card.where() : card.where(field),
                               card.block().as_written(), std::move(name), std::move(message), std::move(cure)});
}

void Builder::unsupported(const Block& block, std::string message, std::string cure) {
  model.unsupported.push_back(
      {Severity::error, block.where, block.as_written(), "", std::move(message), std::move(cure)});
}

void Builder::ignored(const Card& card, std::string_view field, const std::string& consequence) {
  if (!card.present() || card.is_default(field) || card.text(field).find_first_not_of("0.+-eE ") == std::string::npos) return;  // 0 is LS-DYNA's default too
  card.warning(field, "the value " + card.text(field) + " is read but not honoured: " + consequence);
}

void Builder::refuse_nonzero(const Card& card, std::string_view field, const std::string& meaning,
                             const std::string& cure) {
  if (!card.present() || card.is_default(field)) return;
  unsupported(card, field, meaning + " (" + card.text(field) + ") is not available", cure);
}

int Builder::integer_in(const Card& card, std::string_view field, int low, int high) {
  const std::int64_t value = card.integer(field);
  if (value >= low && value <= high) return static_cast<int>(value);
  card.error(field,
             "found " + std::to_string(value) + ", expected " + std::to_string(low) + " to " + std::to_string(high),
             "correct the value");
  return low;
}

double Builder::real_or(const Card& card, std::string_view field, double fallback, Dimension d) {
  const double value = card.real(field, d);
  return value == 0 ? fallback : value;
}

double Builder::time_or(const Card& card, std::string_view field, double fallback) {
  return real_or(card, field, fallback, dimension::time);
}

bool Builder::has_field(const Block& block, std::string_view card_name, std::string_view field) {
  const CardLayout* card = block.info->find_card(card_name);
  return card != nullptr && card->index_of(field) >= 0;
}

}  // namespace kardan::deck

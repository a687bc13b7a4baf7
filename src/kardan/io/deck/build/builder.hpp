// What the builders of the keyword families share: the model in the making, the numbers met so far, resolved
// references.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kardan/io/deck/build/build.hpp"
#include "kardan/io/deck/deck.hpp"
#include "kardan/model/id_map.hpp"
#include "kardan/model/model.hpp"

namespace kardan::deck {

/// The numbers of one kind of thing (parts, curves, …): which index each has and where it was defined.
class IdSpace {
 public:
  IdSpace(IdKind kind_, const char* what_, const char* keyword_) : kind(kind_), what(what_), keyword(keyword_) {}

  /// Gives the number in `field` to `index`. A number that is not positive or taken already is reported: false.
  bool enter(const Card& card, std::string_view field, Index index);
  /// The same for a number already read, reported at `card`.
  bool enter_id(const Card& card, std::string_view field, UserId id, Index index);
  Index find(UserId id) const { return map_.index(id); }

  const IdKind kind;
  const char* const what;     ///< "part", for messages
  const char* const keyword;  ///< "*PART": what defines one

 private:
  IdMap map_;
  std::map<UserId, SourceLocation> where_;
};

enum class SetKind : std::uint8_t { node, part, segment, shell, solid, beam, discrete };
constexpr std::size_t set_kinds = 7;

class Sets;

class Builder {
 public:
  Builder(Deck& deck_, const BuildOptions& options_, Model& model_, Diagnostics& diagnostics_);
  ~Builder();
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  void build();

  // -- references: `none` and a message where the number is missing or unknown -------------------------------------
  /// The index of the thing named in a field that must name one.
  Index reference(const Card& card, std::string_view field, const IdSpace& space);
  /// The same where 0 or blank means "none".
  Index optional_reference(const Card& card, std::string_view field, const IdSpace& space);
  NodeIndex node(const Card& card, std::string_view field);
  NodeIndex optional_node(const Card& card, std::string_view field);
  /// A rigid body: a part of *MAT_RIGID or a nodal rigid body.
  PartIndex body(const Card& card, std::string_view field);
  /// A curve; 0 gives the constant 1 (with a warning: the scale factor acts as a constant), negative is an error.
  CurveIndex curve_or_constant(const Card& card, std::string_view field);
  CurveIndex optional_curve(const Card& card, std::string_view field) {
    return optional_reference(card, field, curves);
  }
  /// Curve number given directly (already shifted).
  CurveIndex curve_of_id(const Card& card, std::string_view field, UserId id);
  /// Nodes of the set named in a field that must name one.
  std::vector<NodeIndex> node_set(const Card& card, std::string_view field);
  std::vector<PartIndex> part_set(const Card& card, std::string_view field);

  // -- what is not honoured ---------------------------------------------------------------------------------------
  /// The deck is right, Kardan cannot compute it: a run is refused.
  void unsupported(const Card& card, std::string_view field, std::string message, std::string cure);
  void unsupported(const Block& block, std::string message, std::string cure);
  /// A warning where a field differs from its default: `consequence` says what happens instead.
  void ignored(const Card& card, std::string_view field, const std::string& consequence);
  /// Refuses a run where a field differs from its default.
  void refuse_nonzero(const Card& card, std::string_view field, const std::string& meaning, const std::string& cure);

  /// 3, 4 or 5 … from a card; an error where it is outside [low, high].
  int integer_in(const Card& card, std::string_view field, int low, int high);
  /// The value, or `fallback` where the field is blank or 0.
  static double real_or(const Card& card, std::string_view field, double fallback, Dimension d = dimension::none);
  static double time_or(const Card& card, std::string_view field, double fallback);

  static bool has_field(const Block& block, std::string_view card_name, std::string_view field);

  Deck& deck;
  const BuildOptions& options;
  Model& model;
  Diagnostics& diagnostics;

  IdSpace parts{IdKind::part, "part", "*PART"};
  IdSpace sections{IdKind::other, "section", "*SECTION"};
  IdSpace materials{IdKind::material, "material", "*MAT"};
  IdSpace equations_of_state{IdKind::other, "equation of state", "*EOS"};
  IdSpace shell_rules{IdKind::other, "integration rule", "*INTEGRATION_SHELL"};
  IdSpace hourglasses{IdKind::other, "hourglass record", "*HOURGLASS"};
  IdSpace curves{IdKind::curve, "curve", "*DEFINE_CURVE"};
  IdSpace tables{IdKind::curve, "table", "*DEFINE_TABLE"};
  IdSpace frames{IdKind::define, "coordinate system", "*DEFINE_COORDINATE"};
  IdSpace vectors{IdKind::define, "vector", "*DEFINE_VECTOR"};
  IdSpace sd_orientations{IdKind::define, "orientation", "*DEFINE_SD_ORIENTATION"};
  IdSpace boxes{IdKind::define, "box", "*DEFINE_BOX"};
  IdSpace friction_tables{IdKind::define, "friction table", "*DEFINE_FRICTION"};

  IdSpace joint_ids{IdKind::other, "joint", "*CONSTRAINED_JOINT_…_ID"};
  IdSpace joint_stiffness_ids{IdKind::other, "joint stiffness", "*CONSTRAINED_JOINT_STIFFNESS"};

  std::vector<Box> box_list;
  /// Element number -> index, by ElementKind. All kinds share the numbers of their own kind only.
  std::array<IdMap, 4> elements;
  std::unique_ptr<Sets> sets;
  /// Curves that follow a *DEFINE_TABLE without numbers of their own are found through the blocks' order.
  std::map<const Block*, CurveIndex> curve_of_block;

  struct PendingBody {
    Card card;
    Index body;
    UserId set;
    bool default_set;  // NSID left at 0
  };
  std::vector<PendingBody> pending_bodies;  ///< nodal rigid bodies whose node sets are not resolved yet
  std::vector<PartIndex> body_load_parts;   ///< *LOAD_BODY_PARTS
  struct PartPlace {
    SourceLocation where;
    bool names_section, names_material;  // what is named and unknown has been reported already
  };
  std::vector<PartPlace> part_where;                                   ///< of each entry of model.parts
  std::vector<std::pair<SourceLocation, std::string>> material_where;  ///< of each material: place and keyword
  std::vector<Card> joint_where;                                       ///< first card of each joint
  std::vector<Card> joint_references;                                  ///< joint stiffnesses that name a joint
  CurveIndex constant_one = none;
  struct PartSwitch {
    Card card;
    PartIndex part, lead;
    double time;
    bool to_rigid;
  };
  std::vector<std::pair<Card, PartIndex>> switched_from_start;         ///< of *DEFORMABLE_TO_RIGID, without a lead part
  std::vector<PartSwitch> part_switches;                               ///< of *DEFORMABLE_TO_RIGID_AUTOMATIC
  bool relaxation_curves = false;                                      ///< some curve has SIDR = 1 or 2
  struct ContactDefaults {
    int shell_thickness = 0, initial_penetration = 0;                  // SHLTHK, IGNORE
  } contact_defaults;                                                  ///< of *CONTROL_CONTACT
  std::optional<Card> relaxation;                                      ///< *CONTROL_DYNAMIC_RELAXATION

 private:
  void run_phase(int phase);
};

using Handler = void (*)(Builder&, Block&);

// The families, each in its own file. Phases: what is named must exist before what names it.
void build_nodes(Builder&, Block&);
void build_shells(Builder&, Block&);
void build_solids(Builder&, Block&);
void build_beams(Builder&, Block&);
void build_discretes(Builder&, Block&);
void build_mass(Builder&, Block&);
void build_mass_node_set(Builder&, Block&);
void build_mass_part(Builder&, Block&);
void build_inertia(Builder&, Block&);

void build_part(Builder&, Block&);
void build_section_shell(Builder&, Block&);
void build_integration_shell(Builder&, Block&);
void build_section_solid(Builder&, Block&);
void build_section_beam(Builder&, Block&);
void build_section_discrete(Builder&, Block&);
void build_hourglass(Builder&, Block&);
void build_material(Builder&, Block&);
void build_equation_of_state(Builder&, Block&);
void build_erosion(Builder&, Block&);

void build_curve(Builder&, Block&);
void build_curve_function(Builder&, Block&);
void build_table(Builder&, Block&);
void build_coordinate_system(Builder&, Block&);
void build_coordinate_nodes(Builder&, Block&);
void build_coordinate_vector(Builder&, Block&);
void build_vector(Builder&, Block&);
void build_vector_nodes(Builder&, Block&);
void build_sd_orientation(Builder&, Block&);
void build_box(Builder&, Block&);

void register_set(Builder&, Block&);

void build_nodal_rigid_body(Builder&, Block&);
void finish_nodal_rigid_bodies(Builder&);
/// Motions relative to another body (VAD = 4) become motors between the two bodies.
void replace_relative_motions(Builder&);
/// *DEFORMABLE_TO_RIGID: before anything asks whether a part is rigid.
void build_deformable_to_rigid(Builder&, Block&);
void build_automatic_switch(Builder&, Block&);
/// Makes rigid groups of the parts that are switched.
void finish_switches(Builder&);
void build_rigid_bodies(Builder&, Block&);
void build_extra_nodes(Builder&, Block&);
void build_stoppers(Builder&, Block&);
void build_joint(Builder&, Block&);
void build_joint_stiffness(Builder&, Block&);

void build_spc(Builder&, Block&);
void build_prescribed_motion(Builder&, Block&);
void build_initial_velocity(Builder&, Block&);
void build_initial_velocity_node(Builder&, Block&);
void build_initial_velocity_rigid(Builder&, Block&);
void build_initial_velocity_generation(Builder&, Block&);
void build_initial_stress_shell(Builder&, Block&);
void build_initial_stress_solid(Builder&, Block&);
void build_initial_stress_beam(Builder&, Block&);
void build_body_load(Builder&, Block&);
void build_body_load_parts(Builder&, Block&);
void build_point_load(Builder&, Block&);
void build_pressure(Builder&, Block&);
void build_damping_global(Builder&, Block&);
void build_damping_part(Builder&, Block&);
void build_damping_relative(Builder&, Block&);
void build_damping_stiffness(Builder&, Block&);
void build_non_reflecting(Builder&, Block&);
void build_spotweld(Builder&, Block&);
void build_generalized_weld(Builder&, Block&);
void build_node_set_constraint(Builder&, Block&);
void build_linear_constraint(Builder&, Block&);
void build_interpolation(Builder&, Block&);
void build_rigid_wall(Builder&, Block&);
void build_contact(Builder&, Block&);
void build_friction_table(Builder&, Block&);
void read_control_contact(Builder&, Block&);
PartContact read_part_contact(const Card& card);
/// What *CONTROL_CONTACT sets for contacts that say nothing themselves.
void finish_contacts(Builder&);

void build_title(Builder&, Block&);
void build_control(Builder&, Block&);
void build_database(Builder&, Block&);
void build_history(Builder&, Block&);
void build_cross_section(Builder&, Block&);

/// Settles whether the run begins with a dynamic relaxation; refuses what cannot go with it.
void finish_relaxation(Builder&);
void check_model(Builder&);

/// A shell as a segment: a triangle repeats its third node.
std::array<NodeIndex, 4> segment_of_shell(const Builder& builder, Index shell);
/// Six tensor fields ixx … izz of a card.
Mat3 read_inertia(const Card& card);
/// The cards inertia0 … inertia3 of *PART_INERTIA and nodal rigid bodies: centre, tensor, velocities and, with IRCS =
/// 1, axes. `frame_field` is the name of the coordinate system's field on the last one.
GivenInertia read_given_inertia(Builder& builder, Block& block, const std::string& frame_field);
/// CMO, CON1, CON2 and the point of *MAT_RIGID and *CONSTRAINED_NODAL_RIGID_BODY_SPC.
struct BodyConstraint {
  double cmo = 0;
  int con1 = 0, con2 = 0;
  Index frame = none;
  Vec3 point{};
  NodeIndex node = none;
};
BodyConstraint read_body_constraint(Builder& builder, const Card& card);

}  // namespace kardan::deck

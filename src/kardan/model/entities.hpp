// What a model is meshed of: nodes, elements, sections, parts, sets, frames.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/model/contact.hpp"
#include "kardan/model/id_map.hpp"

namespace kardan {

/// Bits of a set of degrees of freedom in some frame.
enum Dof : std::uint8_t {
  dof_x = 1, dof_y = 2, dof_z = 4, dof_rx = 8, dof_ry = 16, dof_rz = 32,
  dof_translations = 7, dof_rotations = 56, dof_all = 63
};

/// *NODE; arrays of one length, in the order of the deck.
struct Nodes {
  std::vector<UserId> id;
  std::vector<Vec3> x;                    ///< initial coordinates, global
  std::vector<std::uint8_t> constrained;  ///< Dof bits from TC and RC of *NODE, global axes
  IdMap index_of;                         ///< user id -> index

  std::size_t size() const { return id.size(); }
};

enum class ElementKind : std::uint8_t { shell, solid, beam, discrete };

/// Connectivity of the elements of one kind. Nodes not used by an element are `none`; a triangle repeats its third node,
/// a tetrahedron or wedge repeats nodes as LS-DYNA does.
template <std::size_t NodeCount>
struct ElementBlock {
  std::vector<UserId> id;
  std::vector<PartIndex> part;
  std::vector<std::array<NodeIndex, NodeCount>> nodes;

  std::size_t size() const { return id.size(); }
};

struct ShellElements : ElementBlock<4> {
  /// *ELEMENT_SHELL_THICKNESS: thickness at the four nodes by element index; absent where the section's holds.
  std::unordered_map<Index, std::array<double, 4>> thickness;
  /// *ELEMENT_SHELL_OFFSET: height of the mid surface above the nodes, along the element's normal; absent: NLOC of the section.
  std::unordered_map<Index, double> offset;
};

struct SolidElements : ElementBlock<8> {};

struct BeamElements : ElementBlock<3> {  ///< third node: orientation, may be `none`
  std::unordered_map<Index, Vec3> orientation;              ///< *ELEMENT_BEAM_ORIENTATION: vector from node 1 in place of the third node
  std::unordered_map<Index, std::array<double, 5>> sizes;   ///< *ELEMENT_BEAM_THICKNESS: PARM1 to PARM5; 0 = the section's
};

/// *ELEMENT_DISCRETE: springs and dampers between two nodes, or one node and ground (second node `none`).
struct DiscreteElements : ElementBlock<2> {
  std::vector<Index> orientation;   ///< into Model::sd_orientations, `none` = along the line of the nodes
  std::vector<double> scale;        ///< S on the force
  std::vector<std::uint8_t> print;  ///< PF: 0 = in DEFORC
  std::vector<double> offset;       ///< initial offset (displacement or rotation at t = 0)
};

/// *ELEMENT_MASS, _NODE_SET, _PART (distributed already to nodes by the reader).
struct PointMass {
  UserId id = 0;
  NodeIndex node = none;
  double mass = 0;
  PartIndex part = none;  ///< part that counts it in MATSUM, or none
};

/// *ELEMENT_INERTIA: tensor entries about the node (IXY is the entry of the tensor), global axes or those of `frame`.
struct PointInertia {
  UserId id = 0;
  NodeIndex node = none;
  double mass = 0;
  Mat3 inertia{};
  Index frame = none;
};

/// *INTEGRATION_SHELL: a rule through the thickness.
struct ShellRule {
  UserId id = 0;
  bool equal = false;               ///< ESOP = 1: points in the middle of equal layers
  int points = 0;
  std::vector<double> s, weight;    ///< by point: -1 inside to 1 outside, thickness of its layer over all; empty where `equal`
};

struct ShellSection {
  int elform = 2;
  double shrf = 1.0;
  int nip = 2;
  Index rule = none;                ///< into Model::shell_rules; else NIP points of CONTROL_SHELL's INTGRD
  std::array<double, 4> thickness{};
  double nloc = 0;
  double mass_per_area = 0;  ///< MAREA
};
struct SolidSection { int elform = 1; };
struct BeamSection {
  int elform = 1;
  double shrf = 1.0;
  int rule = 2;                      ///< QR: integration of the section, 1 to 5
  int cst = 0;                       ///< 0 rectangular, 1 tubular, 2 arbitrary
  std::array<double, 2> ts{}, tt{};  ///< sizes in s and t, or outer and inner diameter, at nodes 1, 2 (ELFORM 1, 9)
  double area = 0, iss = 0, itt = 0, j = 0;
  double shear_s = 0, shear_t = 0;   ///< shear areas SAS, SAT (perpendicular to s, to t); 0: no shear deformation
  bool twists_freely = false;        ///< ITOFF = 1 of spot welds
  double volume = 0, inertia = 0;    ///< discrete beam (ELFORM 6)
  int scoor = 0;                     ///< likewise: location of its axes
  Index frame = none;                ///< likewise: CID
  double cable_area = 0, cable_offset = 0;  ///< likewise: CA, OFFSET
};
struct DiscreteSection {
  int dro = 0;  ///< 0 translational, 1 torsional
  double kd = 0, v0 = 0, cl = 0, fd = 0, cdl = 0, tdl = 0;
};

struct Section {
  UserId id = 0;
  std::string title;
  ElementKind kind = ElementKind::shell;
  ShellSection shell;
  SolidSection solid;
  BeamSection beam;
  DiscreteSection discrete;
};

/// Mass properties given by the user (*PART_INERTIA, *CONSTRAINED_NODAL_RIGID_BODY_INERTIA).
struct GivenInertia {
  Vec3 center{};                 ///< global coordinates; from NODEID where given
  NodeIndex center_node = none;
  double mass = 0;
  Mat3 inertia{};                ///< about the centre; tensor entries, in the axes of `axes`
  std::optional<Mat3> axes;      ///< columns: local axes in global components (IRCS = 1); absent: global
  Vec3 velocity{}, angular_velocity{};  ///< initial, global components
  Index velocity_frame = none;   ///< frame VTX … VRZ are given in; none = global
};

/// *HOURGLASS; blank fields hold LS-DYNA's defaults (QM 0.1, Q1 1.5, Q2 0.06, QB and QW 0.1), IHQ = 0 the default type.
struct Hourglass {
  UserId id = 0;
  std::string title;
  int type = 0;                    ///< IHQ
  double coefficient = 0;          ///< QM
  double q1 = 0, q2 = 0;           ///< bulk viscosity
  int bulk_type = 0;               ///< IBQ
  double bending = 0, warping = 0; ///< QB, QW of shells
};

/// *PART, *PART_INERTIA. Every *CONSTRAINED_NODAL_RIGID_BODY has a part of its own too (as LS-DYNA gives it one), after
/// the deck's parts, without section and material, so that loads, motions and joint stiffnesses name it by a PartIndex.
struct Part {
  UserId id = 0;
  std::string title;
  Index section = none;
  Index material = none;
  Index hourglass = none;            ///< into Model::hourglasses
  Index equation_of_state = none;    ///< into Model::equations_of_state
  Index nodal_rigid_body = none;     ///< into Model::nodal_rigid_bodies where the part is one
  std::optional<GivenInertia> inertia;
  std::optional<PartContact> contact;  ///< *PART_CONTACT
};

struct NodeSet {
  UserId id = 0;
  std::string title;
  std::vector<NodeIndex> nodes;  ///< ascending by first mention, without repeats
};
struct PartSet {
  UserId id = 0;
  std::string title;
  std::vector<PartIndex> parts;
  std::vector<double> attribute;  ///< A1 of *SET_PART_COLUMN by entry of `parts` (closure distance of stoppers); else empty
};
struct SegmentSet {
  UserId id = 0;
  std::string title;
  std::vector<std::array<NodeIndex, 4>> segments;  ///< a triangle repeats its third node
};
struct ElementSet {
  UserId id = 0;
  std::string title;
  ElementKind kind = ElementKind::shell;
  std::vector<Index> elements;
};

/// *DEFINE_COORDINATE_SYSTEM / _NODES / _VECTOR.
struct Frame {
  UserId id = 0;
  std::string title;
  Vec3 origin{};
  Mat3 axes = Mat3::identity();                ///< columns: local x, y, z in global components, at t = 0
  std::array<NodeIndex, 3> nodes{none, none, none};  ///< _NODES: origin, on the axis, in the plane
  bool moves = false;                          ///< _NODES with FLAG = 1: follows its nodes
  int axis = 1;                                ///< _NODES DIR: 1 = x, 2 = y, 3 = z along nodes 1-2
  NodeIndex carrier = none;                    ///< _VECTOR NID: the frame turns with this node
};

/// *DEFINE_VECTOR and _NODES.
struct DirectionVector {
  UserId id = 0;
  Vec3 tail{}, head{};  ///< global, or in the axes of `frame`
  std::array<NodeIndex, 2> nodes{none, none};
  Index frame = none;
};

/// *DEFINE_SD_ORIENTATION.
struct SdOrientation {
  UserId id = 0;
  int iop = 0;  ///< 0 along the vector, 1 in the plane normal to it, 2 along two moving nodes, 3 normal to them
  Vec3 vector{};
  std::array<NodeIndex, 2> nodes{none, none};
};

/// *DATABASE_CROSS_SECTION_SET, _PLANE: the force that `nodes` exert on `elements` is reported.
struct CrossSection {
  UserId id = 0;
  std::string title;
  std::vector<NodeIndex> nodes;                 ///< ascending, without repeats
  std::array<std::vector<Index>, 4> elements;   ///< by ElementKind
  Index frame = none;                           ///< axes of the report; none = global
};

struct Box {
  UserId id = 0;
  Vec3 low{}, high{};
};

}  // namespace kardan

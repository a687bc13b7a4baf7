// Contact between parts (*CONTACT_…, *PART_CONTACT, *DEFINE_FRICTION): which surfaces meet, and by which law.
//
// Words: the nodes of the *tracked* side (SURFA, formerly slave) are kept out of the segments of the *reference* side (SURFB, formerly
// master). A two-way contact does so in both directions, a single surface with itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// What a side is made of. Parts give the quadrilaterals and triangles of their shells, the free faces of their solids and their beams.
struct ContactSide {
  enum class Kind : std::uint8_t { nothing, everything, parts, segments, nodes } kind = Kind::nothing;
  std::vector<PartIndex> parts;                    ///< of `parts`: ascending; SSTYP 5, 6 (exempted) are resolved by the reader
  std::vector<std::array<NodeIndex, 4>> segments;  ///< of `segments`: the normal (right-hand rule) points to the other side
  std::vector<NodeIndex> nodes;                    ///< of `nodes`: ascending
  std::optional<std::array<Vec3, 2>> box;          ///< low and high corner: only what lies in it at t = 0
  double stiffness_scale = 1;                      ///< SFS, SFM
  double thickness = 0;                            ///< SST, MST: in place of the elements' thickness; 0 = theirs; negative = none at all
  double thickness_scale = 1;                      ///< SFST, SFMT
  bool report_nodes = false;                       ///< SPR, MPR: in NCFORC and the interface database
};

/// Coulomb friction: mu = dynamic + (statical - dynamic) exp(-decay |v|); the tangential stress stays below `shear_limit`.
struct Friction {
  double statical = 0, dynamic = 0;  ///< FS, FD
  double decay = 0;                  ///< DC, time/length
  double shear_limit = 0;            ///< VC, force/area; 0 = none
};

/// *PART_CONTACT: what a part brings into all contacts.
struct PartContact {
  Friction friction;                 ///< used where the contact asks for it (FS = -1)
  double thickness = 0;              ///< OPTT; 0 = the elements'
  double thickness_scale = 1;        ///< SFT
  double stiffness_scale = 1;        ///< SSF
};

/// *DEFINE_FRICTION: friction by pairs of parts (FS = -2).
struct FrictionTable {
  UserId id = 0;
  Friction otherwise;
  struct Row {
    std::vector<PartIndex> first, second;
    Friction friction;
  };
  std::vector<Row> rows;
};

/// How a contact holds.
enum class ContactLaw : std::uint8_t {
  penalty,     ///< springs push nodes out of segments
  tied,        ///< nodes move with the segments they begin on
  tiebreak,    ///< likewise until a criterion is met, then `penalty`
  transducer   ///< only reports what other contacts do to its side
};

/// How tied nodes are held (the suffixes of *CONTACT_TIED_…).
struct Tie {
  enum class Holding : std::uint8_t {
    constraint,          ///< node moved onto the segment, kinematic: no suffix
    offset,              ///< penalty springs across the gap, no moments: _OFFSET
    constrained_offset,  ///< kinematic across the gap, moments transferred: _CONSTRAINED_OFFSET
    beam_offset          ///< penalty springs across the gap, moments transferred: _BEAM_OFFSET
  } holding = Holding::constraint;
  bool rotations = false;            ///< rotations of the nodes too: TIED_SHELL_EDGE_TO_SURFACE, SPOTWELD
  bool torsion = false;              ///< SPOTWELD_WITH_TORSION
  double distance = 0;               ///< nodes farther than this from a segment are not tied; 0 = the default of the keyword
  int option = 0;                    ///< OPTION of TIEBREAK
  double normal_limit = 0, shear_limit = 0;        ///< NFLF, SFLF: forces; NFLS, SFLS: stresses
  double normal_exponent = 2, shear_exponent = 2;  ///< NEN, MES
  double critical_distance = 0;      ///< CCRIT (PARAM): opening at which a damaged tie has lost all its strength
};

/// *CONTACT_….
struct Contact {
  UserId id = 0;
  std::string title;
  std::string keyword;               ///< "*CONTACT_AUTOMATIC_SINGLE_SURFACE", for messages
  ContactLaw law = ContactLaw::penalty;
  bool single = false;               ///< one surface against itself: only `tracked` is given
  bool two_way = false;              ///< nodes of `reference` are kept out of segments of `tracked` too
  bool automatic = false;            ///< segments act on both sides and shells have thickness; else on the side of their normal
  bool eroding = false;              ///< faces that deletion lays bare join the surface
  bool edges = false;                ///< beams and free edges of shells meet edges (AUTOMATIC_GENERAL)
  bool rigid_curve = false;          ///< *CONTACT_RIGID_…: force from `curve`, see below
  ContactSide tracked, reference;

  Friction friction;                 ///< FS, FD, DC, VC; frictional constants scaled by FSF, VSF already
  enum class FrictionSource : std::uint8_t { own, part, table } friction_source = FrictionSource::own;
  Index friction_table = none;       ///< into Model::friction_tables
  double damping = 0;                ///< VDC as a fraction of critical damping
  double birth = 0, death = 1e20;    ///< BT, DT

  int soft = 0;                      ///< SOFT: 0 by material, 1 by mass and step, 2 likewise, segment by segment
  double soft_scale = 0.1;           ///< SOFSCL
  int depth = 2;                     ///< DEPTH, of SOFT = 2: 3 and more include edges
  int initial_penetration = 0;       ///< IGNORE: see docs/limits.md; 1 = tracked, 2 = tracked and listed
  int shell_thickness = 0;           ///< SHLTHK of non-automatic contacts: 0 none, 1 not of rigid parts, 2 all
  double largest_penetration = 0;    ///< PENMAX; 0 = default
  double solid_thickness = 0;        ///< SLDTHK: a thickness for faces of solids
  double solid_stiffness = 0;        ///< SLDSTF: E of those faces in place of the material's; 0 = material's
  double step_of_stiffness = 0;      ///< DTSTIF: dt in stiffnesses of SOFT 1 and 2; 0 = the run's

  CurveIndex curve = none;           ///< LCID of rigid contacts: force against penetration
  int curve_method = 1;              ///< FCM: 1 sum of all forces, 2 force of a node, 3 pressure
  double unload_stiffness = 0;       ///< US
  CurveIndex damping_curve = none;   ///< LCDC
  double damping_scale = 1;          ///< DSF

  Tie tie;                           ///< of `tied` and `tiebreak`
};

/// *CONTROL_CONTACT: what holds for all contacts. Defaults of single contacts (SHLTHK, IGNORE …) are in them already.
struct ContactControl {
  double stiffness_scale = 0.1;      ///< SLSFAC
  double wall_penalty = 0;           ///< RWPNAL: > 0 nodes of rigid bodies meet rigid walls by penalty, < 0 all nodes
  int penalty_option = 1;            ///< PENOPT: 1 smaller of segment and node, 2 segment, 3 node, 4, 5 as 3
  bool thickness_changes = false;    ///< THKCHG
  bool full_thickness = false;       ///< SSTHK: shells of single surfaces are as thick as they are; else at most 0.4 of their shortest edge
  bool skip_walls = false;           ///< SKIPRWG
};

}  // namespace kardan

// The surfaces that contacts, ties and transducers are made of: segments with what they lie on, and nodes.
//
// Stiffness of a segment [force/length], with the bulk modulus K = E/(3 (1 - 2 nu)) of its element's material (*MAT_RIGID too), area A:
//   K A^2/V        face of a solid of volume V
//   K A/d          shell, d its longer diagonal (the longest side of a triangle)
//   K A/l          beam of section A and length l (its nodes only)
// Source: Hallquist, LS-DYNA Theory Manual 2006, "Contact-impact algorithm", slave force.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/base/index.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// A quadrilateral or triangle of a surface, as it was at t = 0.
struct Segment {
  std::array<NodeIndex, 4> nodes{none, none, none, none};  ///< a triangle repeats its third; the normal follows the right-hand rule
  double half_thickness = 0;
  double stiffness = 0;            ///< with the side's, the part's and no other scale factor; 0 where the material has no E
  double area = 0;
  double depth = 0;                ///< half of what lies behind it: of a solid half of V/A, of a shell half its shortest side
  PartIndex part = none;
  Index element = none;            ///< into the block of `kind`; none: it lies on no element
  Index body = none;               ///< number of the connected surface it belongs to
  ElementKind kind = ElementKind::shell;
  bool one_sided = false;          ///< acts where its normal points; else on both sides, with rounded edges
};

/// A node of a surface.
struct SurfaceNode {
  NodeIndex node = none;
  PartIndex part = none;           ///< of one of its segments or elements
  double half_thickness = 0;       ///< largest of its segments, or radius of its beam
  double stiffness = 0;            ///< mean of its segments
  double area = 0;                 ///< its share of them
};

/// Which rules make a surface.
struct SurfaceRules {
  bool automatic = false;          ///< shells have thickness and two sides; else see `shell_thickness`
  int shell_thickness = 0;         ///< SHLTHK, where not automatic: 0 none, 1 not of rigid parts, 2 all
  bool limited_thickness = false;  ///< at most 0.4 of a segment's shortest side (single surfaces)
  double solid_thickness = 0;      ///< SLDTHK
  double solid_modulus = 0;        ///< SLDSTF: E of solids' faces in place of the material's
  bool eroding = false;            ///< nodes inside solids are listed, too: faces that deletion lays bare will have them
};
/// Says which elements have not been deleted.
using Alive = std::function<bool(ElementKind, Index)>;

/// Rules of a penalty contact. Ties take SurfaceRules{.automatic = true} and look at the thicknesses themselves.
SurfaceRules surface_rules(const Model& model, const Contact& contact);

class Surface {
 public:
  Surface() = default;
  /// Segments and nodes of a side at the positions state.nodes.x. A side of nodes has no segments.
  /// Warns, in the name of `contact`, of segments that lie on no element (they are left out) and of a side that is empty.
  Surface(const Model& model, const State& state, const Contact& contact, const ContactSide& side, const SurfaceRules& rules,
          Diagnostics& diagnostics);

  /// Elements have been deleted: faces of solids that are left and stand free now are added behind the segments there are. Sizes are those of t = 0.
  void expose(const Model& model, const Contact& contact, const ContactSide& side, const SurfaceRules& rules, const Alive& alive);

  /// Of a surface that expose() changes.
  void register_state(Registry& registry, const std::string& name);

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<SurfaceNode>& nodes() const { return nodes_; }  ///< ascending
  bool empty() const { return nodes_.empty(); }
  /// Position in nodes(), `none` if the node is not here.
  Index place_of(NodeIndex node) const;
  /// Segments at nodes()[place], ascending.
  std::span<const Index> segments_at(Index place) const {
    const auto p = static_cast<std::size_t>(place);
    return {segment_at_.data() + first_at_[p], segment_at_.data() + first_at_[p + 1]};
  }
  /// Beams whose nodes are here, into Model::beams, ascending.
  const std::vector<Index>& beams() const { return beams_; }

 private:
  friend class SurfaceBuilder;
  std::vector<Segment> segments_;
  std::vector<SurfaceNode> nodes_;
  std::vector<Index> first_at_, segment_at_, beams_;
};

/// Makes room for forces of single nodes of a side, as SPR and MPR ask for.
void size_nodal_report(const Surface& surface, std::size_t side, ContactReport& report);

/// Distinct nodes of a segment: 3 or 4.
inline std::size_t corners(const Segment& s) { return s.nodes[2] == s.nodes[3] ? 3 : 4; }
/// The two segments share a node.
bool adjacent(const Segment& a, const Segment& b);

}  // namespace kardan

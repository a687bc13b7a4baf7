// Which nodes are tied to which segments: the closest segment of the reference side, if the node lies over it and is near enough.
//
// Near enough, with the thicknesses t and the diagonals of the segment (Hallquist, LS-DYNA Keyword User's Manual Vol. I, *CONTACT, tied
// contacts):  distance to the mid-surface <= max(0.60 (t_node + t_segment), 0.05 min(diagonals)),  or the given distance (SAST < 0).
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/contact/segment_point.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// A node and the point of a segment where it begins.
struct TiedPoint {
  std::size_t contact = 0;         ///< into Model::contacts
  NodeIndex node = none;
  SegmentPoint foot;               ///< closest to the node at t = 0
  Vec3 arm;                        ///< from the foot to the node
  Vec3 normal;                     ///< unit, to the side of the segment where the node belongs
  Index element = none;            ///< that the segment lies on, into the block of `kind`; none: of no element
  ElementKind kind = ElementKind::shell;
  double area = 0;                 ///< the node's share of the tracked segments that face the other side; 0 where it has none
};

/// Tied nodes of contact `contact` at the positions state.nodes.x, ascending. Says in `diagnostics` how many nodes of a surface are tied,
/// which nodes of a set are not and how far they are from the surface.
std::vector<TiedPoint> find_tied_points(const Model& model, const State& state, std::size_t contact, Diagnostics& diagnostics);

/// Makes room for forces of single nodes of a tied contact, where SPR and MPR ask for them.
void size_tie_report(const Model& model, const State& state, std::size_t contact, ContactReport& report);
/// Adds a force on a tied node and its opposite, with the moment -at_foot, on its segment to the forces of single nodes.
void add_nodal_forces(const TiedPoint& point, const NodeState& nodes, const Vec3& force, const Vec3& at_foot, ContactReport& report);

/// Before the solver sees the model: ties without offset (no suffix) move their nodes onto the segments, as LS-DYNA does; a notice says
/// how far. Nodes of segments that are tied themselves are moved first.
void move_tied_nodes(Model& model, Diagnostics& diagnostics);

}  // namespace kardan

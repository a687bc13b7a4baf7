// Lumped masses of all elements.
#pragma once

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/model/model.hpp"
#include "kardan/model/properties.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// What one beam adds to each of its two nodes.
///
/// Mass: half of density times volume. Rotary inertia about every axis, m the node's share of the mass, l the length:
///   Belytschko-Schwer   m (I/A + l^2/12), I the larger second moment of area: the value that LS-DYNA's bound for the step of this
///                       element implies (beam_formulations.hpp), with which the stretch governs the step of slender elements;
///   Hughes-Liu          m (I/A + l^2/8), the l^2/8 as the shells' A/8, so that shear does not govern the step;
///   spot weld           m (I/A + l^2/4), so that the stretch alone governs the step (the bound of beam_formulations.hpp, E >= 2 k G);
///   truss               none: it does not turn its nodes;   discrete   half of INER.
/// l^2/12 and l^2/8 vanish under refinement with the square of l; about the axis, where a beam has little inertia, they make waves of
/// torsion too slow in coarse meshes. Beams of rigid parts add none.
/// DT of *MAT_SPOTWELD raises mass and inertia of welds together, until their stable step l sqrt(rho/E) is DT: `added` of the mass is that.
struct BeamLump {
  double mass = 0, inertia = 0;
  double added = 0;
};
BeamLump beam_lump(const Model& model, Index beam, double density);

/// What an element gives to each of its distinct nodes.
struct NodeShare {
  double mass = 0, inertia = 0;  ///< rotary inertia: of deformable shells, beams and quadratic solids
  int nodes = 0;                 ///< distinct ones
};
/// Of a shell, solid or beam of a part that has section and material; as add_lumped_masses() does it.
NodeShare node_share(const Model& model, ElementKind kind, Index element);

/// Adds to state.nodes.mass the lumped mass of every shell, solid, beam, *ELEMENT_MASS and *ELEMENT_INERTIA, rigid or not,
/// in equal shares to the element's distinct nodes; and to state.nodes.inertia the rotary inertia of deformable shells, beams and quadratic solids.
/// Parts that cannot have a mass (no section, no material, no thickness) become errors.
///
/// The rotary inertia of a shell node is m max(h^2/12, A/8) about every axis, m the node's share of the mass, h the thickness
/// and A the area: the second term raises it so that bending does not govern the step.
/// Source: Hughes, Cohen and Haroun 1978, Nucl. Eng. Des. 46, 203-222, as used by Hallquist, LS-DYNA Theory Manual 2006,
/// "Hughes-Liu shell" (alpha_2 = V/(8h)) and for the Belytschko-Lin-Tsay shell alike. Of quadratic solids: solid_inertia(). Elements of rigid parts get none:
/// a rigid body's inertia is that of its nodal masses.
void add_lumped_masses(const Model& model, State& state, Diagnostics& diagnostics);

}  // namespace kardan

// Lumped masses of all elements, and the part properties they are made of.
#pragma once

#include <array>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// What every law has: density [mass/length^3], Young's modulus [force/length^2], Poisson's ratio.
struct BulkProperties {
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;
};
BulkProperties bulk_properties(const Material& material);

/// Thickness of a shell at its four nodes [length]: *ELEMENT_SHELL_THICKNESS, else the section's (T2..T4 = 0 take T1).
std::array<double, 4> shell_thickness(const Model& model, Index shell);
/// Mean of the nodes' thicknesses; of the first three for a triangle.
double mean_thickness(const Model& model, Index shell);

/// Area of a beam's cross section [length^2]: the mean of both ends for the sections given by sizes (ELFORM 1, 4, 5, 9 with
/// CST 0 rectangular and 1 tubular), else A of the section.
double beam_area(const BeamSection& section);

/// Adds to state.nodes.mass the lumped mass of every shell, solid, beam, *ELEMENT_MASS and *ELEMENT_INERTIA, rigid or not,
/// in equal shares to the element's distinct nodes; and to state.nodes.inertia the rotary inertia of deformable shells.
/// Parts that cannot have a mass (no section, no material, no thickness) become errors.
///
/// The rotary inertia of a shell node is m max(h^2/12, A/8) about every axis, m the node's share of the mass, h the thickness
/// and A the area: the second term raises it so that bending does not govern the step.
/// Source: Hughes, Cohen and Haroun 1978, Nucl. Eng. Des. 46, 203-222, as used by Hallquist, LS-DYNA Theory Manual 2006,
/// "Hughes-Liu shell" (alpha_2 = V/(8h)) and for the Belytschko-Lin-Tsay shell alike. Elements of rigid parts get none:
/// a rigid body's inertia is that of its nodal masses.
void add_lumped_masses(const Model& model, State& state, Diagnostics& diagnostics);

}  // namespace kardan

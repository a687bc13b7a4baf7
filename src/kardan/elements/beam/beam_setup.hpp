// What beams are made of before the first cycle: integration points of sections, constants, axes.
#pragma once

#include <array>
#include <optional>

#include "kardan/elements/beam/beam_kernel.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// Fills points and weights of the rule QR: Gauss (1, 2, 3, 5 for 1, 2x2, 3x3, 4x4 points) or Lobatto (4 for 3x3) on a rectangle; 1, 4,
/// 9, 9, 16 points evenly on a circle for a tube.
void integration_points(const BeamSection& section, BeamProperties& properties);

/// The constants that the formulation keeps of an element of this length (beam_formulations.hpp).
std::array<double, beam_history::constants> section_constants(const BeamSection& section, const Law& law, double length);

/// Unit vector s at the start: across r, in the plane of r and the third node (or the element's vector). Without them, or where they lie
/// on the axis, any direction for a section that is the same in all, else nothing.
std::optional<Vec3> initial_axis(const Model& model, Index beam, const BeamSection& section);

}  // namespace kardan

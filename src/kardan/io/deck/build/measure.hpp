// Sizes and masses of elements and parts as the deck gives them, for reports and for mass spread over parts.
#pragma once

#include <string>
#include <vector>

#include "kardan/model/model.hpp"

namespace kardan::deck {

/// Area of a shell (half the cross product of the diagonals), volume of a solid (divided into tetrahedra; degenerate
/// forms included), length of a beam.
double shell_area(const Model& model, Index element);
double solid_volume(const Model& model, Index element);
double beam_length(const Model& model, Index element);

/// Density of a material; 0 for springs, dampers and `none`.
double density(const Model& model, Index material);

/// Mass of each part from its elements' volumes and its material's density, *ELEMENT_MASS with its PID included;
/// PART_INERTIA is not looked at.
std::vector<double> meshed_masses(const Model& model);

/// Adds point masses to the nodes of `parts`: `added` in total or up to `final_mass` (the one that is not 0). Weighted:
/// in proportion to the lumped element masses; else to the number of elements at a node. Returns what is wrong, or "".
std::string distribute_mass(Model& model, const std::vector<PartIndex>& parts, double added, double final_mass,
                            bool weighted);

}  // namespace kardan::deck

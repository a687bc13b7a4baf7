// Properties of parts and thicknesses of shells.
#pragma once

#include <array>

#include "kardan/model/model.hpp"

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

}  // namespace kardan

// From the materials of the model to the laws of the shell kernel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/elements/shell/shell_kernel.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

/// Whether there is a law for shells of this part's material; complains about the material or its parameters.
bool check_shell_law(const Model& model, const Part& part, Diagnostics& diagnostics);

/// The law of a material that check_shell_law() has passed, with the shear correction factor; `table` receives what the law points
/// into and must outlive it.
ShellLaw shell_law(const Model& model, const Material& material, double shear_factor, std::vector<double>& table);

/// Values a point of this law keeps, and their values at the start (the five stresses 0).
std::vector<double> point_start(const ShellLaw& law);

}  // namespace kardan

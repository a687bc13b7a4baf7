// From the hardening a deck gives to the table of the kernels (hardening.hpp).
#pragma once

#include <string>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/materials/hardening.hpp"
#include "kardan/model/curve.hpp"
#include "kardan/model/materials.hpp"

namespace kardan {

/// The pieces of a law, [row][hardening_columns]; their number is a power of two, rows past the last one begin at infinity. The
/// first and the last piece go on beyond the points, as LS-DYNA extrapolates the curves of materials.
std::vector<double> hardening_table(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves);

/// Complains about hardening the return mapping cannot be computed with: a yield stress that is not positive, that falls, or that
/// rises ever more steeply by more than E/4 from one piece to the next (Newton's method could cycle there). `name` says which
/// material it is.
void check_hardening(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves, const std::string& name,
                     Diagnostics& diagnostics);

}  // namespace kardan

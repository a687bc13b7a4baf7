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
/// first and the last piece go on beyond the points, as LS-DYNA extrapolates the curves of materials; but where the last piece falls, the
/// last value holds.
std::vector<double> hardening_table(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves);
/// The same of one curve.
std::vector<double> hardening_table(const Curve& curve);
/// A factor over the rate, constant outside the curve.
std::vector<double> rate_table(const Curve& curve);

/// The curves of a table of *DEFINE_TABLE: rows of all of them, of the same number, and the rates.
struct YieldFamilyTable {
  std::vector<double> rows, rates;
  std::size_t row_count = 0, curve_count = 0;
  bool logarithmic = false;  ///< the first rate is negative: they are natural logarithms
};
YieldFamilyTable yield_family_table(const std::vector<std::vector<double>>& curves, std::vector<double> rates);

/// Whether the fast return mapping converges: the yield stress neither falls nor rises ever more steeply by more than E/4 from one piece
/// to the next (Newton's method could cycle there).
bool hardens_smoothly(const std::vector<double>& table, double youngs_modulus);
/// Complains about a yield stress that is not positive at the start or negative later; `name` says which material it is.
void check_hardening(const std::vector<double>& table, const std::string& name, Diagnostics& diagnostics);

}  // namespace kardan

#include "kardan/materials/hardening_table.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace kardan {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Points {
  std::vector<double> strain, stress;
};

Points points_of(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves) {
  if (law.curve != none) return {curves[law.curve].x, curves[law.curve].y};
  if (law.points > 0) return {{law.strain.begin(), law.strain.begin() + law.points}, {law.stress.begin(), law.stress.begin() + law.points}};
  const double hardening = law.youngs_modulus * law.tangent_modulus / (law.youngs_modulus - law.tangent_modulus);
  return {{0, 1}, {law.yield_stress, law.yield_stress + hardening}};
}

/// Rows past the last one, up to a power of two.
void fill_up(std::vector<double>& rows, std::size_t count) {
  while (rows.size() < count * hardening_columns) rows.insert(rows.end(), {infinity, 0, 0, infinity});
}

std::vector<double> table_of(Points p) {
  if (p.strain.size() == 1) {  // one point: a constant
    p.strain.push_back(p.strain[0] + 1);
    p.stress.push_back(p.stress[0]);
  } else if (p.stress.back() < p.stress[p.stress.size() - 2]) {
    p.strain.push_back(p.strain.back() + 1);
    p.stress.push_back(p.stress.back());
  }
  const std::size_t pieces = p.strain.size() - 1;
  std::vector<double> rows;
  rows.reserve(std::bit_ceil(pieces) * hardening_columns);
  for (std::size_t i = 0; i < pieces; ++i) {
    const double slope = (p.stress[i + 1] - p.stress[i]) / (p.strain[i + 1] - p.strain[i]);
    rows.insert(rows.end(), {p.strain[i], p.stress[i], slope, i + 1 < pieces ? p.strain[i + 1] : infinity});
  }
  fill_up(rows, std::bit_ceil(pieces));
  return rows;
}

}  // namespace

std::vector<double> hardening_table(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves) {
  return table_of(points_of(law, curves));
}

std::vector<double> hardening_table(const Curve& curve) { return table_of({curve.x, curve.y}); }

std::vector<double> rate_table(const Curve& curve) {
  std::vector<double> rows{std::min(0.0, curve.x.front() - 1), curve.y.front(), 0, curve.x.front()};
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
    rows.insert(rows.end(), {curve.x[i], curve.y[i], curve.slope(0.5 * (curve.x[i] + curve.x[i + 1])), curve.x[i + 1]});
  }
  rows.insert(rows.end(), {curve.x.back(), curve.y.back(), 0, infinity});
  fill_up(rows, std::bit_ceil(rows.size() / hardening_columns));
  return rows;
}

YieldFamilyTable yield_family_table(const std::vector<std::vector<double>>& curves, std::vector<double> rates) {
  YieldFamilyTable family;
  family.curve_count = curves.size();
  family.logarithmic = !rates.empty() && rates[0] < 0;
  for (const std::vector<double>& rows : curves) family.row_count = std::max(family.row_count, rows.size() / hardening_columns);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    family.rows.insert(family.rows.end(), curves[c].begin(), curves[c].end());
    fill_up(family.rows, (c + 1) * family.row_count);
  }
  rates.resize(std::bit_ceil(curves.size()), infinity);
  family.rates = std::move(rates);
  return family;
}

bool hardens_smoothly(const std::vector<double>& rows, double youngs_modulus) {
  double before = infinity;
  for (std::size_t r = 0; r < rows.size() && rows[r] < infinity; r += hardening_columns) {
    if (rows[r + 2] < 0 || rows[r + 2] - before > 0.25 * youngs_modulus) return false;
    before = rows[r + 2];
  }
  return true;
}

void check_hardening(const std::vector<double>& rows, const std::string& name, Diagnostics& diagnostics) {
  for (std::size_t r = 0; r < rows.size() && rows[r] < infinity; r += hardening_columns) {
    const double stress = r == 0 ? rows[1] - rows[2] * std::max(rows[0], 0.0) : rows[r + 1];
    if (r == 0 ? stress > 0 : stress >= 0) continue;
    diagnostics.error(name + " has the yield stress " + std::to_string(stress) + " at the plastic strain " + std::to_string(rows[r]),
                      "give a positive yield stress", "*MAT_PIECEWISE_LINEAR_PLASTICITY");
    return;
  }
}

}  // namespace kardan

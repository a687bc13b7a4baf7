#include "kardan/materials/hardening_table.hpp"

#include <bit>
#include <limits>

namespace kardan {

namespace {

struct Points {
  std::vector<double> strain, stress;
};

Points points_of(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves) {
  if (law.curve != none) return {curves[law.curve].x, curves[law.curve].y};
  if (law.points > 0) return {{law.strain.begin(), law.strain.begin() + law.points}, {law.stress.begin(), law.stress.begin() + law.points}};
  const double hardening = law.youngs_modulus * law.tangent_modulus / (law.youngs_modulus - law.tangent_modulus);
  return {{0, 1}, {law.yield_stress, law.yield_stress + hardening}};
}

double slope(const Points& p, std::size_t i) {
  return (p.stress[i + 1] - p.stress[i]) / (p.strain[i + 1] - p.strain[i]);
}

std::size_t pieces(const Points& p) { return p.strain.size() - 1; }

}  // namespace

std::vector<double> hardening_table(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Points p = points_of(law, curves);
  if (p.strain.size() == 1) {  // one point: a constant
    p.strain.push_back(p.strain[0] + 1);
    p.stress.push_back(p.stress[0]);
  }
  std::vector<double> rows;
  rows.reserve(std::bit_ceil(pieces(p)) * hardening_columns);
  for (std::size_t i = 0; i < pieces(p); ++i) {
    rows.insert(rows.end(), {p.strain[i], p.stress[i], slope(p, i), i + 1 < pieces(p) ? p.strain[i + 1] : infinity});
  }
  for (std::size_t i = pieces(p); i < std::bit_ceil(pieces(p)); ++i) rows.insert(rows.end(), {infinity, 0, 0, infinity});
  return rows;
}

void check_hardening(const PiecewisePlasticMaterial& law, const std::vector<Curve>& curves, const std::string& name,
                     Diagnostics& diagnostics) {
  const char* keyword = "*MAT_PIECEWISE_LINEAR_PLASTICITY";
  if (law.curve == none && law.points == 0 && !(law.tangent_modulus >= 0 && law.tangent_modulus < law.youngs_modulus)) {
    diagnostics.error(name + " has a tangent modulus ETAN that is not between 0 and E", "give 0 <= ETAN < E", keyword);
    return;
  }
  const std::vector<double> rows = hardening_table(law, curves);
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < rows.size() && rows[r] < std::numeric_limits<double>::infinity(); r += hardening_columns) {
    const std::string where = " at the plastic strain " + std::to_string(rows[r]);
    const double initial = r == 0 && rows[0] > 0 ? rows[1] - rows[2] * rows[0] : rows[r + 1];
    if (!(initial > 0)) {
      diagnostics.error(name + " has the yield stress " + std::to_string(initial) + where, "give a positive yield stress", keyword);
      return;
    }
    if (rows[r + 2] < 0) {
      diagnostics.error(name + " has a yield stress that falls" + where + "; this version does not compute softening",
                        "let the yield stress over plastic strain rise or stay", keyword);
      return;
    }
    if (rows[r + 2] - before > 0.25 * law.youngs_modulus) {
      diagnostics.error(name + " has a yield stress that steepens by more than E/4" + where,
                        "give yield stress over plastic (not total) strain, without steps upwards", keyword);
      return;
    }
    before = rows[r + 2];
  }
}

}  // namespace kardan

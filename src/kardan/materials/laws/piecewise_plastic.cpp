#include "kardan/materials/laws/piecewise_plastic.hpp"

#include <algorithm>

#include "kardan/materials/hardening_table.hpp"
#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<PiecewisePlastic> PiecewisePlastic::make(LawSource& source) {
  const auto& m = std::get<PiecewisePlasticMaterial>(source.material.law);
  if (!check_piecewise(source)) return std::nullopt;
  PiecewisePlastic law;
  law.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  law.rate_law = CowperSymonds::from(m.rate_constant, m.rate_exponent);
  law.hardening = HardeningCurve(source.keep(hardening_table(m, source.model.curves)));
  return law;
}

bool PiecewisePlastic::computes(const PiecewisePlasticMaterial& m, const std::vector<Curve>& curves) {
  const bool plain = m.table == none && m.rate_curve == none && m.formulation == 0 && !(m.failure_strain > 0) && !(m.smallest_step > 0) &&
                     !(m.thinning > 0) && !(m.major_strain > 0);
  return plain && hardens_smoothly(hardening_table(m, curves), m.youngs_modulus);
}

bool check_piecewise(LawSource& source) {
  const auto& m = std::get<PiecewisePlasticMaterial>(source.material.law);
  const std::size_t errors = source.diagnostics.error_count();
  if (!check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) return false;
  if (m.table != none) {
    const Table& table = source.model.tables[static_cast<std::size_t>(m.table)];
    if (table.curve.empty()) source.diagnostics.error(source.name + " has a table without curves", "give the table curves", "*DEFINE_TABLE");
    for (const CurveIndex c : table.curve) check_hardening(hardening_table(source.model.curves[c]), source.name, source.diagnostics);
    if (std::adjacent_find(table.parameter.begin(), table.parameter.end()) != table.parameter.end()) {
      source.diagnostics.error(source.name + " has a table with two curves for one strain rate", "give every curve a rate of its own",
                               "*MAT_PIECEWISE_LINEAR_PLASTICITY");
    }
  } else if (m.curve == none && m.points == 0 && !(m.tangent_modulus >= 0 && m.tangent_modulus < m.youngs_modulus)) {
    source.diagnostics.error(source.name + " has a tangent modulus ETAN that is not between 0 and E", "give 0 <= ETAN < E",
                             "*MAT_PIECEWISE_LINEAR_PLASTICITY");
  } else {
    check_hardening(hardening_table(m, source.model.curves), source.name, source.diagnostics);
  }
  return source.diagnostics.error_count() == errors;
}

}  // namespace kardan

#include "kardan/materials/laws/piecewise_plastic.hpp"

#include "kardan/materials/hardening_table.hpp"
#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<PiecewisePlastic> PiecewisePlastic::make(LawSource& source) {
  const auto& m = std::get<PiecewisePlasticMaterial>(source.material.law);
  const std::size_t errors = source.diagnostics.error_count();
  if (check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) {
    check_hardening(m, source.model.curves, source.name, source.diagnostics);
  }
  if (source.diagnostics.error_count() != errors) return std::nullopt;
  PiecewisePlastic law;
  law.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  law.rate_law = CowperSymonds::from(m.rate_constant, m.rate_exponent);
  law.hardening = HardeningCurve(source.keep(hardening_table(m, source.model.curves)));
  return law;
}

}  // namespace kardan

#include "kardan/materials/laws/plastic_kinematic.hpp"

#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<PlasticKinematic> PlasticKinematic::make(LawSource& source) {
  const auto& m = std::get<FieldMaterial>(source.material.law);
  const double e = m.youngs_modulus, tangent = m.value("etan"), beta = m.value("beta");
  if (!check_elastic_constants(source, m.density, e, m.poissons_ratio)) return std::nullopt;
  const std::size_t errors = source.diagnostics.error_count();
  const auto complain = [&](const char* what, const char* cure) {
    source.diagnostics.error(source.name + " " + what, cure, "*MAT_PLASTIC_KINEMATIC");
  };
  if (!(m.value("sigy") > 0)) complain("has no yield stress", "give SIGY > 0");
  if (!(tangent >= 0 && tangent < e)) complain("has a tangent modulus that is not between 0 and E", "give 0 <= ETAN < E");
  if (!(beta >= 0 && beta <= 1)) complain("has a hardening parameter outside [0, 1]", "give BETA from 0 (kinematic) to 1 (isotropic)");
  if (const double vp = m.value("vp"); vp != 0 && vp != 1) complain("has a rate formulation VP that is neither 0 nor 1", "set VP = 0 or 1");
  if (source.diagnostics.error_count() != errors) return std::nullopt;
  PlasticKinematic law;
  law.elastic = Elastic::from(e, m.poissons_ratio);
  law.yield_stress = m.value("sigy");
  const double plastic_modulus = e * tangent / (e - tangent);
  law.isotropic = beta * plastic_modulus;
  law.kinematic = (1 - beta) * plastic_modulus;
  law.rate_law = CowperSymonds::from(m.value("src"), m.value("srp"));
  law.viscoplastic = m.value("vp") == 1 && law.rate_law.active();
  const double fs = m.value("fs");
  law.failure_strain = fs < 1e20 ? fs : 0;
  return law;
}

}  // namespace kardan

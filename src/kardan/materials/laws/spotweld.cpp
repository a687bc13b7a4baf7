#include "kardan/materials/laws/spotweld.hpp"

#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<Spotweld> Spotweld::make(LawSource& source) {
  const auto& m = std::get<FieldMaterial>(source.material.law);
  if (!check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) return std::nullopt;
  const std::size_t errors = source.diagnostics.error_count();
  const auto complain = [&](const char* what, const char* cure) {
    source.diagnostics.error(source.name + " " + what, cure, "*MAT_SPOTWELD");
  };
  if (!(m.value("sigy") > 0)) complain("has no yield stress", "give SIGY > 0");
  if (m.value("eh") < 0) complain("has a negative plastic modulus", "give EH >= 0");
  if (m.value("efail") < 0) complain("has EFAIL < 0, which this version does not compute", "give EFAIL >= 0");
  if (m.value("nf") != 0) complain("asks for forces filtered over NF cycles, which this version does not do", "set NF = 0");
  for (const char* limit : {"nrr", "nrs", "nrt", "mrr", "mss", "mtt"}) {
    if (m.value(limit) < 0) complain("has a failure force or moment by a curve of the strain rate (negative)", "give a positive number");
  }
  if (source.use == LawUse::solid) {
    for (const char* limit : {"nrr", "nrs", "nrt", "mrr", "mss", "mtt"}) {
      if (m.value(limit) > 0 && m.value(limit) < 1e20)
        complain("has a failure force or moment, which this version computes for beams only", "use EFAIL or TFAIL for solids, or beams of ELFORM 9");
    }
    if (m.value("dt") > 0) complain("asks for mass scaling by DT, which this version does for beams only", "use DT2MS of *CONTROL_TIMESTEP for solids");
  }
  if (source.diagnostics.error_count() != errors) return std::nullopt;
  Spotweld law;
  law.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  law.yield_stress = m.value("sigy");
  law.isotropic = m.value("eh");
  law.failure_strain = m.value("efail") < 1e20 ? m.value("efail") : 0;
  if (source.use == LawUse::solid) law.failure_time = m.value("tfail") < 1e20 ? m.value("tfail") : 0;
  return law;
}

}  // namespace kardan

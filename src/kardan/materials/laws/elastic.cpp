#include "kardan/materials/laws/elastic.hpp"

#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<Elastic> Elastic::make(LawSource& source) {
  const auto& m = std::get<ElasticMaterial>(source.material.law);
  if (!check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) return std::nullopt;
  return from(m.youngs_modulus, m.poissons_ratio);
}

}  // namespace kardan

#include "kardan/materials/laws/ogden.hpp"

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

std::optional<Ogden> Ogden::make(LawSource& source) {
  LawFields m(source);
  check_rubber(m);
  m.refuse("n", "constants fitted to a test (N > 0)", "set N = 0 and give MU and ALPHA, or use *MAT_HYPERELASTIC_RUBBER");
  if (!m.good()) return std::nullopt;
  Ogden law;
  for (std::size_t j = 1; j <= most; ++j) {
    const double mu = m["mu" + std::to_string(j)], alpha = m["alpha" + std::to_string(j)];
    if (mu == 0 || alpha == 0) continue;
    m.need(mu * alpha > 0 && alpha >= -20 && alpha <= 20, "has a term " + std::to_string(j) + " with MU ALPHA < 0 or |ALPHA| > 20",
           "give MU and ALPHA of one sign, |ALPHA| <= 20");
    law.mu[law.terms] = mu;
    law.alpha[law.terms++] = alpha;
  }
  m.need(law.terms > 0, "has no term", "give MU1 and ALPHA1");
  law.prony = prony_series(m);
  if (!m.good()) return std::nullopt;
  law.bulk = bulk_modulus(law.elastic_shear(), m["pr"]);
  return law;
}

}  // namespace kardan

#include "kardan/materials/laws/ogden.hpp"

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

std::optional<Ogden> Ogden::make(LawSource& source) {
  LawFields m(source);
  check_rubber(m);
  if (!m.good()) return std::nullopt;
  Ogden law;
  if (const double n = m["n"]; n > 0) {
    m.refuse("lcid2", "relaxation fitted to a curve (LCID2)", "give the terms G, BETA");
    const int data = static_cast<int>(m["data"] == 0 ? 1 : m["data"]);
    m.need(n <= most && data >= 1 && data <= 3, "has N beyond 8 or DATA outside 1 to 3", "give N = 1 to 8 and DATA = 1, 2 or 3");
    if (!m.good()) return std::nullopt;
    for (const OgdenTerm& term : fit_ogden(m, "lcid1", static_cast<RubberTest>(data), static_cast<std::size_t>(n))) {
      law.mu[law.terms] = term.mu;
      law.alpha[law.terms++] = term.alpha;
    }
    if (!m.good()) return std::nullopt;
  }
  for (std::size_t j = 1; j <= most && law.terms < most; ++j) {
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

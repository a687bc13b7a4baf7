#include "kardan/materials/laws/mooney_rivlin.hpp"

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

std::optional<MooneyRivlin> MooneyRivlin::make(LawSource& source) {
  LawFields m(source);
  const double nu = m["pr"];
  m.need(nu > 0 && nu < 0.5, "has a Poisson's ratio that is not between 0 and 0.5", "give 0 < PR < 0.5, 0.49 and more for rubber");
  double a = m["a"], b = m["b"];
  if (a == 0 && b == 0) {
    const std::vector<double> fitted = fit_invariants(m, "lcid", {}, {{1, 0}, {0, 1}});
    if (fitted.empty()) return std::nullopt;
    a = fitted[0];
    b = fitted[1];
  }
  m.need(a + b > 0, "has A + B that is not positive", "give constants, or a test, with a positive shear modulus 2 (A + B)");
  if (!m.good()) return std::nullopt;
  return from(a, b, nu);
}

}  // namespace kardan

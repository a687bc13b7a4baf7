#include "kardan/materials/laws/hyperelastic_rubber.hpp"

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

std::optional<HyperelasticRubber> HyperelasticRubber::make(LawSource& source) {
  LawFields m(source);
  check_rubber(m);
  HyperelasticRubber law;
  double* const constant[] = {&law.c10, &law.c01, &law.c11, &law.c20, &law.c02, &law.c30};
  const int n = static_cast<int>(m["n"]);
  if (n == 0) {
    m.refuse("therml", "thermal expansion (THERML)", "set THERML = 0");
    const char* const name[] = {"c10", "c01", "c11", "c20", "c02", "c30"};
    for (std::size_t i = 0; i < 6; ++i) *constant[i] = m[name[i]];
  } else {
    m.refuse("lcid2", "relaxation fitted to a curve (LCID2)", "give the terms G, BETA");
    const int data = static_cast<int>(m["data"] == 0 ? 1 : m["data"]);
    m.need(n >= 1 && n <= 3 && data >= 1 && data <= 3, "has N or DATA outside 1 to 3", "give N = 1, 2 or 3 and DATA = 1, 2 or 3");
    if (!m.good()) return std::nullopt;
    const std::vector<Monomial> all{{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {3, 0}};
    const std::size_t count = n == 1 ? 2 : (n == 2 ? 5 : 6);
    const std::vector<double> fitted =
        fit_invariants(m, "lcid1", {static_cast<RubberTest>(data)}, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)});
    for (std::size_t i = 0; i < fitted.size(); ++i) *constant[i] = fitted[i];
  }
  law.prony = prony_series(m);
  const double shear = 2 * (law.c10 + law.c01);
  m.need(shear > 0, "has C10 + C01 that is not positive", "give constants, or a test, with a positive shear modulus");
  if (!m.good()) return std::nullopt;
  law.bulk = bulk_modulus(shear, m["pr"]);
  return law;
}

}  // namespace kardan

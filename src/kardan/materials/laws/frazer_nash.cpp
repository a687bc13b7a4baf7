#include "kardan/materials/laws/frazer_nash.hpp"

#include "kardan/materials/rubber_data.hpp"

namespace kardan {

std::optional<FrazerNash> FrazerNash::make(LawSource& source) {
  LawFields m(source);
  const double nu = m["pr"];
  m.need(nu > 0 && nu < 0.5, "has a Poisson's ratio that is not between 0 and 0.5", "give 0 < PR < 0.5, 0.49 and more for rubber");
  FrazerNash law;
  struct Term {
    const char* name;
    double* value;
    Monomial power;
  };
  const Term terms[] = {{"c100", &law.c100, {1, 0}}, {"c200", &law.c200, {2, 0}}, {"c300", &law.c300, {3, 0}}, {"c400", &law.c400, {4, 0}},
                        {"c110", &law.c110, {1, 1}}, {"c210", &law.c210, {2, 1}}, {"c010", &law.c010, {0, 1}}, {"c020", &law.c020, {0, 2}}};
  if (m.curve("lcid") == nullptr) {
    for (const Term& t : terms) *t.value = m[t.name];
  } else {  // then constants other than zero name the terms of the fit
    std::vector<Monomial> powers;
    std::vector<double*> wanted;
    for (const Term& t : terms) {
      if (m[t.name] == 0) continue;
      powers.push_back(t.power);
      wanted.push_back(t.value);
    }
    if (!m.need(!powers.empty(), "has a test but no term to fit to it", "set the constants that are to be fitted to 1")) return std::nullopt;
    const std::vector<double> fitted = fit_invariants(m, "lcid", {RubberTest::uniaxial, RubberInvariants::green_strain}, powers);
    for (std::size_t i = 0; i < fitted.size(); ++i) *wanted[i] = fitted[i];
  }
  if (!m.good()) return std::nullopt;
  m.need(law.shear() > 0, "has C100 - C010/2 that is not positive", "give constants, or a test, with a positive shear modulus");
  if (!m.good()) return std::nullopt;
  if (m["exit"] == 0 && (m["emax"] != 0 || m["emin"] != 0))
    m.warn("is to stop the run at the strains EMAX and EMIN (EXIT = 0), which are not watched: it goes on", "set EXIT = 1");
  law.bulk = bulk_modulus(law.shear(), nu);
  return law;
}

}  // namespace kardan

#include "kardan/materials/laws/power_plastic.hpp"

#include <cmath>

#include "kardan/materials/law.hpp"

namespace kardan {

namespace {

constexpr double written_for_none = 1e15;  ///< programs write 1e17 or 1e28 where no limit is meant

void complain(LawSource& source, const FieldMaterial& m, const std::string& what, const char* cure) {
  source.diagnostics.error(source.name + " " + what, cure, m.keyword);
}

bool viscoplastic(LawSource& source, const FieldMaterial& m) {
  if (const double vp = m.value("vp"); vp != 0 && vp != 1) complain(source, m, "has a rate formulation VP that is neither 0 nor 1", "set VP = 0 or 1");
  return m.value("vp") == 1;
}

double limit(double value) { return value > 0 && value < written_for_none ? value : PowerYield::unlimited; }

std::optional<PowerPlastic> isotropic(LawSource& source, const FieldMaterial& m) {
  const double shear = m.value("g"), bulk = m.value("bulk"), tangent = m.value("etan");
  const double e = 9 * bulk * shear / (3 * bulk + shear), nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  if (!check_elastic_constants(source, m.density, e, nu)) return std::nullopt;
  if (!(m.value("sigy") > 0)) complain(source, m, "has no yield stress", "give SIGY > 0");
  if (!(tangent >= 0 && tangent < e)) complain(source, m, "has a tangent modulus that is not between 0 and E", "give 0 <= ETAN < E");
  PowerPlastic law;
  law.elastic = {bulk - 2 * shear / 3, 2 * shear};
  law.yield.a = m.value("sigy");
  law.yield.b = e * tangent / (e - tangent);
  return law;
}

std::optional<PowerPlastic> power_law(LawSource& source, const FieldMaterial& m) {
  const double e = m.youngs_modulus, k = m.value("k"), n = m.value("n"), yield = m.value("sigy");
  if (!check_elastic_constants(source, m.density, e, m.poissons_ratio)) return std::nullopt;
  PowerPlastic law;
  law.elastic = Elastic::from(e, m.poissons_ratio);
  law.yield.viscoplastic = viscoplastic(source, m);
  law.yield.rate_factor.cowper_symonds = CowperSymonds::from(m.value("src"), m.value("srp"));
  if (law.yield.rate_factor.cowper_symonds.active()) law.yield.rate_factor.form = RateFactor::Form::cowper_symonds;
  law.yield.failure_strain = m.value("epsf") < written_for_none ? m.value("epsf") : 0;
  law.yield.b = k;
  law.yield.n = n;
  if (!(k > 0 && n > 0 && n < 1.5)) {
    complain(source, m, "has a power law that is not computed", "give K > 0 and 0 < N < 1.5");
  } else if (yield == 0 && !(n < 1 && k < e)) {
    complain(source, m, "has no point where the power law leaves the elastic line", "give SIGY, or N < 1 and K < E");
  } else {
    // SIGY up to 0.02 is the strain at yield, above it the stress (manual); without it the two curves meet at e_y.
    law.yield.offset = yield == 0 ? std::pow(e / k, 1 / (n - 1)) : yield <= 0.02 ? yield : std::pow(yield / k, 1 / n);
  }
  return law;
}

std::optional<PowerPlastic> simplified_johnson_cook(LawSource& source, const FieldMaterial& m) {
  if (!check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) return std::nullopt;
  PowerPlastic law;
  law.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  law.yield = johnson_cook_yield(source, m);
  if (!law.yield.viscoplastic) law.yield.max_static = limit(m.value("sigmax"));  // not used where VP = 1 (manual)
  law.yield.saturation = limit(m.value("sigsat"));
  law.yield.failure_strain = m.value("psfail") < written_for_none ? m.value("psfail") : 0;
  return law;
}

}  // namespace

PowerYield johnson_cook_yield(LawSource& source, const FieldMaterial& m) {
  PowerYield y;
  y.a = m.value("a");
  y.b = m.value("b");
  y.n = m.value_or("n", 1);
  y.viscoplastic = viscoplastic(source, m);
  y.effective_rate = true;
  y.rate_factor.c = m.value("c");
  y.rate_factor.reference = m.value_or("epso", 1);
  if (y.rate_factor.c != 0) y.rate_factor.form = RateFactor::Form::logarithm;
  if (!(y.a > 0 && y.b >= 0 && y.n > 0 && y.n < 1.5))
    complain(source, m, "has a yield stress that is not computed", "give A > 0, B >= 0 and 0 < N < 1.5");
  if (!(y.rate_factor.c >= 0 && y.rate_factor.reference > 0)) complain(source, m, "has a rate effect that is not computed", "give C >= 0 and EPSO > 0");
  return y;
}

template <>
std::optional<PowerPlastic> PowerPlastic::make(LawSource& source) {
  const auto& m = std::get<FieldMaterial>(source.material.law);
  const std::size_t errors = source.diagnostics.error_count();
  const auto law = m.number == 12 ? isotropic(source, m) : m.number == 18 ? power_law(source, m) : simplified_johnson_cook(source, m);
  return source.diagnostics.error_count() == errors ? law : std::nullopt;
}

}  // namespace kardan

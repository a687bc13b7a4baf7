#include "kardan/materials/laws/johnson_cook.hpp"

#include <cmath>
#include <functional>

#include "kardan/materials/law.hpp"

namespace kardan {

namespace {

using Complain = std::function<void(const char* what, const char* cure)>;

/// RATEOP.
void set_rate(PowerYield& y, const FieldMaterial& m, const Complain& complain) {
  const double form = m.value("rateop");
  if (form == 0 || !y.viscoplastic) return;  // without VP = 1 RATEOP has no effect (manual)
  y.rate_factor.c2 = m.value("c2_p_xnp_d");
  if (form == 1)
    y.rate_factor.form = RateFactor::Form::quadratic;
  else if (form == 2)
    y.rate_factor.form = RateFactor::Form::power;
  else
    complain("asks for a form of the strain rate RATEOP that this version does not compute", "set RATEOP = 0, 1 or 2");
}

void set_heat(HeatedYield& y, const FieldMaterial& m, const Complain& complain) {
  y.room = m.value("tr");
  if (!(m.value("cp") > 0)) return;
  y.heat = 1 / (m.density * m.value("cp"));
  y.m = m.value("m");
  y.per_span = 1 / (m.value("tm") - y.room);
  if (!(y.m > 0 && m.value("tm") > y.room))
    complain("is heated by its plastic work (CP) but has no softening by temperature", "give M > 0 and TM > TR, or CP = 0 (no heating)");
}

void set_damage(HeatedYield& y, const FieldMaterial& m, LawSource& source) {
  y.d1 = m.value("d1_beta");
  y.d2 = m.value("d2_wc");
  y.d3 = m.value("d3_dc");
  y.d4 = m.value("d4_gamma");
  y.d5 = m.value("d5");
  y.damages = y.d1 != 0 || y.d2 != 0;
  y.least_strain = m.value_or("efmin", 1e-6);
  if (y.damages && y.d2 > 0 && y.d3 > 0) {
    source.diagnostics.warning(source.name + " has D3 > 0: its fracture strain grows with tension; D3 is that of Johnson and Cook, who count tension positive",
                               "give D3 < 0 if tension is to break it", m.keyword);
  }
}

void set_spall(JohnsonCook& law, const FieldMaterial& m, const Complain& complain) {
  law.keeps = m.value("erod") != 0;
  law.tension = std::fabs(m.value("pc"));
  if (law.tension == 0) return;
  const double model = m.value_or("spall", 2);
  if (model != 1 && model != 2 && model != 3) complain("has a spall model that is not 1, 2 or 3", "give SPALL = 1, 2 or 3, or PC = 0 (no spall)");
  law.spall = model == 1 ? Spall::cut_off : model == 2 ? Spall::principal_stress : Spall::mean_stress;
}

/// Elastic constants: E and PR; with an equation of state, whose bulk modulus counts, only G, which may be that of E and PR.
void set_elastic(JohnsonCook& law, const FieldMaterial& m, LawSource& source, const Complain& complain) {
  if (source.use == LawUse::solid && source.equation_of_state() != nullptr) {
    const double shear = m.value_or("g", 0.5 * m.youngs_modulus / (1 + m.poissons_ratio));
    if (!(m.density > 0 && shear > 0)) return complain("has no density or no shear modulus", "give RO > 0 and G > 0");
    const std::optional<PressureLaw> equation = PressureLaw::make(source);
    if (!equation) return;
    law.equation = *equation;
    law.has_equation = true;
    law.flow.elastic.two_mu = 2 * shear;
    law.flow.elastic.lambda = equation->initial_bulk() - 2.0 / 3.0 * shear;
    return;
  }
  if (m.youngs_modulus == 0)
    return complain("has no E: its pressure would need an equation of state", "give E and PR, or, for solids, EOSID of the part");
  if (!check_elastic_constants(source, m.density, m.youngs_modulus, m.poissons_ratio)) return;
  law.flow.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  const double shear = m.value_or("g", law.flow.elastic.shear());
  if (std::fabs(shear / law.flow.elastic.shear() - 1) > 0.02) complain("has a G that is not that of E and PR", "give G = E/(2 (1 + PR))");
}

}  // namespace

std::optional<JohnsonCook> JohnsonCook::make(LawSource& source) {
  const auto& m = std::get<FieldMaterial>(source.material.law);
  const std::size_t errors = source.diagnostics.error_count();
  const Complain complain = [&](const char* what, const char* cure) { source.diagnostics.error(source.name + " " + what, cure, m.keyword); };
  JohnsonCook law;
  set_elastic(law, m, source, complain);
  if (source.diagnostics.error_count() != errors) return std::nullopt;
  HeatedYield& y = law.flow.yield;
  y.cold = johnson_cook_yield(source, m);
  set_rate(y.cold, m, complain);
  set_heat(y, m, complain);
  set_damage(y, m, source);
  set_spall(law, m, complain);
  y.when = {m.value("numint"), m.value("dtf")};
  for (const char* field : {"k", "eps1", "dmodel"}) {
    if (m.value(field) != 0) complain("asks for a variant (K, EPS1, DMODEL) that this version does not compute", "leave K, EPS1 and DMODEL at 0");
  }
  if (source.diagnostics.error_count() != errors) return std::nullopt;
  return law;
}

}  // namespace kardan

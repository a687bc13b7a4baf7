#include "kardan/materials/laws/rate_plastic.hpp"

#include "kardan/materials/hardening_table.hpp"
#include "kardan/materials/law.hpp"
#include "kardan/materials/laws/piecewise_plastic.hpp"

namespace kardan {

namespace {

YieldFamily family_of(LawSource& source, const PiecewisePlasticMaterial& m) {
  std::vector<std::vector<double>> curves;
  std::vector<double> rates{0};
  if (m.table == none) {
    curves.push_back(hardening_table(m, source.model.curves));
  } else {
    const Table& table = source.model.tables[static_cast<std::size_t>(m.table)];
    rates = table.parameter;
    for (const CurveIndex c : table.curve) curves.push_back(hardening_table(source.model.curves[c]));
  }
  YieldFamilyTable table = yield_family_table(curves, std::move(rates));
  YieldFamily family;
  family.row_count = table.row_count;
  family.rate_count = table.rates.size();
  family.curve_count = table.curve_count;
  family.logarithmic = table.logarithmic;
  family.rows = source.keep(std::move(table.rows)).data();
  family.rates = source.keep(std::move(table.rates)).data();
  return family;
}

RateMeasure measure_of(int formulation) {
  switch (formulation) {
    case -1: return RateMeasure::deviatoric;
    case 1: return RateMeasure::plastic;
    case 3: return RateMeasure::filtered;
    default: return RateMeasure::total;
  }
}

}  // namespace

template <>
std::optional<RatePlastic> RatePlastic::make(LawSource& source) {
  const auto& m = std::get<PiecewisePlasticMaterial>(source.material.law);
  if (!check_piecewise(source)) return std::nullopt;
  RatePlastic law;
  law.elastic = Elastic::from(m.youngs_modulus, m.poissons_ratio);
  RateYield& y = law.yield;
  y.family = family_of(source, m);
  y.measure = measure_of(m.formulation);
  y.filter = m.filter;
  if (m.table == none) {
    y.rate_law = CowperSymonds::from(m.rate_constant, m.rate_exponent);
    if (m.rate_curve != none)
      y.rate_curve.curve = HardeningCurve(source.keep(rate_table(source.model.curves[static_cast<std::size_t>(m.rate_curve)])));
    if (m.formulation == 1) y.added_yield = m.yield_stress;
  }
  y.failure_strain = m.failure_strain;
  y.when = {m.failing_points, m.smallest_step};
  return law;
}

}  // namespace kardan

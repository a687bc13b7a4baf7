#include "kardan/materials/laws/low_density_foam.hpp"

#include <algorithm>
#include <cmath>

#include "kardan/materials/law_fields.hpp"

namespace kardan {

std::optional<LowDensityFoam> LowDensityFoam::make(LawSource& source) {
  LawFields m(source);
  const Curve* curve = m.curve("lcid");
  m.need(m["e"] > 0, "has no Young's modulus for tension", "give E > 0");
  m.refuse("beta", "creep in unloading (BETA)", "set BETA = 0");
  m.refuse("fail", "tearing (FAIL = 1)", "set FAIL = 0");
  m.refuse("ed", "relaxation (ED, BETA1)", "set ED = 0");
  m.need(m["hu"] >= 0 && m["hu"] <= 1, "has HU outside [0, 1]", "give HU from 0 (all dissipated) to 1 (none)");
  m.need(m["shape"] >= 1, "has SHAPE below 1, with which unloading begins infinitely steep", "give SHAPE >= 1");
  m.need(curve && curve->x.size() >= 2 && curve->x[0] >= 0 && curve->y[0] >= 0, "has no curve of compression",
         "give LCID, nominal stress over strain, both positive");
  if (!m.good()) return std::nullopt;
  if (m["damp"] != 0) source.diagnostics.warning(source.name + " is computed without DAMP; bulk viscosity damps it", "set DAMP = 0", m.fields().keyword);
  LowDensityFoam law;
  law.youngs_modulus = law.steepest = m["e"];
  law.cutoff = m["tc"] > 0 ? m["tc"] : 1e20;
  law.dissipated = 1 - m["hu"];
  law.shape = m["shape"];
  for (std::size_t i = 1; i < curve->x.size(); ++i) {
    const double slope = (curve->y[i] - curve->y[i - 1]) / (curve->x[i] - curve->x[i - 1]);
    if (curve->x[i - 1] < 1) law.steepest = std::max(law.steepest, std::pow(1 - curve->x[i - 1], 2) * slope);
  }
  law.curve = CurveTable::from(source.keep(CurveTable::rows_of(*curve)));
  return law;
}

}  // namespace kardan

#include "kardan/materials/laws/crushable_foam.hpp"

#include "kardan/materials/law_fields.hpp"

namespace kardan {

std::optional<CrushableFoam> CrushableFoam::make(LawSource& source) {
  LawFields m(source);
  const Curve* curve = m.curve("lcid");
  m.need(m["e"] > 0, "has no Young's modulus", "give E > 0");
  m.need(m["tsc"] >= 0, "has a negative tension cut-off", "give TSC >= 0");
  m.refuse("model", "the other law of this keyword (MODEL)", "set MODEL = 0");
  m.need(curve && curve->x.size() >= 2 && curve->y[0] > 0, "has no curve of yield stress over volumetric strain",
         "give LCID, yield stress over 1 - V/V0, both positive");
  if (!m.good()) return std::nullopt;
  if (m["damp"] != 0) source.diagnostics.warning(source.name + " is computed without DAMP; bulk viscosity damps it", "set DAMP = 0", m.fields().keyword);
  CrushableFoam law;
  law.youngs_modulus = m["e"];
  law.cutoff = m["tsc"];
  law.curve = CurveTable::from(source.keep(CurveTable::rows_of(*curve)));
  return law;
}

}  // namespace kardan

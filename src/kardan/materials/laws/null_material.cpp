#include "kardan/materials/laws/null_material.hpp"

#include "kardan/materials/law_fields.hpp"

namespace kardan {

std::optional<NullMaterial> NullMaterial::make(LawSource& source) {
  LawFields m(source);
  m.refuse("terod", "deletion by relative volume (TEROD)", "set TEROD = 0");
  m.refuse("cerod", "deletion by relative volume (CEROD)", "set CEROD = 0");
  m.need(m["pc"] <= 0, "has a positive pressure cut-off", "give PC <= 0");
  m.need(m["mu"] >= 0, "has a negative viscosity", "give MU >= 0");
  NullMaterial law;
  law.cutoff = m["pc"];
  law.viscosity = m["mu"];
  if (source.use == LawUse::solid) {
    const std::optional<PressureLaw> pressure_law = PressureLaw::make(source);
    if (!pressure_law) return std::nullopt;
    law.pressure_law = *pressure_law;
  }
  if (!m.good()) return std::nullopt;
  return law;
}

}  // namespace kardan

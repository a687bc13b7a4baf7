#include "kardan/materials/laws/viscoelastic.hpp"

#include "kardan/materials/law_fields.hpp"

namespace kardan {

std::optional<Viscoelastic> Viscoelastic::make(LawSource& source) {
  LawFields m(source);
  m.need(m["bulk"] > 0, "has no bulk modulus", "give BULK > 0");
  m.need(m["g0"] > 0 && m["gi"] >= 0, "has no short-time, or a negative long-time shear modulus", "give G0 > 0 and GI >= 0");
  m.need(m["gi"] <= m["g0"], "stiffens with time (GI > G0)", "give GI <= G0");
  m.need(m["beta"] >= 0, "has a negative decay constant", "give BETA >= 0");
  if (!m.good()) return std::nullopt;
  return Viscoelastic{m["bulk"], m["gi"], m["g0"] - m["gi"], m["beta"]};
}

}  // namespace kardan

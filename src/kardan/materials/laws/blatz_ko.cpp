#include "kardan/materials/laws/blatz_ko.hpp"

#include "kardan/materials/law_fields.hpp"

namespace kardan {

std::optional<BlatzKo> BlatzKo::make(LawSource& source) {
  LawFields m(source);
  m.need(m["g"] > 0, "has no shear modulus", "give G > 0");
  if (!m.good()) return std::nullopt;
  return BlatzKo{m["g"]};
}

}  // namespace kardan

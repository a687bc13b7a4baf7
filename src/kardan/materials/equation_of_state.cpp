#include "kardan/materials/equation_of_state.hpp"

#include <algorithm>

#include "kardan/materials/law.hpp"

namespace kardan {

std::optional<PressureLaw> PressureLaw::make(LawSource& source) {
  const EquationOfState* eos = source.equation_of_state();
  const auto complain = [&](const std::string& what, const std::string& cure) {
    source.diagnostics.error(source.name + " " + what, cure, eos ? eos->keyword : "*PART");
    return std::nullopt;
  };
  if (!eos) return complain("needs an equation of state in solids", "name one by EOSID of *PART");
  if (eos->initial_volume != 0 && eos->initial_volume != 1) {
    return complain("has an equation of state " + std::to_string(eos->id) + " with an initial relative volume, which this version does not compute",
                    "set V0 = 1 and give density and energy of that state");
  }
  PressureLaw law;
  law.gruneisen = eos->form == EquationOfState::Form::gruneisen;
  law.initial_energy = eos->initial_energy;
  std::copy(eos->constants.begin(), eos->constants.end(), law.c);
  if (law.gruneisen) law.c[0] *= eos->constants[0] * source.density;  // rho0 C^2
  if (!(law.initial_bulk() > 0)) {
    return complain("has an equation of state " + std::to_string(eos->id) + " without a bulk modulus at the start",
                    "give a sound speed (C), or C1, or energy of a gas");
  }
  return law;
}

}  // namespace kardan

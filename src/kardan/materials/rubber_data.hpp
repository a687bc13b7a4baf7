// From the fields of rubbers to constants: Prony series, bulk modulus, and constants fitted to a test.
#pragma once

#include <functional>
#include <vector>

#include "kardan/materials/law_fields.hpp"
#include "kardan/materials/prony.hpp"

namespace kardan {

/// K = 2 mu (1 + nu)/(3 (1 - 2 nu)).
inline double bulk_modulus(double shear, double nu) { return 2 * shear * (1 + nu) / (3 * (1 - 2 * nu)); }

/// G1, BETA1, G2, … of the deck; complains about what cannot be computed.
PronySeries prony_series(LawFields& fields);

/// What is refused in all rubbers of type 77, and Poisson's ratio outside (0, 0.5).
void check_rubber(LawFields& fields);

/// How a test loads its specimen: the field DATA.
enum class RubberTest { uniaxial = 1, biaxial = 2, pure_shear = 3 };

/// Constants C_k of an incompressible energy W = sum_k C_k I^p_k II^q_k, I = J1 - 3, II = J2 - 3, by least squares of the nominal stress
/// of a test, force over change of length in the curve `lcid` with SGL, SW, ST; complains where it does not determine them.
struct Monomial {
  int p = 0, q = 0;
};
std::vector<double> fit_invariants(LawFields& fields, const char* lcid, RubberTest test, const std::vector<Monomial>& terms);

}  // namespace kardan

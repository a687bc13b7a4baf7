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

/// What the energies are polynomials of: J1 - 3 and J2 - 3, or I1 and I2 of the Green-St. Venant strain, (J1 - 3)/2 and (J2 - 3)/4 - (J1 - 3)/2.
enum class RubberInvariants { stretch, green_strain };
struct RubberFit {
  RubberTest test = RubberTest::uniaxial;
  RubberInvariants invariants = RubberInvariants::stretch;
};

/// Constants C_k of an incompressible energy W = sum_k C_k I^p_k II^q_k, I and II the invariants, by least squares of the nominal stress
/// of a test, force over change of length in the curve `lcid` with SGL, SW, ST; complains where it does not determine them.
struct Monomial {
  int p = 0, q = 0;
};
std::vector<double> fit_invariants(LawFields& fields, const char* lcid, const RubberFit& fit, const std::vector<Monomial>& terms);

}  // namespace kardan

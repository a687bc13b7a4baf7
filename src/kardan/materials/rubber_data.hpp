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

/// Nominal stress over stretch of a test; empty, with a complaint, where it is not given.
struct TestPoints {
  std::vector<double> stretch, stress;
};
TestPoints test_points(LawFields& fields, const char* lcid);

/// Least squares of `columns` x = right by Gram and Schmidt, twice; empty where a column depends on those before it.
std::vector<double> least_squares(std::vector<std::vector<double>> columns, std::vector<double> right);

/// A term mu/alpha (l_1^alpha + l_2^alpha + l_3^alpha - 3) of Ogden's energy.
struct OgdenTerm {
  double mu = 0, alpha = 0;
};
/// `count` terms with mu alpha > 0 and |alpha| <= 20, fitted likewise by Levenberg's and Marquardt's method (1944, Quart. Appl. Math. 2, 164-168; 1963,
/// J. SIAM 11, 431-441) from many starts, the best of which counts; complains where the test does not
/// determine so many.
std::vector<OgdenTerm> fit_ogden(LawFields& fields, const char* lcid, RubberTest test, std::size_t count);

}  // namespace kardan

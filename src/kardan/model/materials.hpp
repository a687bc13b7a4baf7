// Materials as typed structs. A law that Kardan reads but cannot compute yet is an UnsupportedMaterial: its density
// still counts, and running a deformable part of it is refused by name.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/model/erosion.hpp"

namespace kardan {

/// *MAT_RIGID (020).
struct RigidMaterial {
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;
  double cmo = 0;                   ///< +1 global constraints, -1 local, 0 none; +-2 likewise at `constraint_point`
  int con1 = 0;                     ///< CMO > 0: translational code 0-7; CMO < 0: not used, see `frame`
  int con2 = 0;                     ///< CMO > 0: rotational code 0-7; CMO < 0: Dof bits in local axes
  Index frame = none;               ///< CMO < 0: local axes (CON1), fixed in space; none = global
  Vec3 constraint_point{};          ///< |CMO| = 2: XSPC, YSPC, ZSPC or the initial coordinates of SPCNID
  NodeIndex constraint_node = none; ///< |CMO| = 2: SPCNID
  Index output_frame = none;        ///< LCO: local output system
  Vec3 a{}, v{};                    ///< A1..A3, V1..V3 where LCO is not a frame
};

/// *MAT_ELASTIC (001).
struct ElasticMaterial {
  double density = 0, youngs_modulus = 0, poissons_ratio = 0, da = 0, db = 0;
};

/// *MAT_PIECEWISE_LINEAR_PLASTICITY (024) and *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY (123): yield stress over effective plastic strain from
/// the table of curves by strain rate, else from the curve, else from the points, else from SIGY and ETAN; without a table times the rate
/// factor 1 + (rate/C)^(1/P) where C and P are positive, or LCSR(rate).
struct PiecewisePlasticMaterial {
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;
  double yield_stress = 0, tangent_modulus = 0;     ///< SIGY, ETAN (slope of stress over total strain)
  double rate_constant = 0, rate_exponent = 0;      ///< C [1/time], P; 0 = no rate effect
  CurveIndex curve = none;                          ///< LCSS
  Index table = none;                               ///< LCSS where it names a table
  CurveIndex rate_curve = none;                     ///< LCSR
  int points = 0;                                   ///< of EPS, ES; 0 or 2 to 8
  std::array<double, 8> strain{}, stress{};         ///< EPS ascending, ES
  int formulation = 0;                              ///< VP: -1, 0, 1 or 3
  double filter = 0;                                ///< RFILTF of VP = 3
  double failure_strain = 0, smallest_step = 0;     ///< FAIL, TDEL; 0 = none
  bool modified = false;                            ///< 123
  double thinning = 0, major_strain = 0;            ///< EPSTHIN, EPSMAJ: strains at failure of shells; 0 = none
  double failing_points = 0;                        ///< NUMINT: see ElementDeletion::points
};

/// Springs and dampers of *ELEMENT_DISCRETE, S01 to S08.
enum class SpringLaw : std::uint8_t {
  elastic_spring,            ///< S01: f = K d
  viscous_damper,            ///< S02: f = DC v
  elastoplastic_spring,      ///< S03: K, KT, FY
  nonlinear_elastic_spring,  ///< S04: f = LCD(d) LCR(v), the second a scale factor, 1 without a curve
  nonlinear_viscous_damper,  ///< S05: f = LCDR(v)
  general_nonlinear_spring,  ///< S06: LCDL, LCDU, BETA, TYI, CYI
  maxwell_spring,            ///< S07: K0, KI, BETA, TC, FC, COPT
  inelastic_spring           ///< S08: LCFD, KU, CTF
};
struct SpringMaterial {
  SpringLaw law = SpringLaw::elastic_spring;
  std::array<double, 6> p{};                             ///< the law's reals in the order of its card
  std::array<CurveIndex, 2> curve{none, none};           ///< the law's curves in the order of its card
};

/// A law whose parameters only its own files in materials/laws know: what the deck gives, by the (lower case) names of the keyword's
/// fields, numbers in the main deck's units.
struct FieldMaterial {
  int number = 0;       ///< LS-DYNA's: 15 for *MAT_JOHNSON_COOK
  char variant = 0;     ///< 'H' of 77_H
  std::string keyword;  ///< "*MAT_JOHNSON_COOK"
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;  ///< RO, E, PR; 0 where the keyword has no such field
  std::map<std::string, double, std::less<>> values;           ///< every real or integer field, blank ones at their default
  std::map<std::string, CurveIndex, std::less<>> curves;       ///< fields that name a curve, where they do
  std::map<std::string, Index, std::less<>> tables;            ///< likewise a table

  double value(std::string_view field) const {
    const auto found = values.find(field);
    return found == values.end() ? 0.0 : found->second;
  }
  /// `fallback` where the field is blank or 0.
  double value_or(std::string_view field, double fallback) const {
    const double v = value(field);
    return v != 0 ? v : fallback;
  }
  CurveIndex curve(std::string_view field) const {
    const auto found = curves.find(field);
    return found == curves.end() ? none : found->second;
  }
  Index table(std::string_view field) const {
    const auto found = tables.find(field);
    return found == tables.end() ? none : found->second;
  }
};

/// *EOS_…: pressure from compression and internal energy; the formulas stand in materials/equation_of_state.hpp.
struct EquationOfState {
  enum class Form : std::uint8_t { linear_polynomial, gruneisen };
  UserId id = 0;
  std::string keyword;
  Form form = Form::linear_polynomial;
  std::array<double, 7> constants{};  ///< C0 … C6; or C, S1, S2, S3, GAMMA0, A
  double initial_energy = 0;          ///< E0, per initial volume
  double initial_volume = 0;          ///< V0, relative; 0 is 1
};

struct UnsupportedMaterial {
  std::string keyword;
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;
};

struct Material {
  UserId id = 0;
  std::string title;
  std::variant<RigidMaterial, ElasticMaterial, PiecewisePlasticMaterial, SpringMaterial, FieldMaterial, UnsupportedMaterial> law;
  std::optional<ErosionCriteria> erosion{};  ///< *MAT_ADD_EROSION

  bool rigid() const { return std::holds_alternative<RigidMaterial>(law); }
};

}  // namespace kardan

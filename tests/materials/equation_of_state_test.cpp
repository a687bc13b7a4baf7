#include "kardan/materials/equation_of_state.hpp"

#include <cmath>

#include "kardan/materials/law.hpp"
#include "kardan/materials/laws/null_material.hpp"
#include "kardan/materials/laws/viscoelastic.hpp"
#include "materials/law_probe.hpp"

namespace kardan {
namespace {

using test::expect_lanes_independent;
using test::lane;
using test::LawProbe;
using test::Tensor;

NullMaterial gas(double gamma, double energy) {
  NullMaterial law;
  law.pressure_law.c[4] = law.pressure_law.c[5] = gamma - 1;
  law.pressure_law.initial_energy = energy;
  return law;
}
/// Copper (Steinberg 1991), g/cm3, mm/us, GPa.
NullMaterial copper() {
  NullMaterial law;
  law.pressure_law.gruneisen = true;
  const double c[] = {8.93 * 3.94 * 3.94, 1.489, 0.02, 0.01, 2.02, 0.47};
  std::copy(std::begin(c), std::end(c), law.pressure_law.c);
  law.cutoff = -1e9;
  return law;
}
double pressure(const LawProbe<NullMaterial>& p) { return -(p.stress().xx + p.stress().yy + p.stress().zz) / 3; }

/// Brings V/V0 from `from` to `to` with the sides kept.
void squeeze(LawProbe<NullMaterial>& point, double from, double to, int steps) {
  for (int i = 1; i <= steps; ++i) {
    const double v0 = from + (to - from) * (i - 1) / steps, v1 = from + (to - from) * i / steps;
    point.step({2 * (v1 - v0) / (v1 + v0), 0, 0, 0, 0, 0}, v1);
  }
}

TEST(EquationOfState, IdealGasFollowsItsAdiabat) {
  const double gamma = 1.4, energy = 2.5;
  const auto error = [&](int steps) {
    LawProbe<NullMaterial> point(gas(gamma, energy));
    point.step({}, 1);
    EXPECT_DOUBLE_EQ(pressure(point), (gamma - 1) * energy);
    squeeze(point, 1, 0.4, steps);
    const double expected = (gamma - 1) * energy * std::pow(0.4, -gamma);
    EXPECT_NEAR(point.modulus(), gamma * pressure(point) * 0.4, 1e-9 * point.modulus());  // rho0 c^2 = gamma p V
    EXPECT_NEAR(point.history(0) / (energy * std::pow(0.4, 1 - gamma)), 1.0, 2.0 / (steps * steps));
    return std::abs(pressure(point) / expected - 1);
  };
  const double coarse = error(50), fine = error(100);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

/// Pressure against the printed formula, and rho0 c^2 against the difference of pressures along the adiabat.
TEST(EquationOfState, GruneisenPressureAndWaveSpeed) {
  const NullMaterial law = copper();
  for (const double v : {0.6, 0.8, 0.95, 1.0, 1.05, 1.2}) {
    LawProbe<NullMaterial> point(law);
    point.step({}, 1);
    squeeze(point, 1, v, 4000);
    const double mu = 1 / v - 1, g = 2.02, a = 0.47, e = point.history(0), stiff = 8.93 * 3.94 * 3.94;
    const double root = 1 - 0.489 * mu - 0.02 * mu * mu / (mu + 1) - 0.01 * mu * mu * mu / ((mu + 1) * (mu + 1));
    const double cold = mu > 0 ? stiff * mu * (1 + (1 - g / 2) * mu - a / 2 * mu * mu) / (root * root) : stiff * mu;
    EXPECT_NEAR(pressure(point), cold + (g + a * mu) * e, 1e-9 * stiff) << v;
    const double stiffness = point.modulus(), before = pressure(point), step = 1e-5;
    point.step({2 * -step / (2 * v - step), 0, 0, 0, 0, 0}, v - step);
    const double slope = (pressure(point) - before) / step;  // -dp/dV = rho0 c^2 / V^2
    EXPECT_NEAR(slope * (v - 0.5 * step) * (v - 0.5 * step), 0.5 * (stiffness + point.modulus()), 1e-4 * stiffness) << v;
  }
}

TEST(EquationOfState, TensionIsCutOffAndViscosityHeats) {
  NullMaterial law = copper();
  law.cutoff = -0.3;
  LawProbe<NullMaterial> point(law);
  squeeze(point, 1, 1.3, 100);
  EXPECT_DOUBLE_EQ(pressure(point), -0.3);
  // Viscous shear: s_xy = 2 MU e', and its work is in the energy.
  law.viscosity = 0.07;
  LawProbe<NullMaterial> fluid(law);
  const double dt = 1e-3, e = 1e-5;
  for (int i = 0; i < 10; ++i) fluid.step({e, -e, 0, 2 * e, 0, 0}, 1, dt);
  EXPECT_NEAR(fluid.stress().xy, 2 * 0.07 * 2 * e / dt, 1e-12);
  EXPECT_NEAR(fluid.stress().xx + pressure(fluid), 2 * 0.07 * e / dt, 1e-12);
  const double power = 2 * 0.07 * (2 * e * e + 8 * e * e) / (dt * dt);
  EXPECT_NEAR(fluid.history(0), power * 9.5 * dt, 1e-12);  // the first step starts from no stress
  // Bulk viscosity heats by -q dV.
  LawProbe<NullMaterial> heated(copper());
  heated.point.viscosity = 0.5;
  heated.step({-0.01, 0, 0, 0, 0, 0}, 0.99);
  LawProbe<NullMaterial> cold(copper());
  cold.step({-0.01, 0, 0, 0, 0, 0}, 0.99);
  const double b = 2.02 + 0.47 * (1 / 0.99 - 1);
  EXPECT_NEAR(heated.history(0) - cold.history(0), 0.5 * 0.01 / (1 - 0.5 * b * 0.01), 1e-12);
}

TEST(EquationOfState, LanesAreIndependent) {
  expect_lanes_independent(copper(), 0.005);
  expect_lanes_independent(gas(1.4, 1.0), 0.005);
}

TEST(EquationOfState, NullMaterialNeedsOneInSolidsAndNoneInShells) {
  Model model;
  Material material;
  FieldMaterial m;
  m.number = 9;
  m.keyword = "*MAT_NULL";
  m.density = 1;
  material.law = m;
  model.materials.push_back(material);
  EquationOfState eos;
  eos.keyword = "*EOS_GRUNEISEN";
  eos.form = EquationOfState::Form::gruneisen;
  eos.constants = {3.94, 1.489, 0, 0, 2, 0.5, 0};
  model.equations_of_state.push_back(eos);
  Part part;
  part.material = 0;
  const auto errors = [&](LawUse use) {
    Diagnostics d;
    const std::optional<Law> law = make_law(model, part, use, 1, d);
    EXPECT_EQ(law.has_value(), d.error_count() == 0);
    EXPECT_DOUBLE_EQ(law ? law->longitudinal : 0.0, law && use == LawUse::solid ? 3.94 * 3.94 : 0.0);
    return d.error_count();
  };
  EXPECT_EQ(errors(LawUse::solid), 1u);
  EXPECT_EQ(errors(LawUse::shell), 0u);
  part.equation_of_state = 0;
  EXPECT_EQ(errors(LawUse::solid), 0u);
  model.equations_of_state[0].initial_volume = 1.1;
  EXPECT_EQ(errors(LawUse::solid), 1u);
  model.equations_of_state[0].initial_volume = 1;
  model.equations_of_state[0].constants[0] = 0;
  EXPECT_EQ(errors(LawUse::solid), 1u);
}

/// s = 2 [GI e + (G0 - GI) rate (1 - exp(-beta t))/beta] at a constant rate, in any number of steps, then relaxation to GI; p = -K log V.
TEST(Viscoelastic, ConstantRateAndRelaxationAreExact) {
  const Viscoelastic law{5.0, 0.4, 1.1, 30.0};
  for (const int steps : {1, 10, 1000}) {
    LawProbe<Viscoelastic> point(law);
    const double time = 0.1, rate = 2, pull = 0.3;
    for (int i = 0; i < steps; ++i) point.step({pull * time / steps, 0, 0, rate * time / steps, 0, 0}, 1, time / steps);
    const double viscous = 1.1 * -std::expm1(-3.0) / 30, factor = 2 * (0.4 * time + viscous);
    EXPECT_NEAR(point.stress().xy, factor * rate, 1e-13);
    EXPECT_NEAR(point.stress().xx, factor * pull * 2 / 3 + 5.0 * pull * time, 1e-13);
    EXPECT_NEAR(point.stress().yy, -factor * pull / 3 + 5.0 * pull * time, 1e-13);
    point.step({}, 1, 0.05);
    EXPECT_NEAR(point.stress().xy, 2 * rate * (0.4 * time + viscous * std::exp(-1.5)), 1e-13);
  }
  expect_lanes_independent(law, 0.01);
}

/// LS-DYNA would take the equation of state in place of E and PR: to compute without it would be another material.
TEST(EquationOfState, JohnsonCookWithOneIsRefusedInSolids) {
  Model model;
  Material material;
  FieldMaterial m;
  m.number = 15;
  m.keyword = "*MAT_JOHNSON_COOK";
  m.density = 8930;
  m.youngs_modulus = 117e9;
  m.poissons_ratio = 0.35;
  m.values = {{"a", 90e6}, {"b", 292e6}, {"n", 0.31}, {"epso", 1.0}};
  material.law = m;
  model.materials.push_back(material);
  model.equations_of_state.emplace_back();
  Part part;
  part.material = 0;
  const auto refused = [&](LawUse use) {
    Diagnostics d;
    return !make_law(model, part, use, 1, d) && d.error_count() == 1;
  };
  EXPECT_FALSE(refused(LawUse::solid));
  part.equation_of_state = 0;
  EXPECT_TRUE(refused(LawUse::solid));
  EXPECT_FALSE(refused(LawUse::shell));
}

}  // namespace
}  // namespace kardan

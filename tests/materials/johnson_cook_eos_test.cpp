// *MAT_JOHNSON_COOK with an equation of state.
#include <fstream>
#include <sstream>

#include "kardan/materials/laws/johnson_cook.hpp"
#include "materials/law_paths.hpp"
#include "materials/law_probe.hpp"

namespace kardan {
namespace {

using test::expect_lanes_independent;
using test::LawProbe;
using Values = std::map<std::string, double, std::less<>>;

/// The metal and the equations of tests/oracles/johnson_cook_eos.py.
FieldMaterial metal(const Values& more = {}) {
  FieldMaterial m;
  m.number = 15;
  m.keyword = "*MAT_JOHNSON_COOK";
  m.density = 7.8e-6;
  m.values = more;
  m.values.insert({{"g", 210 / 2.6}, {"a", 0.3}, {"b", 0.4}, {"n", 0.26}, {"c", 0.05}, {"epso", 0.2}, {"cp", 450}, {"tr", 293}, {"tm", 1793}, {"m", 1.03},
                   {"d1_beta", 0.5}, {"d2_wc", 3.44}, {"d3_dc", -2.12}, {"d4_gamma", 0.02}, {"d5", 0.61}});
  return m;
}
EquationOfState equation(bool gruneisen) {
  EquationOfState e;
  if (gruneisen) {
    e.form = EquationOfState::Form::gruneisen;
    e.constants = {4600, 1.4, 0.02, 0.01, 2.0, 0.46, 0};
  } else {
    e.constants = {0, 140, 180, 90, 1.9, 0.6, 0.3};
    e.initial_energy = 0.02;
  }
  return e;
}
std::optional<JohnsonCook> made(const FieldMaterial& fields, const EquationOfState& eos, Diagnostics& diagnostics) {
  const Model model;
  const Material material{7, {}, fields};
  LawSource source{model, material, diagnostics, "material 7", {}};
  source.density = fields.density;
  source.eos = &eos;
  return JohnsonCook::make(source);
}

TEST(JohnsonCookEquationOfState, FollowsTheOracle) {
  std::ifstream file(std::string(KARDAN_SOURCE_DIR) + "/tests/oracles/johnson_cook_eos.csv");
  std::string row, before, name, path, cell;
  std::getline(file, row);
  std::optional<LawProbe<JohnsonCook>> point;
  double worst = 0;
  int rows = 0;
  Diagnostics d;
  while (std::getline(file, row)) {
    std::istringstream in(row);
    std::getline(in, name, ',');
    std::getline(in, path, ',');
    if (name + path != before) point.emplace(*made(metal(), equation(name == "gruneisen"), d));
    before = name + path;
    double x[18];
    for (double& v : x) {
      ASSERT_TRUE(std::getline(in, cell, ','));
      v = std::stod(cell);
    }
    const test::Tensor s = point->step({x[0], x[1], x[2], 0.5 * x[3], 0.5 * x[4], 0.5 * x[5]}, x[6]);
    const double stress[] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
    for (std::size_t i = 0; i < 6; ++i) worst = std::max(worst, std::abs(stress[i] - x[7 + i]));
    worst = std::max({worst, std::abs(point->history(0) - x[13]), std::abs(point->history(1) - x[14]) / 293, std::abs(point->history(2) - x[15]),
                      std::abs(point->history(JohnsonCook::equation_place) - x[16])});
    EXPECT_GT(point->modulus(), 4.0 / 3 * 210 / 2.6);
    ++rows;
  }
  EXPECT_EQ(rows, 156);
  EXPECT_LT(worst, 1e-9);
}

TEST(JohnsonCookEquationOfState, NeedsNoYoungsModulusButAShearModulus) {
  Diagnostics d;
  const auto law = made(metal(), equation(true), d);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->longitudinal(), 7.8e-6 * 4600 * 4600 + 4.0 / 3 * 210 / 2.6, 1e-9);
  EXPECT_NEAR(law->shear(), 210 / 2.6, 1e-12);
  EXPECT_FALSE(made(metal({{"g", 0.0}}), equation(true), d));
  EXPECT_EQ(d.error_count(), 1u);
}

/// Tension cut off at -PC (SPALL = 1): no energy beyond what the cut-off pressure takes.
TEST(JohnsonCookEquationOfState, CutsTheTensionOff) {
  Diagnostics d;
  const auto law = made(metal({{"pc", -0.5}, {"spall", 1}, {"d1_beta", 0.0}, {"d2_wc", 0.0}}), equation(true), d);
  ASSERT_TRUE(law);
  LawProbe<JohnsonCook> point(*law);
  double volume = 1;
  for (int i = 0; i < 40; ++i) {
    const double next = volume + 1e-3;
    const double e = 2 * (next - volume) / (next + volume) / 3;
    point.step({e, e, e, 0, 0, 0}, volume = next);
  }
  EXPECT_NEAR(point.stress().xx, 0.5, 1e-12);
  EXPECT_NEAR(point.history(JohnsonCook::equation_place), 0.5 * 0.04, 0.5 * 0.5 / 165 * 1.2);
}

TEST(JohnsonCookEquationOfState, LanesAreIndependent) {
  Diagnostics d;
  expect_lanes_independent(*made(metal(), equation(true), d), 0.001);
}

}  // namespace
}  // namespace kardan

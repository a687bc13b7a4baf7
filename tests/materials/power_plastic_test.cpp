#include "kardan/materials/laws/power_plastic.hpp"

#include "kardan/materials/laws/johnson_cook.hpp"
#include "materials/law_paths.hpp"

namespace kardan {
namespace {

using law_paths::complaint;
using law_paths::made;
using law_paths::points_of;
using law_paths::ShellPointOf;
using law_paths::SolidPoint;
using law_paths::Six;

using Values = std::map<std::string, double, std::less<>>;

FieldMaterial material(int number, const char* keyword, const Values& values) {
  FieldMaterial m;
  m.number = number;
  m.keyword = keyword;
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.values = values;
  return m;
}
FieldMaterial isotropic(const Values& v) { return material(12, "*MAT_ISOTROPIC_ELASTIC_PLASTIC", v); }
FieldMaterial power(const Values& v) { return material(18, "*MAT_POWER_LAW_PLASTICITY", v); }
FieldMaterial simplified(Values v) {
  v.insert({{"a", 0.3}, {"b", 0.4}, {"n", 0.26}, {"c", 0.05}, {"epso", 0.2}});
  return material(98, "*MAT_SIMPLIFIED_JOHNSON_COOK", v);
}
FieldMaterial johnson_cook(Values v) {
  v.insert({{"a", 0.3}, {"b", 0.4}, {"n", 0.26}, {"c", 0.05}, {"epso", 0.2}, {"cp", 450}, {"tr", 293}, {"tm", 1793}, {"m", 1.03}});
  return material(15, "*MAT_JOHNSON_COOK", v);
}
const Values fracture{{"d1_beta", 0.5}, {"d2_wc", 3.44}, {"d3_dc", -2.12}, {"d4_gamma", 0.02}, {"d5", 0.61}};
Values with(Values a, const Values& b) {
  a.insert(b.begin(), b.end());
  return a;
}

class PowerPlasticLaw : public ::testing::Test {
 protected:
  template <class Law = PowerPlastic>
  Law law(const FieldMaterial& m) { return made<Law>(m, model_, kept_); }
  Model model_;
  std::vector<std::shared_ptr<std::vector<double>>> kept_;
};

TEST_F(PowerPlasticLaw, FollowsTheOracle) {
  const double shear = 210 / 2.6, bulk = 210 / (3 * 0.4);
  const std::map<std::string, law_paths::Make> laws{
      {"line", points_of(law(isotropic({{"g", shear}, {"bulk", bulk}, {"sigy", 0.25}, {"etan", 2.0}})))},
      {"power", points_of(law(power({{"k", 0.6}, {"n", 0.2}, {"src", 40}, {"srp", 5}})))},
      {"power_vp", points_of(law(power({{"k", 0.6}, {"n", 0.2}, {"src", 40}, {"srp", 5}, {"sigy", 0.3}, {"vp", 1}})))},
      {"simplified", points_of(law(simplified({{"sigmax", 0.55}, {"sigsat", 0.62}, {"psfail", 1e17}})))},
      {"simplified_vp", points_of(law(simplified({{"vp", 1}, {"sigmax", 0.55}, {"sigsat", 1e28}})))}};
  law_paths::follow("j2_metals.csv", laws, 1e-3, 0.25, 1e-8);
}

TEST_F(PowerPlasticLaw, JohnsonCookFollowsTheOracleWithHeatAndDamage) {
  const auto jc = [&](const Values& v) { return points_of(law<JohnsonCook>(johnson_cook(with(v, fracture)))); };
  const std::map<std::string, law_paths::Make> laws{{"johnson_cook_0", jc({})},
                                                    {"johnson_cook_0_vp", jc({{"vp", 1}})},
                                                    {"johnson_cook_1_vp", jc({{"vp", 1}, {"rateop", 1}, {"c2_p_xnp_d", 0.01}})},
                                                    {"johnson_cook_2_vp", jc({{"vp", 1}, {"rateop", 2}})}};
  law_paths::follow("j2_metals.csv", laws, 1e-3, 0.25, 1e-8, {{1, 293}, {2, 1}});
}

/// Y = A (1 - T*), all work heat: dT*/dp = A (1 - T*)/(rho CP (TM - TR)), so the stress decays as exp(-A p/(rho CP (TM - TR))).
TEST_F(PowerPlasticLaw, AdiabaticSofteningIsTheExponential) {
  const JohnsonCook metal = law<JohnsonCook>(johnson_cook({{"b", 0.0}, {"n", 1}, {"c", 0.0}, {"m", 1}}));
  SolidPoint<JohnsonCook> p(metal);
  for (int i = 0; i < 20000; ++i) p.step({0, 0, 0, 1e-4, 0, 0}, 1e-3, 0);
  const double strain = p.plastic_strain(), decay = std::exp(-0.3 * strain / (7.8e-6 * 450 * 1500));
  EXPECT_NEAR(p.last().stress[3] * std::sqrt(3.0) / (0.3 * decay), 1, 1e-5);
  EXPECT_NEAR((p.value(1) - 293) / 1500, 1 - decay, 1e-5);
  EXPECT_GT(strain, 1.1);
}

TEST_F(PowerPlasticLaw, MeltedMetalCarriesNoShear) {
  SolidPoint<JohnsonCook> p(law<JohnsonCook>(johnson_cook({{"cp", 1e-3}})));
  for (int i = 0; i < 200; ++i) p.step({1e-5, 0, 0, 1e-2, 0, 0}, 1e-3, 0);
  EXPECT_EQ(p.last().stress[3], 0.0);
  EXPECT_GT(p.last().stress[0], 0.1);
}

/// Simple shear has no mean stress: D1 + D2 is the strain at failure.
TEST_F(PowerPlasticLaw, FailsWhereTheDamageIsOne) {
  const JohnsonCook metal = law<JohnsonCook>(johnson_cook({{"d1_beta", 0.02}, {"d2_wc", 0.03}, {"d3_dc", -2.0}, {"cp", 0.0}}));
  SolidPoint<JohnsonCook> p(metal);
  EXPECT_TRUE(metal.can_fail());
  while (!p.last().failed && p.plastic_strain() < 1) p.step({0, 0, 0, 1e-4, 0, 0}, 1e-3, 0);
  EXPECT_NEAR(p.plastic_strain(), 0.05, 1e-4);
  // With EROD the solid keeps its pressure and loses its deviator.
  SolidPoint<JohnsonCook> kept(law<JohnsonCook>(johnson_cook({{"d1_beta", 0.02}, {"cp", 0.0}, {"erod", 1}})));
  for (int i = 0; i < 1000; ++i) kept.step({-1e-6, -1e-6, -1e-6, 1e-4, 0, 0}, 1e-3, 0);
  EXPECT_FALSE(kept.last().failed);
  EXPECT_EQ(kept.last().stress[3], 0.0);
  EXPECT_NEAR(kept.last().stress[0], -3e-3 * 210 / (3 * 0.4), 1e-9);
}

TEST_F(PowerPlasticLaw, SpallLimitsTheTension) {
  const auto pulled = [&](double model, const Six& d) {
    SolidPoint<JohnsonCook> p(law<JohnsonCook>(johnson_cook({{"pc", -1.0}, {"spall", model}})));
    for (int i = 0; i < 100; ++i) p.step(d, 1e-3, 0);
    return p.last().stress;
  };
  const Six swelling{1e-4, 1e-4, 1e-4, 1e-5, 0, 0};  // mean stress 210 * 1e-4 * 100/0.4 = 5.25 without spall
  const Six cut = pulled(1, swelling);
  EXPECT_NEAR((cut[0] + cut[1] + cut[2]) / 3, 1.0, 1e-12);
  EXPECT_GT(cut[3], 0);
  for (const double model : {2.0, 3.0}) {
    for (const double s : pulled(model, swelling)) EXPECT_EQ(s, 0.0);
  }
  // Spalled material still carries pressure.
  SolidPoint<JohnsonCook> p(law<JohnsonCook>(johnson_cook({{"pc", -1.0}, {"spall", 3}})));
  for (int i = 0; i < 30; ++i) p.step(swelling, 1e-3, 0);
  for (int i = 0; i < 10; ++i) p.step({-1e-4, -1e-4, -1e-4, 0, 0, 0}, 1e-3, 0);
  EXPECT_NEAR(p.last().stress[0], -10 * 3e-4 * 210 / (3 * 0.4), 1e-12);
  // Points of shells fail: biaxial stress E/(1 - nu) e.
  ShellPointOf<JohnsonCook> shell(law<JohnsonCook>(johnson_cook({{"pc", -0.25}, {"spall", 2}})));
  int steps = 0;
  while (!shell.last().failed && steps < 100) shell.step({1e-5, 1e-5, 0, 0, 0, 0}, 1e-3, 0), ++steps;
  EXPECT_EQ(steps, static_cast<int>(std::ceil(0.25 / (210 / 0.7 * 1e-5))));
}

TEST_F(PowerPlasticLaw, FailsWhereThePlasticStrainReachesItsLimit) {
  for (const FieldMaterial& m : {simplified({{"psfail", 0.05}}), power({{"k", 0.6}, {"n", 0.2}, {"epsf", 0.05}})}) {
    ShellPointOf<PowerPlastic> p(law(m));
    while (!p.last().failed && p.plastic_strain() < 1) p.step({0, 0, 0, 1e-3, 0, 0}, 1e-3, 0);
    EXPECT_GE(p.plastic_strain(), 0.05);
    EXPECT_LT(p.plastic_strain(), 0.05 + 1e-3);
  }
}

TEST_F(PowerPlasticLaw, ALaneDoesNotFeelItsNeighbours) {
  const JohnsonCook metal = law<JohnsonCook>(johnson_cook(with({{"vp", 1}}, fracture)));
  SolidPoint<JohnsonCook> a(metal), b(metal);
  ShellPointOf<JohnsonCook> c(metal), d(metal);
  for (int i = 0; i < 40; ++i) {
    const Six e{3e-3 * std::sin(i), 2e-3 * std::cos(2 * i), -1e-3 * std::sin(i), 1e-3, 0, 1e-4 * i};
    ASSERT_EQ(a.step(e, 1e-3, 0).stress, b.step(e, 1e-3, 0.05 * std::sin(3 * i)).stress) << i;
    ASSERT_EQ(c.step(e, 1e-3, 0).stress, d.step(e, 1e-3, 0.05 * std::sin(3 * i)).stress) << i;
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.value(i), b.value(i));
  EXPECT_GT(a.plastic_strain(), 0.01);
}

TEST_F(PowerPlasticLaw, RefusesWhatIsNotComputed) {
  EXPECT_EQ(complaint<PowerPlastic>(simplified({}), model_), "");
  EXPECT_NE(complaint<PowerPlastic>(simplified({{"a", -1}}), model_).find("yield stress"), std::string::npos);
  EXPECT_NE(complaint<PowerPlastic>(simplified({{"vp", 2}}), model_).find("VP"), std::string::npos);
  EXPECT_NE(complaint<PowerPlastic>(power({{"k", 0.6}, {"n", 2}}), model_).find("power law"), std::string::npos);
  EXPECT_NE(complaint<PowerPlastic>(power({{"k", 300}, {"n", 0.5}}), model_).find("elastic line"), std::string::npos);
  EXPECT_NE(complaint<PowerPlastic>(isotropic({{"g", 80}, {"bulk", 160}}), model_).find("no yield stress"), std::string::npos);
  EXPECT_NE(complaint<JohnsonCook>(johnson_cook({{"tm", 200}}), model_).find("softening by temperature"), std::string::npos);
  EXPECT_NE(complaint<JohnsonCook>(johnson_cook({{"vp", 1}, {"rateop", 4}}), model_).find("RATEOP"), std::string::npos);
  EXPECT_NE(complaint<JohnsonCook>(johnson_cook({{"dmodel", 1}}), model_).find("DMODEL"), std::string::npos);
  EXPECT_NE(complaint<JohnsonCook>(johnson_cook({{"g", 50}}), model_).find("G that is not"), std::string::npos);
  EXPECT_NE(complaint<JohnsonCook>(johnson_cook({{"pc", -1}, {"spall", 4}}), model_).find("spall"), std::string::npos);
  FieldMaterial fluid = johnson_cook({});
  fluid.youngs_modulus = 0;
  EXPECT_NE(complaint<JohnsonCook>(fluid, model_).find("equation of state"), std::string::npos);
}

}  // namespace
}  // namespace kardan

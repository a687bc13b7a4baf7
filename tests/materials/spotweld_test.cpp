// *MAT_SPOTWELD of solids.
#include "kardan/materials/laws/spotweld.hpp"

#include "materials/law_paths.hpp"

namespace kardan {
namespace {

using law_paths::complaint;
using law_paths::made;
using law_paths::SolidPoint;

FieldMaterial weld(const std::map<std::string, double, std::less<>>& more = {}) {
  FieldMaterial m;
  m.number = 100;
  m.keyword = "*MAT_SPOTWELD";
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.values = more;
  m.values.insert({{"sigy", 0.25}, {"eh", 210 * 2.0 / 208}});
  return m;
}

class SpotweldOfSolids : public ::testing::Test {
 protected:
  Spotweld law(const FieldMaterial& m) { return made<Spotweld>(m, model_, kept_); }
  Model model_;
  std::vector<std::shared_ptr<std::vector<double>>> kept_;
};

/// The rows "line" of tests/oracles/j2_metals.py: linear isotropic hardening.
TEST_F(SpotweldOfSolids, FollowsTheOracle) {
  law_paths::follow("j2_metals.csv", {{"line", law_paths::points_of(law(weld()))}}, 1e-3, 0.25, 1e-8);
}

TEST_F(SpotweldOfSolids, FailsByPlasticStrainAndByTime) {
  const Spotweld strong = law(weld({{"efail", 0.05}}));
  EXPECT_TRUE(strong.can_fail());
  SolidPoint<Spotweld> p(strong);
  while (!p.last().failed && p.plastic_strain() < 1) p.step({0, 0, 0, 1e-3, 0, 0}, 1e-3, 0);
  EXPECT_NEAR(p.plastic_strain(), 0.05, 1e-3);
  SolidPoint<Spotweld> timed(law(weld({{"tfail", 0.0105}})));
  int steps = 0;
  while (!timed.last().failed && steps < 100) timed.step({1e-6, 0, 0, 0, 0, 0}, 1e-3, 0), ++steps;
  EXPECT_EQ(steps, 11);
  EXPECT_FALSE(law(weld()).can_fail());
}

TEST_F(SpotweldOfSolids, RefusesResultantsAndMassScaling) {
  EXPECT_NE(complaint<Spotweld>(weld({{"nrr", 5.0}}), model_).find("force"), std::string::npos);
  EXPECT_NE(complaint<Spotweld>(weld({{"dt", 1e-3}}), model_).find("DT"), std::string::npos);
  EXPECT_EQ(complaint<Spotweld>(weld({{"efail", 1e21}, {"tfail", 1e21}}), model_), "");
}

}  // namespace
}  // namespace kardan

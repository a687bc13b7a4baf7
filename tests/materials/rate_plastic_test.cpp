#include "kardan/materials/laws/rate_plastic.hpp"

#include "materials/law_paths.hpp"

namespace kardan {
namespace {

using law_paths::made;
using law_paths::Point;
using law_paths::points_of;
using law_paths::ShellPointOf;
using law_paths::SolidPoint;

PiecewisePlasticMaterial steel() {
  PiecewisePlasticMaterial m;
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.points = 8;
  m.strain = {0, 0.002, 0.01, 0.03, 0.08, 0.2, 0.5, 1.0};
  m.stress = {0.25, 0.30, 0.36, 0.42, 0.47, 0.52, 0.58, 0.60};
  return m;
}

Curve curve(std::vector<double> x, std::vector<double> y) {
  Curve c;
  c.x = std::move(x);
  c.y = std::move(y);
  return c;
}

class RatePlasticLaw : public ::testing::Test {
 protected:
  RatePlasticLaw() {
    const PiecewisePlasticMaterial m = steel();
    std::vector<double> x(m.strain.begin(), m.strain.end()), low(m.stress.begin(), m.stress.end()), high = low;
    for (std::size_t i = 0; i < x.size(); ++i) high[i] = 1.3 * low[i] + 0.05 * x[i];
    model_.curves = {curve(x, low), curve(x, high), curve({0, 0.1, 0.4}, {0.6, 0.8, 0.7}),
                     curve({0, 0.05, 0.2, 0.5}, {0.25, 0.4, 0.3, 0.1}), curve({0.5, 3, 40}, {1, 1.5, 1.6})};
    Table linear, logarithmic;
    linear.parameter = {0.1, 2, 50};
    for (const double rate : linear.parameter) logarithmic.parameter.push_back(std::log(rate));
    linear.curve = logarithmic.curve = {0, 1, 2};
    model_.tables = {linear, logarithmic};
  }
  RatePlastic law(const PiecewisePlasticMaterial& m) { return made<RatePlastic>(m, model_, kept_); }
  RatePlastic law(const std::function<void(PiecewisePlasticMaterial&)>& change) {
    PiecewisePlasticMaterial m = steel();
    change(m);
    return law(m);
  }

  Model model_;
  std::vector<std::shared_ptr<std::vector<double>>> kept_;
};

using M = PiecewisePlasticMaterial;

TEST_F(RatePlasticLaw, FollowsTheOracleForEveryFormOfTheYieldStress) {
  const auto factor = [](M& m, int vp) {
    m.rate_constant = 40;
    m.rate_exponent = 5;
    m.formulation = vp;
  };
  const std::map<std::string, law_paths::Make> laws{
      {"softening", points_of(law([](M& m) { m.curve = 3; }))},
      {"table", points_of(law([](M& m) { m.table = 0; }))},
      {"table_log", points_of(law([](M& m) { m.table = 1; }))},
      {"table_vp", points_of(law([](M& m) { m.table = 0, m.formulation = 1; }))},
      {"table_log_vp", points_of(law([](M& m) { m.table = 1, m.formulation = 1; }))},
      {"factor_plastic", points_of(law([&](M& m) { factor(m, 1); }))},
      {"factor_added", points_of(law([&](M& m) { factor(m, 1), m.yield_stress = 0.25; }))},
      {"factor_deviatoric", points_of(law([&](M& m) { factor(m, -1); }))},
      {"factor_filtered", points_of(law([&](M& m) { factor(m, 3), m.filter = 0.8; }))},
      {"factor_curve", points_of(law([](M& m) { m.rate_curve = 4; }))},
      {"factor_curve_vp", points_of(law([](M& m) { m.rate_curve = 4, m.formulation = 1; }))}};
  law_paths::follow("j2_metals.csv", laws, 1e-3, 0.25, 1e-8);
}

/// Without rates and failure it is the plain law of MAT_024, by another return mapping.
TEST_F(RatePlasticLaw, IsThePlainLawWhereNothingMoreIsAsked) {
  const PiecewisePlastic plain = made<PiecewisePlastic>(steel(), model_, kept_);
  ShellPointOf<PiecewisePlastic> a(plain, 5.0 / 6);
  ShellPointOf<RatePlastic> b(law(steel()), 5.0 / 6);
  for (int i = 0; i < 300; ++i) {
    const law_paths::Six d{4e-3 * std::sin(i), 2e-3 * std::cos(2 * i), 0, 3e-3 * std::sin(3 * i), 1e-3, 2e-4 * i * std::cos(i)};
    const auto x = a.step(d, 1e-3, 0.01), y = b.step(d, 1e-3, 0.0);
    for (std::size_t k = 0; k < 6; ++k) ASSERT_NEAR(x.stress[k], y.stress[k], 1e-9) << i;
    ASSERT_NEAR(x.thickness_strain, y.thickness_strain, 1e-11) << i;
    ASSERT_NEAR(a.plastic_strain(), b.plastic_strain(), 1e-9) << i;
  }
  EXPECT_GT(b.plastic_strain(), 0.3);
}

TEST_F(RatePlasticLaw, ALaneDoesNotFeelItsNeighbours) {
  const RatePlastic metal = law([](M& m) { m.table = 1, m.formulation = 1; });
  SolidPoint<RatePlastic> a(metal), b(metal);
  ShellPointOf<RatePlastic> c(metal), d(metal);
  for (int i = 0; i < 40; ++i) {
    const law_paths::Six e{3e-3 * std::sin(i), 2e-3 * std::cos(2 * i), -1e-3 * std::sin(i), 1e-3, 0, 1e-4 * i};
    ASSERT_EQ(a.step(e, 1e-3, 0).stress, b.step(e, 1e-3, 0.05 * std::sin(3 * i)).stress) << i;
    ASSERT_EQ(c.step(e, 1e-3, 0).stress, d.step(e, 1e-3, 0.05 * std::sin(3 * i)).stress) << i;
  }
  EXPECT_EQ(a.plastic_strain(), b.plastic_strain());
  EXPECT_EQ(c.plastic_strain(), d.plastic_strain());
  EXPECT_GT(c.plastic_strain(), 0.01);
}

/// A yield stress that drops more steeply than the elastic unloading: the step ends on the curve, does positive work, and stays bounded.
TEST_F(RatePlasticLaw, ACurveThatBreaksDownEndsOnTheYieldSurface) {
  model_.curves.push_back(curve({0, 0.02, 0.0201, 0.3}, {0.4, 0.5, 0.0, 0.0}));
  const RatePlastic metal = law([](M& m) { m.curve = 5; });
  SolidPoint<RatePlastic> solid(metal);
  ShellPointOf<RatePlastic> shell(metal);
  for (Point* p : {static_cast<Point*>(&solid), static_cast<Point*>(&shell)}) {
    for (int i = 0; i < 200; ++i) {
      const double before = p->plastic_strain();
      const auto s = p->step({0, 0, 0, 4e-4, 0, 0}, 1e-3, 0).stress;
      ASSERT_GE(p->plastic_strain(), before);
      const double yield = model_.curves[5].value(p->plastic_strain());
      ASSERT_LE(std::abs(s[3]) * std::sqrt(3.0), yield + 1e-10) << i;
    }
    EXPECT_GT(p->plastic_strain(), 0.04);
    EXPECT_NEAR(p->last().stress[3], 0, 1e-10);
  }
}

TEST_F(RatePlasticLaw, FailsWhereThePlasticStrainReachesFail) {
  ShellPointOf<RatePlastic> p(law([](M& m) { m.failure_strain = 0.05; }));
  while (!p.last().failed && p.plastic_strain() < 1) p.step({0, 0, 0, 1e-3, 0, 0}, 1e-3, 0);
  EXPECT_GE(p.plastic_strain(), 0.05);
  EXPECT_LT(p.plastic_strain(), 0.05 + 1e-3);
}

TEST_F(RatePlasticLaw, IsTakenWhereTheFastLawDoesNotDoWhatIsAsked) {
  const auto fast = [&](const std::function<void(M&)>& change) {
    PiecewisePlasticMaterial m = steel();
    change(m);
    return PiecewisePlastic::computes(m, model_.curves);
  };
  EXPECT_TRUE(fast([](M&) {}));
  EXPECT_TRUE(fast([](M& m) { m.rate_constant = 40, m.rate_exponent = 5; }));
  EXPECT_FALSE(fast([](M& m) { m.failure_strain = 0.3; }));
  EXPECT_FALSE(fast([](M& m) { m.smallest_step = 1e-7; }));
  EXPECT_FALSE(fast([](M& m) { m.table = 0; }));
  EXPECT_FALSE(fast([](M& m) { m.rate_curve = 4; }));
  EXPECT_FALSE(fast([](M& m) { m.formulation = 1; }));
  EXPECT_FALSE(fast([](M& m) { m.curve = 3; }));                                // falls
  EXPECT_FALSE(fast([](M& m) { m.stress = {0.2, 0.2, 0.7, 9, 9, 9, 9, 9}; }));  // steepens
}

TEST_F(RatePlasticLaw, RefusesWhatHasNoYieldStress) {
  const auto complaint = [&](const std::function<void(M&)>& change) {
    PiecewisePlasticMaterial m = steel();
    change(m);
    return law_paths::complaint<RatePlastic>(m, model_);
  };
  EXPECT_NE(complaint([](M& m) { m.stress[0] = 0; }).find("material 7 has the yield stress 0.0"), std::string::npos);
  EXPECT_NE(complaint([](M& m) { m.stress[5] = -0.1; }).find("-0.1"), std::string::npos);
  EXPECT_NE(complaint([](M& m) { m.points = 0, m.yield_stress = 0.2, m.tangent_modulus = 210; }).find("ETAN"), std::string::npos);
  model_.tables[0].parameter[1] = model_.tables[0].parameter[0];
  EXPECT_NE(complaint([](M& m) { m.table = 0; }).find("two curves for one strain rate"), std::string::npos);
}

}  // namespace
}  // namespace kardan

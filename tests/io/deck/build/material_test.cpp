#include <unistd.h>

#include "io/deck/build/build_fixture.hpp"

#include <filesystem>
#include <fstream>

#include "kardan/io/deck/load.hpp"

namespace kardan::deck {
namespace {

const PiecewisePlasticMaterial& plastic(const Built& d) { return std::get<PiecewisePlasticMaterial>(d.model.materials.at(0).law); }

TEST(BuildMaterial, PiecewiseLinearPlasticityWithPointsAndRate) {
  const Built d("*MAT_PIECEWISE_LINEAR_PLASTICITY\n5,7.8e-6,210,.3,.25,2.,1e21\n40,5\n0,.1,.2\n.25,.3,.33\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_TRUE(d.model.unsupported.empty()) << d.messages();
  const auto& m = plastic(d);
  EXPECT_EQ(m.density, 7.8e-6);
  EXPECT_EQ(m.youngs_modulus, 210);
  EXPECT_EQ(m.poissons_ratio, 0.3);
  EXPECT_EQ(m.yield_stress, 0.25);
  EXPECT_EQ(m.tangent_modulus, 2);
  EXPECT_EQ(m.rate_constant, 40);
  EXPECT_EQ(m.rate_exponent, 5);
  EXPECT_EQ(m.curve, none);
  ASSERT_EQ(m.points, 3);
  EXPECT_EQ(m.strain[2], 0.2);
  EXPECT_EQ(m.stress[2], 0.33);
}

TEST(BuildMaterial, PiecewiseLinearPlasticityTakesTheCurveBeforeThePoints) {
  const Built d("*DEFINE_CURVE\n9\n0,.2\n1,.4\n*MAT_024\n5,7.8e-6,210,.3\n0,0,9\n0,.1\n.25,.3\n*MAT_024\n6,7.8e-6,210,.3,.25\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_EQ(plastic(d).curve, 0);
  EXPECT_EQ(plastic(d).points, 0);
  EXPECT_EQ(std::get<PiecewisePlasticMaterial>(d.model.materials.at(1).law).yield_stress, 0.25);
}

TEST(BuildMaterial, PiecewiseLinearPlasticityRefusesWhatItDoesNotCompute) {
  const auto refused = [](const std::string& cards, const char* field) {
    const Built d("*DEFINE_CURVE\n9\n0,.2\n1,.4\n*DEFINE_TABLE\n8\n1.,9\n2.,9\n*MAT_024\n" + cards);
    const Diagnostic* u = d.unsupported("not available");
    ASSERT_NE(u, nullptr) << d.messages();
    EXPECT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
    EXPECT_NE(to_string(*u).find(field), std::string::npos) << to_string(*u);
    EXPECT_NE(to_string(*u).find("deck.k:"), std::string::npos) << to_string(*u);
  };
  refused("5,7.8e-6,210,.3,.25,0,-1\n", "FAIL");
  refused("5,7.8e-6,210,.3,.25\n40,5,9,9\n", "LCSR");
  refused("5,7.8e-6,210,.3,.25\n40,5,0,0,2.\n", "VP");
}

TEST(BuildMaterial, PiecewiseLinearPlasticityWithRatesAndFailure) {
  const Built d(
      "*DEFINE_CURVE\n9\n0,.2\n1,.4\n*DEFINE_TABLE\n8\n1.,9\n2.,9\n"
      "*MAT_024\n5,7.8e-6,210,.3,.25,0,.3,1e-7\n0,0,8,0,1.\n"
      "*MAT_024\n6,7.8e-6,210,.3,.25\n0,0,9,9,3.,0,.8\n"
      "*MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY\n7,7.8e-6,210,.3,.25\n40,5,9,0,0,.1,.2,-60\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_TRUE(d.model.unsupported.empty()) << d.messages();
  const auto material = [&](std::size_t i) { return std::get<PiecewisePlasticMaterial>(d.model.materials.at(i).law); };
  EXPECT_EQ(material(0).failure_strain, 0.3);
  EXPECT_EQ(material(0).smallest_step, 1e-7);
  EXPECT_EQ(material(0).table, 0);
  EXPECT_EQ(material(0).curve, none);
  EXPECT_EQ(material(0).formulation, 1);
  EXPECT_EQ(material(1).rate_curve, 0);
  EXPECT_EQ(material(1).formulation, 3);
  EXPECT_EQ(material(1).filter, 0.8);
  EXPECT_TRUE(material(2).modified);
  EXPECT_EQ(material(2).thinning, 0.1);
  EXPECT_EQ(material(2).major_strain, 0.2);
  EXPECT_EQ(material(2).failing_points, -60);
}

TEST(BuildMaterial, PiecewiseLinearPlasticityChecksItsPoints) {
  const Built falling("*MAT_024\n5,7.8e-6,210,.3,.25\n\n0,.1,.05\n.2,.3,.4\n");
  EXPECT_NE(falling.error("expected plastic strains that ascend"), nullptr) << falling.messages();
  const Built unused("*MAT_024\n5,7.8e-6,210,.3,.25\n\n\n.2,.3,.4\n");
  EXPECT_NE(unused.warning("SIGY and ETAN are taken"), nullptr) << unused.messages();
  const Built unknown("*MAT_024\n5,7.8e-6,210,.3,.25\n0,0,77\n");
  EXPECT_NE(unknown.error("77"), nullptr) << unknown.messages();
}

const FieldMaterial& by_fields(const Built& d, std::size_t i = 0) { return std::get<FieldMaterial>(d.model.materials.at(i).law); }

TEST(BuildMaterial, OgdenWithConstantsAndPronySeries) {
  const Built d("*MAT_OGDEN_RUBBER\n5,1e-6,.499\n.63,.0012,-.01\n1.3,5.,-2.\n.2,30.\n.1,.5\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  const FieldMaterial& m = by_fields(d);
  EXPECT_EQ(m.number, 77);
  EXPECT_EQ(m.variant, 'O');
  EXPECT_EQ(m.density, 1e-6);
  EXPECT_EQ(m.value("mu3"), -.01);
  EXPECT_EQ(m.value("alpha2"), 5);
  EXPECT_EQ(m.value("g1"), .2);
  EXPECT_EQ(m.value("beta2"), .5);
  EXPECT_FALSE(m.values.contains("g3"));
}

TEST(BuildMaterial, HyperelasticRubberReadsTheTestWhereNIsGiven) {
  const Built d("*DEFINE_CURVE\n9\n0,0\n1,.4\n*MAT_077_H\n5,1e-6,.499,2\n25.,6.,2.,9\n.2,30.\n*MAT_077_H\n6,1e-6,.499\n.5,.1,0,.02\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_EQ(by_fields(d).value("sgl"), 25);
  EXPECT_EQ(by_fields(d).curve("lcid1"), 0);
  EXPECT_EQ(by_fields(d).value("g1"), .2);
  EXPECT_EQ(by_fields(d).value("c10"), 0);
  EXPECT_EQ(by_fields(d, 1).value("c10"), .5);
  EXPECT_EQ(by_fields(d, 1).value("c20"), .02);
}

TEST(BuildMaterial, AddErosionTakesWhatDiffersFromExcl) {
  const std::string steel = "*MAT_ELASTIC\n5,7.8e-6,210,.3\n";
  const Built d("*MAT_ADD_EROSION\n5,0,0,0,-.2,-.1,-50,2\n-3.,1.,0,.3,0,2.,5.,.7\n0\n0,0,.4\n0,0,0,1e-7\n" + steel);
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_TRUE(d.model.unsupported.empty()) << d.messages();
  ASSERT_TRUE(d.model.materials.at(0).erosion);
  const ErosionCriteria& e = *d.model.materials[0].erosion;
  constexpr double never = ErosionCriteria::never;
  EXPECT_EQ(e.max_pressure, never);
  EXPECT_EQ(e.min_strain, -never);
  EXPECT_EQ(e.effective_strain, never);
  EXPECT_EQ(e.plastic_strain, 0.2);
  EXPECT_EQ(e.compaction, -0.1);
  EXPECT_EQ(e.expansion, never);
  EXPECT_EQ(e.failing_points, -50);
  EXPECT_EQ(e.needed, 2);
  EXPECT_EQ(e.min_pressure, -3);
  EXPECT_EQ(e.principal_stress, 1);
  EXPECT_EQ(e.mises, never);
  EXPECT_EQ(e.max_strain, 0.3);
  EXPECT_EQ(e.shear_strain, never);
  EXPECT_EQ(e.impulse_stress, 2);
  EXPECT_EQ(e.impulse, 5);
  EXPECT_EQ(e.time, 0.7);
  EXPECT_EQ(e.thinning, 0.4);
  EXPECT_EQ(e.smallest_step, 1e-7);
  const Built excluded("*MAT_ADD_EROSION\n5,99\n99,99,99,0.,99,99,99,99\n" + steel);
  ASSERT_TRUE(excluded.model.materials.at(0).erosion) << excluded.messages();
  EXPECT_EQ(excluded.model.materials[0].erosion->max_strain, 0);  // zero is a limit where EXCL is not 0
  EXPECT_EQ(excluded.model.materials[0].erosion->principal_stress, never);
  EXPECT_EQ(excluded.model.materials[0].erosion->max_pressure, never);
}

TEST(BuildMaterial, AddErosionRefusesDamageAndCurves) {
  const auto refused = [](const std::string& cards, const char* field) {
    const Built d("*MAT_ELASTIC\n5,7.8e-6,210,.3\n*MAT_ADD_EROSION\n" + cards);
    const Diagnostic* u = d.unsupported("");
    ASSERT_NE(u, nullptr) << d.messages();
    EXPECT_NE(to_string(*u).find(field), std::string::npos) << to_string(*u);
  };
  refused("5\n\n1\n", "IDAM");
  refused("5\n0,0,-4\n", "SIGVM");
  refused("5\n0,0,0,-4\n", "MXEPS");
  refused("5\n\n\n7\n", "LCFLD");
  refused("5\n\n\n0,0,-.1\n", "EPSTHIN");
  const Built unknown("*MAT_ADD_EROSION\n5\n");
  EXPECT_NE(unknown.error("5"), nullptr) << unknown.messages();
}

/// An include in t, mm, s read into kg, m, s: stress times 1e6, time and strain as they are, c_p of mJ/(t K) times 1e-6.
TEST(BuildMaterial, MetalsAreConvertedToTheMainDecksUnits) {
  const auto folder = std::filesystem::temp_directory_path() / ("kardan_build_metals_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "metals.k") << "*KEYWORD\n*MAT_JOHNSON_COOK\n1,7.8e-9,8.1e4,2.1e5,.3,1e-7\n300.,400.,.26,.05,1.,1800.,293.,.2\n"
                                        "4.5e8,-900.,1.\n0,0,0,0,2\n*MAT_098\n2,7.8e-9,2.1e5,.3,1\n300.,400.,.26,.05\n"
                                        "*MAT_018\n3,7.8e-9,2.1e5,.3,600.,.2,40.,5.\n300.,.4\n*MAT_012\n4,7.8e-9,8.1e4,250.,2000.,1.7e5\n"
                                        "*MAT_ADD_EROSION\n4\n-100.,0,300.,.1,0,20.,500.,.5\n*END\n";
  std::ofstream(folder / "main.k") << "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*INCLUDE_TRANSFORM\nmetals.k\n\n\n1000.,1.,.001\n\n*END\n";
  Diagnostics diagnostics;
  const Model m = load_model(folder / "main.k", {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.all()[0].message;
  const auto fields = [&](std::size_t i) { return std::get<FieldMaterial>(m.materials.at(i).law); };
  const auto near = [&](std::size_t i, const char* field, double expected) {
    EXPECT_NEAR(fields(i).value(field) / expected, 1, 1e-12) << field;
  };
  EXPECT_EQ(fields(0).number, 15);
  EXPECT_NEAR(fields(0).density, 7800, 1e-9);
  near(0, "g", 8.1e10), near(0, "dtf", 1e-7), near(0, "a", 3e8), near(0, "b", 4e8), near(0, "n", .26), near(0, "tm", 1800);
  near(0, "epso", .2), near(0, "cp", 450), near(0, "pc", -9e8), near(0, "spall", 1), near(0, "numint", 2);
  EXPECT_EQ(fields(1).number, 98);
  near(1, "a", 3e8), near(1, "vp", 1), near(1, "psfail", 1e17), near(1, "epso", 1);
  EXPECT_GT(fields(1).value("sigsat"), 1e20);
  EXPECT_EQ(fields(2).number, 18);
  near(2, "k", 6e8), near(2, "n", .2), near(2, "src", 40), near(2, "sigy", 3e8), near(2, "epsf", .4);
  EXPECT_EQ(fields(3).number, 12);
  near(3, "g", 8.1e10), near(3, "sigy", 2.5e8), near(3, "etan", 2e9), near(3, "bulk", 1.7e11);
  const ErosionCriteria& e = m.materials[3].erosion.value();
  EXPECT_NEAR(e.min_pressure, -1e8, 1e-4);
  EXPECT_NEAR(e.mises, 3e8, 1e-4);
  EXPECT_EQ(e.max_strain, .1);
  EXPECT_NEAR(e.impulse_stress, 2e7, 1e-5);
  EXPECT_NEAR(e.impulse, 500e12, 1);
  EXPECT_EQ(e.time, .5);
  std::filesystem::remove_all(folder);
}

/// mm, t, s to m, kg, s: stresses 1e6, lengths 1e-3, rates as they are.
TEST(BuildMaterial, RubbersAreConvertedToTheMainDecksUnits) {
  const auto folder = std::filesystem::temp_directory_path() / ("kardan_build_rubbers_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rubbers.k") << "*KEYWORD\n*MAT_BLATZ-KO_RUBBER\n1,1e-9,1.5\n*MAT_MOONEY-RIVLIN_RUBBER\n2,1e-9,.495,.8,.2\n25.,6.,2.,0\n"
                                         "*MAT_FRAZER_NASH_RUBBER_MODEL\n3,1e-9,.495,1.,.2,.3,.4\n.5,.6,-.7,.8,1.\n25.,6.,2.,0\n"
                                         "*MAT_HYPERELASTIC_RUBBER\n4,1e-9,.495\n.5,.2,.1,.05,.01,.002\n.4,30.\n"
                                         "*MAT_OGDEN_RUBBER\n5,1e-9,.495\n.6,-.01\n1.3,-2.\n.4,30.\n*END\n";
  std::ofstream(folder / "main.k") << "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*INCLUDE_TRANSFORM\nrubbers.k\n\n\n1000.,1.,.001\n\n*END\n";
  Diagnostics diagnostics;
  const Model m = load_model(folder / "main.k", {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.all()[0].message;
  const auto near = [&](std::size_t i, const char* field, double expected) {
    EXPECT_NEAR(std::get<FieldMaterial>(m.materials.at(i).law).value(field) / expected, 1, 1e-12) << i << field;
  };
  for (std::size_t i = 0; i < 5; ++i) near(i, "ro", 1000);
  near(0, "g", 1.5e6);
  near(1, "a", .8e6), near(1, "b", .2e6), near(1, "sgl", .025), near(1, "sw", .006), near(1, "st", .002), near(1, "pr", .495);
  near(2, "c100", 1e6), near(2, "c400", .4e6), near(2, "c110", .5e6), near(2, "c010", -.7e6), near(2, "c020", .8e6), near(2, "exit", 1), near(2, "sgl", .025);
  near(3, "c10", .5e6), near(3, "c30", 2e3), near(3, "g1", .4e6), near(3, "beta1", 30);
  near(4, "mu1", .6e6), near(4, "alpha1", 1.3), near(4, "mu2", -1e4), near(4, "alpha2", -2), near(4, "g1", .4e6), near(4, "beta1", 30);
}

TEST(BuildMaterial, EquationsOfStateAreNamedByTheirParts) {
  const Built d(two_blocks + "*MAT_NULL\n5,8.93,-1.5,.1\n*EOS_GRUNEISEN\n7,3.94,1.489,.02,.01,2.02,.47,.5\n1.\n*EOS_LINEAR_POLYNOMIAL\n8,.1,.2,.3,.4,.5,.6,.7\n2.5,1.\n"
                "*PART\nfluid\n9,1,5,8\n");
  ASSERT_EQ(d.diagnostics.error_count(), 0u) << d.messages();
  EXPECT_TRUE(d.model.unsupported.empty()) << d.messages();
  ASSERT_EQ(d.model.equations_of_state.size(), 2u);
  const EquationOfState &g = d.model.equations_of_state[0], &p = d.model.equations_of_state[1];
  EXPECT_EQ(g.form, EquationOfState::Form::gruneisen);
  EXPECT_EQ(g.constants[5], .47);
  EXPECT_EQ(g.initial_energy, .5);
  EXPECT_EQ(g.initial_volume, 1);
  EXPECT_EQ(p.constants[6], .7);
  EXPECT_EQ(p.initial_energy, 2.5);
  EXPECT_EQ(d.model.parts[0].equation_of_state, none);
  EXPECT_EQ(d.model.parts[2].equation_of_state, 1);
  EXPECT_EQ(by_fields(d, 1).value("pc"), -1.5);
  const Built lost(two_blocks + "*MAT_NULL\n5,8.93\n*PART\nfluid\n9,1,5,8\n");
  EXPECT_NE(lost.error("equation of state 8"), nullptr) << lost.messages();
}

}  // namespace
}  // namespace kardan::deck

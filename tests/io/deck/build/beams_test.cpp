// *ELEMENT_BEAM, *SECTION_BEAM and the materials of beams.
#include "build_fixture.hpp"

#include "kardan/model/beam_sections.hpp"

namespace kardan::deck {
namespace {

const std::string nodes = "*NODE\n1,0,0,0\n2,2,0,0\n3,0,1,0\n*MAT_ELASTIC\n7,2.0,100,0.3\n*PART\np\n5,6,7\n";

TEST(BuildBeams, SectionsOfEveryFormulation) {
  const Built integrated(nodes + "*SECTION_BEAM\n6,1,0.8333,3.0,1.0\n.4,.4,.2,.2\n*ELEMENT_BEAM\n1,5,1,2,3");
  ASSERT_TRUE(integrated.diagnostics.ok()) << integrated.messages();
  const BeamSection& tube = integrated.model.sections[0].beam;
  EXPECT_EQ(tube.rule, 3);
  EXPECT_EQ(tube.cst, 1);
  EXPECT_EQ(tube.tt[1], .2);
  EXPECT_TRUE(integrated.model.unsupported.empty());

  const Built resultant(nodes + "*SECTION_BEAM\n6,2\n.1,.2,.3,.4,.05,0,0,.06\n*ELEMENT_BEAM\n1,5,1,2,3");
  const BeamSection& r = resultant.model.sections[0].beam;
  EXPECT_EQ((std::array{r.area, r.iss, r.itt, r.j, r.shear_s, r.shear_t}), (std::array{.1, .2, .3, .4, .05, .06}));
  EXPECT_TRUE(resultant.model.unsupported.empty());

  const Built discrete(nodes + "*SECTION_BEAM\n6,6,,,,-2.0\n.1,.2,0,.3,.4\n*ELEMENT_BEAM\n1,5,1,2,3");
  const BeamSection& d = discrete.model.sections[0].beam;
  EXPECT_EQ(d.scoor, -2);
  EXPECT_EQ((std::array{d.volume, d.inertia, d.cable_area, d.cable_offset}), (std::array{.1, .2, .3, .4}));

  const Built weld(nodes + "*SECTION_BEAM\n6,9,,,1\n.006,.006,0,0,0,,1\n*ELEMENT_BEAM\n1,5,1,2,3");
  EXPECT_TRUE(weld.model.sections[0].beam.twists_freely);
  EXPECT_EQ(weld.model.sections[0].beam.tt[0], 0);
}

TEST(BuildBeams, WhatASectionCannotHaveStopsARun) {
  const auto refused = [](const std::string& section) {
    const Built b(nodes + "*SECTION_BEAM\n" + section + "\n*ELEMENT_BEAM\n1,5,1,2,3");
    return b.model.unsupported.size();
  };
  EXPECT_EQ(refused("6,1\n.1,.1,.1,.1"), 0u);
  EXPECT_EQ(refused("6,1,,-3\n.1,.1,.1,.1"), 1u);
  EXPECT_EQ(refused("6,1\n.1,.1,.1,.1,1"), 1u);
  EXPECT_EQ(refused("6,1\n.1,.1,.1,.1,,,-1"), 1u);
  EXPECT_EQ(refused("6,2\n.1,.1,.1,.1,,.01"), 1u);
  EXPECT_EQ(refused("6,3\n.1,0,5.0"), 1u);
  EXPECT_EQ(refused("6,6\n.1,-2"), 1u);
  EXPECT_EQ(refused("6,6\n.1,.1,,,,1"), 1u);
  const Built released(nodes + "*SECTION_BEAM\n6,1\n.1,.1,.1,.1\n*ELEMENT_BEAM\n1,5,1,2,3,0,7");
  EXPECT_EQ(released.model.unsupported.size(), 1u);
}

TEST(BuildBeams, OptionsOfTheElementInTheirOrder) {
  const Built b(nodes +
                "*SECTION_BEAM\n6,2\n.1,.2,.3,.4\n*ELEMENT_BEAM_THICKNESS_ORIENTATION\n1,5,1,2\n.5,0,.6\n0,1,2\n"
                "*ELEMENT_BEAM_PID_ORIENTATION\n2,5,1,2\n5,5\n1,1,0\n*ELEMENT_BEAM\n3,5,1,2,3");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.beams.size(), 3u);
  EXPECT_EQ(b.model.beams.orientation.at(0), (Vec3{0, 1, 2}));
  EXPECT_EQ(b.model.beams.orientation.at(1), (Vec3{1, 1, 0}));
  EXPECT_EQ(b.model.beams.nodes[2][2], 2);
  const BeamSection own = beam_section(b.model, 0), common = beam_section(b.model, 1);
  EXPECT_EQ((std::array{own.area, own.iss, own.itt}), (std::array{.5, .2, .6}));
  EXPECT_EQ((std::array{common.area, common.iss, common.itt}), (std::array{.1, .2, .3}));
}

TEST(BuildBeams, OtherKindsOfBeamsAreRefusedByName) {
  for (const char* keyword : {"*ELEMENT_BEAM_PULLEY", "*ELEMENT_BEAM_SECTION", "*ELEMENT_BEAM_OFFSET", "*ELEMENT_BEAM_SCALAR",
                              "*INITIAL_AXIAL_FORCE_BEAM", "*INTEGRATION_BEAM"}) {
    const Built b(nodes + "*SECTION_BEAM\n6,1\n.1,.1,.1,.1\n" + keyword + "\n1,5,1,2,3\n1,1");
    EXPECT_FALSE(b.model.unsupported.empty() && b.diagnostics.ok()) << keyword;
  }
}

TEST(BuildBeams, MaterialsByTheirFields) {
  const Built b(nodes +
                "*DEFINE_CURVE\n9\n0,0\n1,1\n*SECTION_BEAM\n6,6\n.1,.2\n*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n8,1.0,1,2,3,4,5,6\n.1,.2,.3\n7,8,9\n"
                "*MAT_067\n10,1.0,9,0,9\n\n\n3,4\n*MAT_CABLE_DISCRETE_BEAM\n11,1.0,5.0,9,2.0\n*MAT_SPOTWELD\n12,1,2,.3,4,5,0,6\n.1,.2,.3\n"
                "*ELEMENT_BEAM\n1,5,1,2,3");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto of = [&](std::size_t i) { return std::get<FieldMaterial>(b.model.materials.at(i).law); };
  EXPECT_EQ(of(1).number, 66);
  EXPECT_EQ(of(1).value("rkt"), 6);
  EXPECT_EQ(of(1).value("tdt"), .3);
  EXPECT_EQ(of(1).value("fot"), 9);
  EXPECT_EQ(of(2).number, 67);
  EXPECT_EQ(of(2).curve("lcidtt"), 0);
  EXPECT_EQ(of(2).curve("lcidts"), none);
  EXPECT_EQ(of(2).value("ffails"), 4);
  EXPECT_EQ(of(3).curve("lcid"), 0);
  EXPECT_EQ(of(3).value("f0"), 2);
  EXPECT_EQ(of(4).number, 100);
  EXPECT_EQ(of(4).value("tfail"), 6);
  EXPECT_EQ(of(4).value("nrs"), .3);
}

}  // namespace
}  // namespace kardan::deck

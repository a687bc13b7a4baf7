// *DATABASE_CROSS_SECTION.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

/// Four shells of unit squares in a row along x, nodes 1-5 below and 11-15 above.
const std::string strip = R"(*NODE
1,0,0,0
2,1,0,0
3,2,0,0
4,3,0,0
5,4,0,0
11,0,1,0
12,1,1,0
13,2,1,0
14,3,1,0
15,4,1,0
*PART
strip
1,1,1
*SECTION_SHELL
1,2
1.,1.,1.,1.
*MAT_ELASTIC
1,1.,1.,.3
*ELEMENT_SHELL
1,1,1,2,12,11
2,1,2,3,13,12
3,1,3,4,14,13
4,1,4,5,15,14
*SET_NODE
7
13,3
*SET_SHELL
8
2
)";

const std::vector<Index>& shells(const CrossSection& s) { return s.elements[static_cast<std::size_t>(ElementKind::shell)]; }

TEST(BuildCrossSection, PlaneTakesTheCutElementsAndTheirNodesOnTheHeadsSide) {
  const Built b(strip +
                "*DATABASE_CROSS_SECTION_PLANE_ID\n5,middle\n0,1.4,0,0,2.4,0,0\n\n"
                "*DATABASE_CROSS_SECTION_PLANE\n0,3.5,0,0,2.5,0,0\n3.5,1,0,2.,1.");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.cross_sections.size(), 2u);
  const CrossSection& s = b.model.cross_sections[0];
  EXPECT_EQ(s.id, 5);
  EXPECT_EQ(s.title, "middle");
  EXPECT_EQ(shells(s), (std::vector<Index>{1}));
  EXPECT_EQ(s.nodes, (std::vector<NodeIndex>{2, 7}));  // nodes 3 and 13
  // The rectangle spans y from 0 to 2 and z from -1 (normal x edge) to 0; its normal points to -x.
  EXPECT_EQ(shells(b.model.cross_sections[1]), (std::vector<Index>{3}));
  EXPECT_EQ(b.model.cross_sections[1].nodes, (std::vector<NodeIndex>{3, 8}));
}

TEST(BuildCrossSection, APlaneBesideTheElementsIsSaid) {
  const Built b(strip + "*DATABASE_CROSS_SECTION_PLANE\n0,1.5,5,0,2.5,5,0,1.\n\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_TRUE(b.model.cross_sections[0].nodes.empty());
  EXPECT_NE(b.warning("cuts no deformable element"), nullptr) << b.messages();
}

TEST(BuildCrossSection, Sets) {
  const Built b(strip + "*DATABASE_CROSS_SECTION_SET\n7,0,0,8,0,0,0,0\n*DATABASE_SECFORC\n0.1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const CrossSection& s = b.model.cross_sections.at(0);
  EXPECT_EQ(s.id, 1);
  EXPECT_EQ(s.nodes, (std::vector<NodeIndex>{2, 7}));
  EXPECT_EQ(shells(s), (std::vector<Index>{1}));
  EXPECT_TRUE(b.model.output.requests.contains(OutputFile::secforc));
}

}  // namespace
}  // namespace kardan::deck

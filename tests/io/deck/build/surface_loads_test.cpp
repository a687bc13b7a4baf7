// *LOAD_SEGMENT, *LOAD_SHELL.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string shells = R"(*DEFINE_CURVE
4
0,0
1,5
*PART
plate
5,5,5
*SECTION_SHELL
5,2
.1
*MAT_ELASTIC
5,1.,100.,.3
*ELEMENT_SHELL
7,5,1,2,3,4
8,5,21,22,23
)";

TEST(BuildPressure, SegmentsShellsAndSets) {
  const Built b(two_blocks + shells +
                "*LOAD_SEGMENT_ID\n1,door\n4,2.,.5,1,2,3,4\n2,roof\n4,,,5,6,7\n*SET_SEGMENT\n3\n1,2,3,4\n5,6,7,7\n"
                "*LOAD_SEGMENT_SET\n3,4,-3.\n*LOAD_SHELL_ELEMENT\n7,4\n8,4,2.\n*SET_SHELL\n9\n7,8\n*LOAD_SHELL_SET_ID\n1,all\n9,4,1.,.25");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& p = b.model.pressure_loads;
  ASSERT_EQ(p.size(), 6u);
  EXPECT_EQ(p[0].scale, 2);
  EXPECT_EQ(p[0].arrival, .5);
  EXPECT_EQ(p[1].segments[0][3], p[1].segments[0][2]);
  EXPECT_EQ(p[2].segments.size(), 2u);
  EXPECT_EQ(p[2].scale, -3);
  EXPECT_EQ(p[3].segments[0], b.model.shells.nodes[0]);
  EXPECT_EQ(p[4].segments[0][3], p[4].segments[0][2]);
  EXPECT_EQ(p[5].segments.size(), 2u);
  EXPECT_EQ(p[5].arrival, .25);
  EXPECT_NE(b.warning("t - AT"), nullptr);
}

TEST(BuildPressure, RefusesBlastFunctionsAndSegmentsOfMoreNodes) {
  const Built b(two_blocks + shells + "*LOAD_SEGMENT\n-2,1.,0,1,2,3,4\n4,1.,0,1,2,3,4,5\n,\n*LOAD_SHELL_ELEMENT\n99,4");
  EXPECT_NE(b.unsupported("field LCID: a pressure of a blast function (LCID = -2)"), nullptr) << b.messages();
  EXPECT_NE(b.unsupported("field N5"), nullptr);
  EXPECT_NE(b.error("shell 99 is not defined"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

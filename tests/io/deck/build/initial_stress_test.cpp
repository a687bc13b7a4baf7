// *INITIAL_STRESS_SHELL, _SOLID, _BEAM.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string model = R"(*NODE
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
*PART
shells
1,1,1
*PART
solids
2,2,1
*PART
beams
3,3,1
*SECTION_SHELL
1,2
1.,1.,1.,1.
*SECTION_SOLID
2,1
*SECTION_BEAM
3,2
1.,1.,1.,1.
*MAT_ELASTIC
1,1.,1.,.3
*ELEMENT_SHELL
1,1,1,2,3,4
2,1,5,6,7,8
*ELEMENT_SOLID
1,2,1,2,3,4,5,6,7,8
*ELEMENT_BEAM
1,3,1,2,4
*SET_SHELL
8
1,2
)";

TEST(BuildInitialStress, ShellsSmallAndLarge) {
  const Built b(model + "*INITIAL_STRESS_SHELL\n"
                        "         2         1         2\n"
                        "       -1.        1.        2.        3.        4.        5.        6.       0.1\n"
                        "        1.        7.        8.        9.       10.       11.       12.       0.2\n"
                        "         1         1         1         2         0         1\n"
                        "             0.0              1.              2.              3.              4.\n"
                        "              5.              6.             .25\n"
                        "              0.              0.\n"
                        "*INITIAL_STRESS_SHELL_SET\n"
                        "8,1,1\n"
                        "0.,1.\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.initial_stresses.size(), 3u);
  const InitialStress& small = b.model.initial_stresses[0];
  EXPECT_EQ(small.elements, (std::vector<Index>{1}));
  ASSERT_EQ(small.points.size(), 2u);
  EXPECT_EQ(small.points[1].t, 1.0);
  EXPECT_EQ(small.points[1].stress, (std::array<double, 6>{7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(small.points[1].plastic_strain, 0.2);
  const InitialStress& large = b.model.initial_stresses[1];
  EXPECT_EQ(large.points[0].stress, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(large.points[0].plastic_strain, 0.25);
  EXPECT_FALSE(large.histories);
  EXPECT_EQ(b.model.initial_stresses[2].elements, (std::vector<Index>{0, 1}));
}

TEST(BuildInitialStress, LayersMustBeComplete) {
  const Built b(model + "*INITIAL_STRESS_SHELL\n1,4,1\n0.,1.\n0.,1.\n0.,1.\n.5,1.\n");
  EXPECT_FALSE(b.diagnostics.ok());
}

TEST(BuildInitialStress, SolidsLargeWithHistories) {
  const Built b(model + "*INITIAL_STRESS_SOLID\n"
                        "         1         1         4         1\n"
                        "              1.              2.              3.              4.              5.\n"
                        "              6.             0.5              0.              0.              0.\n"
                        "              9.\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.initial_stresses.size(), 1u);
  EXPECT_EQ(b.model.initial_stresses[0].points[0].stress, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(b.model.initial_stresses[0].histories);
}

TEST(BuildInitialStress, InitialVolumesAreRefusedAndUnknownElementsNamed) {
  EXPECT_FALSE(Built(model + "*INITIAL_STRESS_SOLID\n1,1,0,0,1\n1.,2.\n").model.unsupported.empty());
  EXPECT_FALSE(Built(model + "*INITIAL_STRESS_SOLID\n77,1\n1.,2.\n").diagnostics.ok());
}

TEST(BuildInitialStress, ResultantsOfBeams) {
  const Built b(model + "*INITIAL_STRESS_BEAM\n1,2,1\n1.,2.,3.,4.,5.,6.\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(b.model.initial_stresses.at(0).resultants, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace kardan::deck

// What a deck says of shells: rules through the thickness, offsets, *CONTROL_SHELL, histories, *DATABASE_EXTENT_BINARY.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string plate = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*PART\np\n5,6,7\n*MAT_ELASTIC\n7,2.0,100,0.3\n";

TEST(BuildShells, RulesThroughTheThickness) {
  const Built b(plate + "*INTEGRATION_SHELL\n3,2,0\n-0.5,0.75\n0.5,0.25\n4,5,1\n*SECTION_SHELL\n6,16,1.0,2,1,-3\n0.5\n8,16,1.0,2,1,-4\n0.5\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_TRUE(b.model.unsupported.empty()) << b.messages();
  ASSERT_EQ(b.model.shell_rules.size(), 2u);
  EXPECT_EQ(b.model.shell_rules[0].s, (std::vector<double>{-0.5, 0.5}));
  EXPECT_EQ(b.model.shell_rules[0].weight, (std::vector<double>{0.75, 0.25}));
  EXPECT_TRUE(b.model.shell_rules[1].equal);
  EXPECT_EQ(b.model.shell_rules[1].points, 5);
  EXPECT_EQ(b.model.sections[0].shell.rule, 0);
  EXPECT_EQ(b.model.sections[1].shell.rule, 1);
  EXPECT_EQ(b.model.sections[0].shell.elform, 16);
  EXPECT_NE(Built(plate + "*SECTION_SHELL\n6,2,1.0,2,1,-9\n0.5\n").error("rule 9 is not defined"), nullptr);
  EXPECT_NE(Built(plate + "*INTEGRATION_SHELL\n3,1\n1.5,1.0\n").error("outside -1 to 1"), nullptr);
  EXPECT_NE(Built(plate + "*INTEGRATION_SHELL\n3,1\n0.5,1.0,17\n").unsupported("layer"), nullptr);
  EXPECT_NE(Built(plate + "*SECTION_SHELL\n6,2,1.0,2,1,2\n0.5\n").unsupported("quadrature rule"), nullptr);
}

TEST(BuildShells, OffsetsAreLengthsAboveTheNodes) {
  const Built b(plate + "*SECTION_SHELL\n6,2\n0.5\n*ELEMENT_SHELL_OFFSET\n1,5,1,2,3,4\n0.125\n*ELEMENT_SHELL_THICKNESS_OFFSET\n2,5,1,2,3,4\n.1,.2,.3,.4\n-0.25\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_TRUE(b.model.unsupported.empty()) << b.messages();
  EXPECT_EQ(b.model.shells.offset.at(0), 0.125);
  EXPECT_EQ(b.model.shells.offset.at(1), -0.25);
  EXPECT_EQ(b.model.shells.thickness.at(1)[3], 0.4);
}

TEST(BuildShells, ControlShell) {
  const Built b("*SECTION_SHELL\n6,0\n0.5\n*CONTROL_SHELL\n,1,,4,16,1\n,1\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const Control& c = b.model.control;
  EXPECT_EQ(c.shell_esort, 1);
  EXPECT_EQ(c.shell_istupd, 4);
  EXPECT_EQ(c.shell_bwc, 1);
  EXPECT_TRUE(c.shell_lobatto);
  EXPECT_EQ(b.model.sections[0].shell.elform, 16);  // THEORY holds for sections without ELFORM, wherever they stand
  EXPECT_NE(Built("*CONTROL_SHELL\n,2\n").unsupported("DKT"), nullptr);
  EXPECT_NE(Built("*CONTROL_SHELL\n\n2.0\n").unsupported("rotary inertia"), nullptr);
  EXPECT_NE(Built("*CONTROL_SHELL\n\n\n7\n").unsupported("some parts only"), nullptr);
}

TEST(BuildShells, HistoriesAndExtent) {
  const Built b(plate + "*SECTION_SHELL\n6,2\n0.5\n*ELEMENT_SHELL\n11,5,1,2,3,4\n12,5,1,2,3,4\n*SET_SHELL_LIST\n4\n12\n"
                "*DATABASE_HISTORY_SHELL\n11\n*DATABASE_HISTORY_SHELL_SET\n4\n*DATABASE_ELOUT\n0.1\n"
                "*DATABASE_EXTENT_BINARY\n0,2,5,1\n*CONTROL_OUTPUT\n\n,,,,,,,2\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(b.model.output.history_shells, (std::vector<Index>{0, 1}));
  EXPECT_EQ(b.model.output.requests.at(OutputFile::elout).dt, 0.1);
  EXPECT_EQ(b.model.output.maxint, 5);
  EXPECT_TRUE(b.model.output.global_shell_axes);
  EXPECT_NE(b.warning("strain tensors are not written"), nullptr);
  EXPECT_NE(b.warning("history variables"), nullptr);
  EXPECT_NE(Built("*DATABASE_HISTORY_SHELL\n77\n").error("77 is not defined"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

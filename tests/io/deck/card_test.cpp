// One line of data: columns, free format, the wider formats, defaults, and what is wrong with a field.
#include "deck_test_tools.hpp"

namespace kardan::deck {
namespace {

using test::Read;

std::string fmt_where(const Diagnostic& d) {
  return std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + " " + d.field;
}

struct Node {
  std::int64_t id, tc, rc;
  double x, y, z;
  bool operator==(const Node&) const = default;
};

std::vector<Node> nodes(const std::string& text) {
  Read read(text);
  std::vector<Node> result;
  for (Block& block : read.deck.blocks)
    block.for_each("card0", [&](const Card& c) {
      result.push_back({c.integer("nid"), c.integer("tc"), c.integer("rc"), c.real("x"), c.real("y"), c.real("z")});
    });
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  return result;
}

const std::vector<Node> expected = {{12, 0, 7, 1.5, -2, 3e-3}};

TEST(Card, FixedColumns) {
  EXPECT_EQ(nodes("*NODE\n      12             1.5             -2.           3.E-3       0       7\n"), expected);
  EXPECT_EQ(nodes("*NODE\n12      1.5             -2.             3.E-3                   7\n"), expected);
}

TEST(Card, NeighboursMayTouch) {
  const auto n = nodes("*NODE\n       1-1.000000000E+00-2.000000000E+00-3.000000000E+00       0       0\n");
  ASSERT_EQ(n.size(), 1u);
  EXPECT_EQ(n[0].y, -2);
}

TEST(Card, FreeFormat) {
  EXPECT_EQ(nodes("*NODE\n12,1.5,-2,3e-3,,7\n"), expected);
  EXPECT_EQ(nodes("*node\n 12 , 1.5 , -2. , 0.003 , 0 , 7 ,\n"), expected);
  EXPECT_EQ(nodes("*NODE\n\t12,\t1.5,-2,3e-3,,7\n"), expected);
}

TEST(Card, WiderFormats) {
  const std::string i10 = "        12             1.5              -2           3.e-3         0         7\n";
  const std::string wide =
      "                  12                 1.5                  -2               3.e-3                   0            "
      "       7\n";
  EXPECT_EQ(nodes("*NODE %\n" + i10), expected);
  EXPECT_EQ(nodes("*NODE%\n" + i10), expected);
  EXPECT_EQ(nodes("*KEYWORD I10=Y\n*NODE\n" + i10), expected);
  EXPECT_EQ(nodes("*NODE +\n" + wide), expected);
  EXPECT_EQ(nodes("*KEYWORD LONG=Y\n*NODE\n" + wide), expected);
  EXPECT_EQ(nodes("*KEYWORD long=y memory=20m\n*NODE\n" + wide), expected);
  const std::string standard = "      12             1.5              -2           3.e-3       0       7\n";
  EXPECT_EQ(nodes("*KEYWORD LONG=S\n*NODE\n" + standard), expected);
  EXPECT_EQ(nodes("*KEYWORD LONG=Y\n*NODE -\n" + standard), expected);
  EXPECT_EQ(nodes("*KEYWORD LONG=Y\n*NODE\n12,1.5,-2,3e-3,,7\n"), expected);
}

TEST(Card, LineEndsCommentsTabsAndMarks) {
  EXPECT_EQ(nodes("$ head\r\n*NODE\r\n$ comment\r\n12,1.5,-2,3e-3,,7\r\n$ tail\r\n*END\r\n"), expected);
  EXPECT_EQ(nodes("\xEF\xBB\xBF*NODE\n12,1.5,-2,3e-3,,7"), expected);
  EXPECT_EQ(nodes("*NODE\n12\t1.5\t\t-2\t\t3e-3\t\t0\t7\n"), expected);
  EXPECT_EQ(nodes("*NODE  \n$ \xC3\xA4\xE9 \xFF\n12,1.5,-2,3e-3,,7\n\n\n"), expected);
  const std::string beyond_80 =
      "      12             1.5              -2           3.e-3       0       7           and a remark behind column "
      "80\n";
  EXPECT_EQ(nodes("*NODE\n" + beyond_80), expected);
}

TEST(Card, EndEndsTheFile) {
  EXPECT_EQ(nodes("*NODE\n12,1.5,-2,3e-3,,7\n*end\n*NODE\n13,0,0,0\n"), expected);
}

TEST(Card, BlankFieldsHaveTheTablesDefaults) {
  Read read(
      "*CONSTRAINED_JOINT_REVOLUTE\n         1         2         3         4\n*BOUNDARY_SPC_SET_BIRTH_DEATH\n1\n0.5\n");
  const Card joint = read.block(0).next("card0");
  EXPECT_EQ(joint.integer("n4"), 4);
  EXPECT_EQ(joint.real("rps"), 1.0);
  EXPECT_EQ(joint.real("damp"), 1.0);
  EXPECT_TRUE(joint.blank("rps"));
  EXPECT_FALSE(joint.blank("n1"));
  read.block(1).next("card0");
  EXPECT_EQ(read.block(1).next("birth_death").real("death"), 1e20);
}

TEST(Card, TitlesAndHeadings) {
  Read read(
      "*PART\nA body, with a comma & more\n         7         1         1\n\n         8         1         1\n"
      "*CONSTRAINED_JOINT_REVOLUTE_ID\n        11left hinge\n1,2,3,4\n*CONSTRAINED_JOINT_REVOLUTE_ID\n12, left, "
      "right\n1,2,3,4\n");
  Block& part = read.block(0);
  EXPECT_EQ(part.next_title(), "A body, with a comma & more");
  EXPECT_EQ(part.next("card0").integer("pid"), 7);
  EXPECT_FALSE(part.at_end());
  EXPECT_EQ(part.next_title(), "");
  EXPECT_EQ(part.next("card0").integer("pid"), 8);
  EXPECT_TRUE(part.at_end());
  Card id = read.block(1).next("id");
  EXPECT_EQ(id.integer("id"), 11);
  EXPECT_EQ(id.text("heading"), "left hinge");
  EXPECT_EQ(read.block(2).next("id").text("heading"), "left, right");
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
}

TEST(Card, HeadingInFixedColumnsMayHoldAComma) {
  Read read("*CONSTRAINED_JOINT_REVOLUTE_ID\n        11hinge, left\n1,2,3,4\n");
  const Card id = read.block(0).next("id");
  EXPECT_EQ(id.integer("id"), 11);
  EXPECT_EQ(id.text("heading"), "hinge, left");
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
}

TEST(Card, BlankCardsCountWithinAnEntryAndNotAtItsEnd) {
  Read read("*MAT_RIGID\n1,7.8e-9,2.1e5,0.3\n\n\n\n\n");
  Block& block = read.block(0);
  block.next("card0");
  EXPECT_TRUE(block.at_end());
  EXPECT_EQ(block.lines_left(), 4u);
  EXPECT_TRUE(block.next("card1").present());
  EXPECT_TRUE(block.next("card2").all_blank());
  EXPECT_TRUE(read.diagnostics.ok());
}

TEST(Card, MissingCardIsAnErrorUnlessOptional) {
  Read read("*MAT_RIGID\n1,7.8e-9,2.1e5,0.3\n");
  Block& block = read.block(0);
  block.next("card0");
  EXPECT_EQ(block.next_optional("card1").real("cmo"), 0);
  EXPECT_TRUE(read.diagnostics.ok());
  EXPECT_FALSE(block.next("card2").present());
  ASSERT_EQ(read.diagnostics.error_count(), 1u);
  EXPECT_EQ(read.diagnostics.all()[0].keyword, "*MAT_RIGID");
  EXPECT_EQ(read.diagnostics.all()[0].where.line, 1);
}

TEST(Card, MalformedFieldsNameEverything) {
  Read read(
      "*KEYWORD\n*CONSTRAINED_JOINT_REVOLUTE_ID\n         1\n$ comment\n         1        2x       3.5         4\n");
  Block& block = read.block(0);
  block.next("id");
  const Card card = block.next("card0");
  EXPECT_EQ(card.integer("n1"), 1);
  EXPECT_EQ(card.integer("n2"), 0);
  EXPECT_EQ(card.integer("n2"), 0);  // asked twice, reported once
  EXPECT_EQ(card.integer("n3"), 0);
  ASSERT_EQ(read.diagnostics.error_count(), 2u);
  EXPECT_EQ(to_string(read.diagnostics.all()[0]),
            "deck.k:5:19: error: *CONSTRAINED_JOINT_REVOLUTE_ID, field N2: found '2x', expected an integer");
  EXPECT_EQ(to_string(read.diagnostics.all()[1]),
            "deck.k:5:28: error: *CONSTRAINED_JOINT_REVOLUTE_ID, field N3: found '3.5', expected an integer");
}

TEST(Card, ShiftedColumnsThatLeaveNoDoubtAreTakenWithAWarning) {
  // The first value is a column too long, as decks of the corpus have it.
  Read read("*CONTROL_TERMINATION\n       10.0         0       0.0       0.01.000000E8         0\n");
  const Card card = read.block(0).next("card0");
  EXPECT_EQ(card.real("endtim"), 10);
  EXPECT_EQ(card.real("dtmin"), 0);
  EXPECT_EQ(card.real("endmas"), 1) << "the exponent lies in the next field";
  EXPECT_EQ(read.diagnostics.warning_count(), 2u) << read.messages();
  EXPECT_TRUE(read.diagnostics.ok());
  Read doubtful("*CONTROL_TERMINATION\n       1 2\n");
  doubtful.block(0).next("card0").real("endtim");
  EXPECT_FALSE(doubtful.diagnostics.ok());
}

TEST(Card, MalformedNumbersInFreeFormat) {
  Read read("*NODE\n1,1.0E,nan,1e999\n99999999999999999999,0,0,0\n1,<1+\n2,0,&,a b\n");
  std::vector<std::string> fields;
  read.block(0).for_each("card0", [](const Card& c) {
    c.integer("nid");
    for (int i = 1; i < 4; ++i) EXPECT_EQ(c.real(i), 0);
  });
  for (const Diagnostic& d : read.diagnostics.all()) fields.push_back(fmt_where(d));
  EXPECT_EQ(fields, (std::vector<std::string>{"2:3 X", "2:8 Y", "2:12 Z", "3:1 NID", "4:3 X", "5:5 Y", "5:7 Z"}));
}

TEST(Card, FiftyErrorsAreKeptAllAreCounted) {
  std::string text = "*NODE\n";
  for (int i = 0; i < 70; ++i) text += "x,0,0,0\n";
  Read read(text);
  read.block(0).for_each("card0", [](const Card& c) { c.integer("nid"); });
  EXPECT_EQ(read.diagnostics.error_count(), 70u);
  EXPECT_EQ(read.diagnostics.all().size(), 50u);
}

}  // namespace
}  // namespace kardan::deck

// What happens to keywords that are unknown, not needed, or stop a run.
#include "deck_test_tools.hpp"

#include <ctime>

namespace kardan::deck {
namespace {

using test::find_message;
using test::Read;

TEST(Keyword, NamesInAnyCaseAndSpelling) {
  Read read("*keyword\n*constrained_joint_revolute_id_local\n*ELEMENT_DISCRETE    \n*Set_Node\n*NODE,\n");
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  ASSERT_EQ(read.deck.blocks.size(), 4u);
  EXPECT_EQ(read.block(0).keyword, "CONSTRAINED_JOINT_REVOLUTE");
  EXPECT_EQ(read.block(0).options, (std::set<std::string>{"ID", "LOCAL"}));
  EXPECT_EQ(read.block(0).as_written(), "*CONSTRAINED_JOINT_REVOLUTE_ID_LOCAL");
  EXPECT_EQ(read.block(1).keyword, "ELEMENT_DISCRETE");
  EXPECT_EQ(read.block(2).keyword, "SET_NODE_LIST");
  EXPECT_EQ(read.block(3).where.line, 5);
}

TEST(Keyword, UnknownIsAnErrorWithAGuess) {
  Read read("*KEYWORD\n*CONSTRAINED_JOINT_REVOLUT\n1,2,3,4\n*CONSTRAINED_JOINT_REVOLUT\n*\n");
  ASSERT_EQ(read.diagnostics.error_count(), 2u) << read.messages();
  const Diagnostic& d = read.diagnostics.all()[0];
  EXPECT_EQ(d.where.line, 2);
  EXPECT_EQ(d.keyword, "*CONSTRAINED_JOINT_REVOLUT");
  EXPECT_EQ(d.cure, "did you mean *CONSTRAINED_JOINT_REVOLUTE?");
}

TEST(Keyword, ThousandsOfUnknownKeywordsTakeNoTime) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "*UNKNOWN_KEYWORD_NUMBER_" + std::to_string(i) + "\n";
  const std::clock_t start = std::clock();
  Read read(text);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 10.0);
  EXPECT_EQ(read.diagnostics.error_count(), 100'000u);
}

TEST(Keyword, UnknownOptionIsAnError) {
  Read read("*CONSTRAINED_JOINT_REVOLUTE_LOKAL\n1,2,3,4\n");
  EXPECT_NE(find_message(read.diagnostics, Severity::error, "*CONSTRAINED_JOINT_REVOLUTE has no option LOKAL"), nullptr)
      << read.messages();
  EXPECT_TRUE(read.deck.blocks.empty());
}

TEST(Keyword, NotNeededIsNamedOnce) {
  Read read("*CONTROL_CPU\n1\n*CONTROL_CPU\n1\n*DATABASE_ATDOUT\n1.0\n");
  EXPECT_TRUE(read.diagnostics.ok());
  EXPECT_EQ(read.diagnostics.all().size(), 2u);
  EXPECT_EQ(read.diagnostics.all()[0].severity, Severity::notice);
  EXPECT_TRUE(read.deck.blocks.empty());
}

TEST(Keyword, ContactStopsUnlessLeftOut) {
  const std::string text =
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE_MORTAR_ID\n1\n*RIGIDWALL_FORCE_TRANSDUCER\n1\n*AIRBAG_SIMPLE_PRESSURE_VOLUME\n1\n*CONTACT_ENTITY\n1\n*END";
  Read refused(text);
  EXPECT_EQ(refused.diagnostics.error_count(), 3u) << refused.messages();
  EXPECT_NE(find_message(refused.diagnostics, Severity::error, "--without contact"), nullptr);
  ReadOptions options;
  options.without = {"contact"};
  Read without(text, options);
  EXPECT_EQ(without.diagnostics.error_count(), 1u) << without.messages();
  EXPECT_EQ(without.diagnostics.warning_count(), 2u) << without.messages();
}

TEST(Keyword, SomeStopOnlyWhenSwitchedOn) {
  EXPECT_TRUE(Read(std::string("*CONTROL_DYNAMIC_RELAXATION\n250,0.001\n")).diagnostics.ok());
  EXPECT_TRUE(Read(std::string("*CONTROL_IMPLICIT_GENERAL\n         0\n")).diagnostics.ok());
  EXPECT_FALSE(Read(std::string("*CONTROL_IMPLICIT_GENERAL\n         1\n")).diagnostics.ok());
  EXPECT_FALSE(Read(std::string("*CONTROL_DAMPING\n,,,,,,,1\n")).diagnostics.ok());
}

TEST(Keyword, CommentBlocksAreSkipped) {
  Read read("*COMMENT\nanything &undefined <1/0>, here\n*NODE\n1,0,0,0\n");
  EXPECT_TRUE(read.diagnostics.ok());
  EXPECT_EQ(read.deck.blocks.size(), 1u);
}

TEST(Keyword, LineNumbersSurviveCommentsAndBlankLines) {
  Read read("$\n$\n*KEYWORD\n\n$\n*NODE\n$ a\n1,0,0,0\n\n$ b\n2,x,0,0\n");
  read.block(0).for_each("card0", [](const Card& c) { c.real("x"); });
  ASSERT_EQ(read.diagnostics.error_count(), 1u);
  EXPECT_EQ(read.diagnostics.all()[0].where.line, 11);
  EXPECT_EQ(read.diagnostics.all()[0].where.column, 3);
}

}  // namespace
}  // namespace kardan::deck

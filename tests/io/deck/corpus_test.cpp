// Every deck of the corpus, and every seed of the fuzzer, is read to its end.
#include "deck_test_tools.hpp"
#include "fuzz/consume.hpp"

#include <algorithm>
#include <vector>

namespace kardan::deck {
namespace {

namespace fs = std::filesystem;
using test::Read;

std::vector<fs::path> decks_below(const fs::path& folder) {
  std::vector<fs::path> decks;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && (entry.path().extension() == ".k" || entry.path().extension() == ".key"))
        decks.push_back(entry.path());
  std::sort(decks.begin(), decks.end());
  return decks;
}

const fs::path corpus = fs::path(KARDAN_SHARED_DIR) / "corpus";

TEST(Corpus, EveryDeckIsReadToItsEnd) {
  const auto decks = decks_below(corpus);
  if (decks.empty()) GTEST_SKIP() << "skipped: corpus not present";
  for (const fs::path& path : decks) {
    Read read(path);
    const std::size_t fields = test::consume(read.deck, read.diagnostics);
    EXPECT_GT(read.deck.bytes, 0u) << path;
    EXPECT_TRUE(fields > 0 || read.deck.blocks.empty()) << path;
    for (const Diagnostic& d : read.diagnostics.all())
      if (d.severity == Severity::error) {
        EXPECT_FALSE(d.message.empty());
        EXPECT_FALSE(d.where.file.empty() && d.keyword.empty()) << to_string(d);
      }
  }
}

TEST(Corpus, KeywordsOfTheBeltedDummyAreUnderstood) {
  const fs::path path = corpus / "belted_dummy/belted_dummy_main.k";
  if (!fs::exists(path)) GTEST_SKIP() << "skipped: corpus not present";
  ReadOptions options;
  options.without = {"contact"};
  Read read(path, options);
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  const auto count = [&](std::string_view keyword) {
    return std::count_if(read.deck.blocks.begin(), read.deck.blocks.end(),
                         [&](const Block& b) { return b.keyword == keyword; });
  };
  EXPECT_EQ(count("CONSTRAINED_JOINT_SPHERICAL"), 14);
  EXPECT_EQ(
      std::count_if(read.deck.blocks.begin(), read.deck.blocks.end(), [](const Block& b) { return b.has("INERTIA"); }),
      15);
  std::size_t springs = 0;
  for (Block& block : read.deck.blocks)
    if (block.keyword == "ELEMENT_DISCRETE") block.for_each("card0", [&](const Card&) { ++springs; });
  EXPECT_EQ(springs, 108u);
}

/// The sections' ELFORM of a fixture of pydyna, which refers to parameters there, and the number of errors.
std::vector<double> section_values(const std::string& fixture, std::size_t errors) {
  Read read(corpus / "pydyna_reader/tests/testfiles/keywords/expand_parameters" / fixture);
  std::vector<double> values;
  for (Block& block : read.deck.blocks)
    while (!block.at_end()) {
      block.next_title();
      values.push_back(block.next("card0").real("elform"));
    }
  EXPECT_EQ(read.diagnostics.error_count(), errors) << fixture << "\n" << read.messages();
  return values;
}

TEST(Corpus, ParametersAcrossIncludes) {
  if (!fs::exists(corpus)) GTEST_SKIP() << "skipped: corpus not present";
  using Values = std::vector<double>;
  EXPECT_EQ(section_values("nonlocal/top.k", 0), (Values{100, 1, 100}));
  EXPECT_EQ(section_values("local/top.k", 1), (Values{200, 999, 200, 1}));
  EXPECT_EQ(section_values("local/sibling_test_top.k", 1), (Values{111, 100, 1, 100}));
  EXPECT_EQ(section_values("sibling/main.k", 0), (Values{5678}));
  EXPECT_EQ(section_values("collision_local/main.k", 0), (Values{1, 2}));
  // Two files define the same global parameter: as *PARAMETER_DUPLICATION says, the first stays and a warning names
  // both.
  EXPECT_EQ(section_values("collision/main_with_consumer.k", 0), (Values{1, 1, 1}));
}

TEST(Corpus, UndefinedParameterIsLocated) {
  const fs::path path = corpus / "pydyna_reader/tests/testfiles/keywords/parameter_error_location/test_comments.k";
  if (!fs::exists(path)) GTEST_SKIP() << "skipped: corpus not present";
  Read read(path);
  Block& block = read.block(1);
  block.next("card0");
  block.next("list").integer("id1");
  ASSERT_EQ(read.diagnostics.error_count(), 1u) << read.messages();
  EXPECT_EQ(read.diagnostics.all()[0].where.line, 8);
  EXPECT_EQ(read.diagnostics.all()[0].keyword, "*SET_NODE_LIST");
}

TEST(Fuzz, SeedsAreReadToTheirEnd) {
  const fs::path folder = fs::path(KARDAN_SOURCE_DIR) / "tests/fuzz/seeds";
  std::size_t seeds = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    ReadOptions options;
    options.confine_to = folder;
    Read read(entry.path(), options);
    test::consume(read.deck, read.diagnostics);
    for (const Diagnostic& d : read.diagnostics.all()) EXPECT_FALSE(to_string(d).empty());
    ++seeds;
  }
  EXPECT_GE(seeds, 14u);
}

}  // namespace
}  // namespace kardan::deck

// Whatever stands under a keyword, the builder answers with messages: no exception, no failed assertion.
#include <random>

#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

std::string random_line(std::mt19937& random) {
  static const std::vector<std::string> lines{"",
                                              "1,1,1,1,1,1,1,1,1,1",
                                              "2,1,2,1,2,1,2,1",
                                              "0,0,0,0,0,0,0,0",
                                              "-1,-2,-3,-4,-5,-6,-7,-8",
                                              "1",
                                              "abc,def,,xyz",
                                              "1e300,-1e300,nan,inf,1e-300",
                                              "9223372036854775807,99999999999999999999,3",
                                              "       1       2       3       4       5       6       7       8",
                                              "         1         2         3         4         5         6",
                                              "PART,1,2",
                                              "BOX,1",
                                              "2,-4,4,1,0,1,0,5",
                                              "1,2,2,-999,1,2,-999,1,2",
                                              "TIME*2+SIN(",
                                              "*SQRT(TIME-5)"};
  return lines[random() % (lines.size() - 1)] + "\n";
}

TEST(BuildGarbage, EveryKeywordWithEveryOptionAnswersWithMessages) {
  std::mt19937 random(20240607);
  std::size_t decks = 0;
  for (const KeywordInfo& info : Schema::instance().keywords()) {
    if (info.status != KeywordStatus::honoured || info.name == "*" || info.name.starts_with("INCLUDE")) continue;
    std::vector<std::string> suffixes{"", "_ID", "_TITLE"};
    for (const std::string& option : info.options) suffixes.push_back("_" + option);
    for (const std::string& suffix : suffixes) {
      for (int round = 0; round < 12; ++round) {
        std::string text =
            two_blocks +
            "*DEFINE_CURVE\n1\n0,0\n1,1\n*DEFINE_BOX\n1,-1,2,-1,2,-1,2\n*SET_NODE\n1\n1,2\n*SET_PART\n1\n1,2\n"
            "*DEFINE_VECTOR\n1,0,0,0,1,0,0\n*DEFINE_COORDINATE_VECTOR\n1,1,0,0,0,1,0\n";
        text += "*" + info.name + suffix + "\n";
        for (int i = round; i > 0; --i) text += random_line(random);
        ASSERT_NO_THROW(Built{text}) << text;
        ++decks;
      }
    }
  }
  EXPECT_GT(decks, 3000u);
}

}  // namespace
}  // namespace kardan::deck

#include "kardan/io/deck/schema.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace kardan::deck {
namespace {

const Schema& schema() {
  return Schema::instance();
}

void expect_match(const char* name, const char* keyword, std::vector<std::string> options) {
  const KeywordMatch match = schema().match(name);
  ASSERT_NE(match.info, nullptr) << name;
  EXPECT_EQ(match.info->name, keyword) << name;
  EXPECT_EQ(match.options, options) << name;
  EXPECT_EQ(match.bad_option, "") << name;
}

TEST(Schema, TakesOptionsOffTheName) {
  expect_match("NODE", "NODE", {});
  expect_match("CONSTRAINED_JOINT_REVOLUTE_ID_LOCAL", "CONSTRAINED_JOINT_REVOLUTE", {"ID", "LOCAL"});
  expect_match("CONSTRAINED_JOINT_COOR_REVOLUTE_LOCAL_FAILURE", "CONSTRAINED_JOINT_COOR_REVOLUTE",
               {"LOCAL", "FAILURE"});
  expect_match("CONSTRAINED_JOINT_ROTATIONAL_MOTOR_ID", "CONSTRAINED_JOINT_ROTATIONAL_MOTOR", {"ID"});
  expect_match("PART_INERTIA_CONTACT", "PART", {"INERTIA", "CONTACT"});
  expect_match("CONSTRAINED_NODAL_RIGID_BODY_SPC_INERTIA", "CONSTRAINED_NODAL_RIGID_BODY", {"SPC", "INERTIA"});
  expect_match("SET_NODE_LIST_GENERATE_INCREMENT_COLLECT_TITLE", "SET_NODE_LIST",
               {"GENERATE_INCREMENT", "COLLECT", "TITLE"});
  expect_match("BOUNDARY_SPC_SET_BIRTH_DEATH_ID", "BOUNDARY_SPC_SET", {"BIRTH_DEATH", "ID"});
  expect_match("BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL", "BOUNDARY_PRESCRIBED_MOTION_RIGID", {"LOCAL"});
  expect_match("PARAMETER_EXPRESSION_LOCAL", "PARAMETER", {"EXPRESSION", "LOCAL"});
}

TEST(Schema, KnowsOtherNames) {
  expect_match("SET_NODE", "SET_NODE_LIST", {});
  expect_match("SET_NODE_TITLE", "SET_NODE_LIST", {"TITLE"});
  expect_match("SET_SHELL_GENERATE", "SET_SHELL_LIST", {"GENERATE"});
  expect_match("MAT_020", "MAT_RIGID", {});
  expect_match("MAT_S04", "MAT_SPRING_NONLINEAR_ELASTIC", {});
  expect_match("CONSTRAINED_JOINT_STIFFNESS_FLEXION_TORSION", "CONSTRAINED_JOINT_STIFFNESS_FLEXION-TORSION", {});
  expect_match("LOAD_NODE", "LOAD_NODE_POINT", {});
}

TEST(Schema, LongestNameWins) {
  expect_match("LOAD_NODE_SET", "LOAD_NODE_SET", {});
  expect_match("DEFINE_CURVE_FUNCTION_TITLE", "DEFINE_CURVE_FUNCTION", {"TITLE"});
  expect_match("SET_SEGMENT_GENERAL", "SET_SEGMENT_GENERAL", {});
}

TEST(Schema, TellsUnknownNamesAndOptions) {
  EXPECT_EQ(schema().match("NODDE").info, nullptr);
  EXPECT_EQ(schema().match("MAT_FOO").info, nullptr);
  EXPECT_EQ(schema().match("").info, nullptr);
  EXPECT_EQ(schema().match("*").info, nullptr);
  EXPECT_EQ(schema().match("_").info, nullptr);
  EXPECT_EQ(schema().match("CONSTRAINED_JOINT_REVOLUTE_LOKAL").bad_option, "LOKAL");
  EXPECT_EQ(schema().match("NODE_").bad_option, schema().match("NODE_X").bad_option.substr(1));
  ASSERT_NE(schema().match("AIRBAG_NEVER_HEARD_OF").info, nullptr);
  EXPECT_EQ(schema().match("AIRBAG_NEVER_HEARD_OF").info->status, KeywordStatus::stops);
  ASSERT_NE(schema().match("FREQUENCY_DOMAIN_FRF").info, nullptr);
}

TEST(Schema, GuessesWhatWasMeant) {
  EXPECT_EQ(schema().nearest("CONSTRAINED_JOINT_REVOLUT"), "CONSTRAINED_JOINT_REVOLUTE");
  EXPECT_EQ(schema().nearest("NODEE"), "NODE");
  EXPECT_EQ(schema().nearest("CONTROL_TERMINATON"), "CONTROL_TERMINATION");
  EXPECT_EQ(schema().nearest("CXNTRQL_TZRMINATION"), "CONTROL_TERMINATION");  // three characters foreign to it
  EXPECT_EQ(schema().nearest("CXNTRQL_TZRMINATI9N"), "");                     // four
  EXPECT_EQ(schema().nearest("QQQQQQQQQQQQ"), "");
}

TEST(Schema, WiderFormatsFollowFromTheStandardColumns) {
  const CardLayout& node = schema().find("NODE")->card("card0");
  const auto columns = [](const CardLayout& card, std::size_t format) {
    std::vector<int> all;
    for (const FieldLayout& f : card.fields) all.push_back(f.column[format]);
    return all;
  };
  EXPECT_EQ(columns(node, 0), (std::vector<int>{0, 8, 24, 40, 56, 64}));
  EXPECT_EQ(columns(node, 1), (std::vector<int>{0, 10, 26, 42, 58, 68}));
  EXPECT_EQ(columns(node, 2), (std::vector<int>{0, 20, 40, 60, 80, 100}));
  const CardLayout& spring = schema().find("ELEMENT_DISCRETE")->card("card0");
  EXPECT_EQ(columns(spring, 1), (std::vector<int>{0, 10, 20, 30, 40, 50, 66, 76}));
  EXPECT_EQ(columns(schema().find("DEFINE_CURVE")->card("point"), 2), (std::vector<int>{0, 20}));
  EXPECT_EQ(columns(schema().find("MAT_RIGID")->card("card0"), 1),
            columns(schema().find("MAT_RIGID")->card("card0"), 0));
}

TEST(Schema, EveryRowIsSound) {
  std::set<std::string> names;
  std::size_t honoured = 0;
  for (const KeywordInfo& info : schema().keywords()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name << " stands twice in the table";
    EXPECT_FALSE(info.note.empty()) << info.name;
    honoured += info.status == KeywordStatus::honoured;
    if (!info.stops_if.empty()) {
      EXPECT_GE(info.card("card0").index_of(info.stops_if), 0) << info.name;
    }
    for (const CardLayout& card : info.cards) {
      std::set<std::string> fields;
      int end = 0;
      for (const FieldLayout& f : card.fields) {
        if (f.name != "unused") {
          EXPECT_TRUE(fields.insert(f.name).second) << info.name << " " << card.name << " " << f.name;
        }
        EXPECT_GE(f.column[0], end) << info.name << " " << card.name << " " << f.name << " overlaps its neighbour";
        end = f.column[0] + f.width[0];
        EXPECT_LE(end, 80) << info.name << " " << card.name << " " << f.name;
      }
    }
  }
  EXPECT_GT(honoured, 150u);
  EXPECT_GT(names.size(), 2000u);
}

TEST(Schema, DocumentedListIsUpToDate) {
  std::ifstream file(std::string(KARDAN_SOURCE_DIR) + "/docs/keywords.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == keyword_table_markdown()) << "run: kardan keywords --markdown > docs/keywords.md";
}

}  // namespace
}  // namespace kardan::deck

// case.json: the committed cases are sound, and misspelt ones are refused.
#include <unistd.h>

#include "kardan/app/verify/case.hpp"

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "kardan/app/verify/verify.hpp"

namespace kardan::verify {
namespace {

const std::filesystem::path root = std::filesystem::path(KARDAN_SOURCE_DIR) / "verification";

TEST(Cases, EveryCommittedCaseIsSound) {
  const auto cases = read_cases(root);
  ASSERT_GE(cases.size(), 25u);
  std::set<std::string> names;
  for (const Case& c : cases) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name << " stands for two cases";
    EXPECT_FALSE(c.figures.empty()) << c.name;
    for (const auto& [name, run] : c.runs) EXPECT_TRUE(std::filesystem::exists(run.deck)) << run.deck;
    std::set<std::string> figures;
    for (const Figure& f : c.figures) {
      EXPECT_TRUE(figures.insert(f.name).second) << c.name << ": " << f.name << " twice";
      EXPECT_GT(f.limit, 0.0) << c.name << ": " << f.name;
      if (f.oracle && !f.oracle->file.empty()) {
        EXPECT_GT(read_table(f.oracle->file, f.oracle->columns).size(), 10u);
      }
    }
  }
}

TEST(Cases, TablesAreSampledExactly) {
  for (const Case& c : read_cases(root))
    for (const Figure& f : c.figures) {
      if (!f.oracle || f.oracle->file.empty()) continue;
      const Measure how = f.comparison.measure;
      if (how == Measure::peak_error || how == Measure::peak_time_error) continue;  // each history has its own peak
      const Series table = read_table(f.oracle->file, f.oracle->columns);
      for (const auto& name : f.runs) {
        const double ratio = table.time[1] * f.oracle->time_factor / c.runs.at(name).sample;
        EXPECT_NEAR(ratio, std::round(ratio), 1e-6) << c.name << ": run " << name << " misses the table's times";
      }
    }
}

class Folder : public ::testing::Test {
 protected:
  Folder() { std::filesystem::create_directories(folder_); }
  ~Folder() override { std::filesystem::remove_all(folder_.parent_path().parent_path()); }
  void write(const std::string& figure,
             const std::string& run = R"("deck": "d.k", "sample": 1, "steps": 2, "end": 4)") {
    std::ofstream(folder_ / "case.json") << R"({"title": "t", "proves": "p", "source": "s", "runs": {"r": {)" << run
                                         << R"(}}, "figures": [{)" << figure << "}]}";
  }
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("kardan_verify_cases_" + std::to_string(::getpid())) / "group" / "case";
};

TEST_F(Folder, ReadsRunsAndFigures) {
  write(
      R"("figure": "f", "run": "r", "signal": {"energy": "total"}, "measure": "drift", "scale": "initial", "limit": 0.5)");
  const Case c = read_case(folder_, "group");
  EXPECT_EQ(c.name, "case");
  EXPECT_DOUBLE_EQ(c.runs.at("r").dt(), 0.5);
  ASSERT_EQ(c.figures.size(), 1u);
  EXPECT_EQ(c.figures[0].comparison.scale.kind, Scale::Kind::initial);
  EXPECT_FALSE(c.is_long(c.figures[0]));
}

TEST_F(Folder, MisspeltEntriesAreRefused) {
  const std::string good =
      R"("figure": "f", "run": "r", "signal": {"energy": "total"}, "measure": "drift", "limit": 0.5)";
  write(good);
  EXPECT_NO_THROW(read_case(folder_, "group"));
  for (const char* bad :
       {R"("figure": "f", "run": "r", "signal": {}, "measure": "drift", "limits": 0.5)",
        R"("figure": "f", "run": "x", "signal": {}, "measure": "drift", "limit": 0.5)",
        R"("figure": "f", "run": "r", "signal": {}, "measure": "order", "limit": 0.5)",
        R"("figure": "f", "run": "r", "signal": {}, "measure": "drift", "scale": "big", "limit": 0.5)"}) {
    write(bad);
    EXPECT_THROW(read_case(folder_, "group"), CaseError) << bad;
  }
  write(good, R"("deck": "d.k", "sample": 0, "steps": 2, "end": 4)");
  EXPECT_THROW(read_case(folder_, "group"), CaseError);
  write(good, R"("deck": "d.k", "sample": 1, "steps": 2, "end": 4, "joints": "loose")");
  EXPECT_THROW(read_case(folder_, "group"), CaseError);
}

TEST_F(Folder, ADeckThatCannotBeReadFailsItsFigures) {
  write(R"("figure": "f", "run": "r", "signal": {"energy": "total"}, "measure": "drift", "limit": 0.5)");
  std::ostringstream out, log;
  const Options options{.names = {"case"}, .root = folder_.parent_path().parent_path(), .json = true};
  EXPECT_EQ(run(options, out, log), 1);
  const auto line = nlohmann::json::parse(out.str());
  for (const char* key : {"case", "figure", "value", "unit", "limit", "pass"}) EXPECT_TRUE(line.contains(key)) << key;
  EXPECT_FALSE(line["pass"].get<bool>());
}

TEST_F(Folder, UnknownNamesAreAUsageError) {
  write(R"("figure": "f", "run": "r", "signal": {"energy": "total"}, "measure": "drift", "limit": 0.5)");
  std::ostringstream out, log;
  EXPECT_EQ(run({.names = {"nothing"}, .root = folder_.parent_path().parent_path()}, out, log), 2);
  EXPECT_NE(log.str().find("nothing"), std::string::npos);
}

}  // namespace
}  // namespace kardan::verify

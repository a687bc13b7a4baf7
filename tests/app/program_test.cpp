// The whole program, called in process.
#include "kardan/app/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/folder_test.hpp"

namespace kardan::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// The program's exit code and words.
class Program : public FolderTest {
 protected:
  int call(const std::vector<std::string>& arguments) {
    std::ostringstream o, e;
    const int code = run_program(arguments, o, e, false);
    out = o.str();
    err = e.str();
    return code;
  }
  std::string deck(const std::string& name, const std::string& text) { return write(name, text).string(); }

  std::string out, err;
};

/// The cube falls under gravity 10 for 0.5.
const std::string falling_cube = R"(*KEYWORD
*TITLE
falling cube
*CONTROL_TERMINATION
0.5
*CONTROL_TIMESTEP
1e-3
*DATABASE_GLSTAT
0.1
*DATABASE_RBDOUT
0.1
*DATABASE_BINARY_D3PLOT
0.25
)" + rigid_cube + R"(*DEFINE_CURVE
1
0,1
100,1
*LOAD_BODY_Z
1,10
*END
)";

TEST_F(Program, FreeFallThroughTheWholeProgram) {
  ASSERT_EQ(call({"run", deck("cube.k", falling_cube), "-o", (folder / "out").string()}), 0) << out << err;
  EXPECT_EQ(err, "");
  EXPECT_THAT(out, HasSubstr("normal termination: end time reached (ENDTIM) at t = 0.5 after 500 cycles"));
  EXPECT_THAT(out, HasSubstr("constant 0.001 = DTINIT"));
  for (const char* name : {"d3plot", "glstat", "rbdout", "summary.json", "kardan.log"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;

  const nlohmann::json s = summary("out");
  EXPECT_EQ(s["title"], "falling cube");
  EXPECT_EQ(s["termination"]["reason"], "end_time");
  EXPECT_EQ(s["termination"]["normal"], true);
  EXPECT_EQ(s["cycles"], 500);
  EXPECT_EQ(s["time"], 0.5);
  EXPECT_EQ(s["dt_governed_by"], "DTINIT");
  EXPECT_EQ(s["joints"], "exact");
  EXPECT_NEAR(s["energies"]["kinetic"].get<double>(), 0.5 * 10 * 5.0 * 5.0, 1e-9);
  EXPECT_NEAR(s["energies"]["external_work"].get<double>(), 125.0, 1e-9);
  EXPECT_NEAR(s["energies"]["error"].get<double>(), 0, 1e-12);
  EXPECT_EQ(s["model"]["bodies"], 1);
  EXPECT_EQ(s["model"]["solids"], 1);
  EXPECT_EQ(s["state_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(s["program"]["name"], "kardan");
  EXPECT_TRUE(s["warnings"].is_array());
  double phases = 0;
  for (const char* phase : {"setup", "loads", "elements", "time_step", "contact", "rigid", "nodes", "ledger", "observers"})
    phases += s["wall_seconds"][phase].get<double>();
  EXPECT_GT(phases, 0);
  EXPECT_LE(phases, s["wall_seconds"]["total"].get<double>());
}

TEST_F(Program, LsDynaHabitsAndOverrides) {
  const std::string path = deck("cube.k", falling_cube);
  ASSERT_EQ(call({"i=" + path, "ncpu=2", "memory=20m", "endtime=0.1", "-o", (folder / "out").string()}), 0) << out << err;
  EXPECT_THAT(out, HasSubstr("memory=20m: not needed"));
  EXPECT_THAT(out, HasSubstr("2 threads"));
  EXPECT_EQ(summary("out")["time"], 0.1);
  EXPECT_EQ(summary("out")["end_time"], 0.1);
  EXPECT_EQ(call({"i=" + path, "case=3"}), 2);
  EXPECT_THAT(err, HasSubstr("case=3"));
}

TEST_F(Program, HashIsTheSameForOneAndTwoThreads) {
  const std::string path = deck("cube.k", falling_cube);
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(call({"run", path, "-j", threads, "-o", (folder / threads).string()}), 0) << err;
  EXPECT_EQ(summary("1")["state_hash"], summary("2")["state_hash"]);
  ASSERT_EQ(call({"run", path, "--dt", "5e-4", "-o", (folder / "finer").string()}), 0) << err;
  EXPECT_NE(summary("1")["state_hash"], summary("finer")["state_hash"]);
}

/// A square of elastic shells that is pulled apart.
const std::string pulled_shells = R"(*KEYWORD
*CONTROL_TERMINATION
2e-4
*DATABASE_GLSTAT
1e-5
*PART
plate
1,1,1
*SECTION_SHELL
1,2
0.01,0.01,0.01,0.01
*MAT_ELASTIC
1,7850,2.1e11,0.3
*NODE
1,0,0,0
2,0.1,0,0
3,0.2,0,0
4,0,0.1,0
5,0.1,0.11,0.01
6,0.2,0.1,0
7,0,0.2,0
8,0.1,0.2,0
9,0.2,0.2,0
*ELEMENT_SHELL
1,1,1,2,5,4
2,1,2,3,6,5
3,1,4,5,8,7
4,1,5,6,9,8
*SET_NODE_LIST
1
3,6,9
*INITIAL_VELOCITY
1
5,1,2
*END
)";

TEST_F(Program, HashIsTheSameForEveryInstructionSet) {
  const std::string path = deck("shells.k", pulled_shells);
  std::vector<std::string> hashes;
  for (const char* isa : {"x86-64-v2", "x86-64-v3", "x86-64-v4"}) {
    if (call({"run", path, "--isa", isa, "-o", (folder / isa).string()}) == 2) continue;  // not on this processor
    EXPECT_EQ(summary(isa)["instruction_set"], isa);
    EXPECT_GT(summary(isa)["energies"]["internal"].get<double>(), 0);
    hashes.push_back(summary(isa)["state_hash"]);
  }
  ASSERT_FALSE(hashes.empty());
  EXPECT_THAT(hashes, testing::Each(hashes.front()));
  EXPECT_EQ(call({"run", path, "--isa", "native", "-o", (folder / "native").string()}), 0) << err;
}

TEST_F(Program, EnergyStopIsAnErrorTermination) {
  std::string text = falling_cube;
  text.replace(text.find("*CONTROL_TERMINATION\n0.5"), 24, "*CONTROL_TERMINATION\n0.5,0,0,1e-30");
  // A force against the motion of nothing: the ratio can only be off by rounding, which is more than 1e-30 percent.
  const int code = call({"run", deck("cube.k", text), "-o", (folder / "out").string()});
  EXPECT_EQ(code, 1) << out;
  EXPECT_EQ(summary("out")["termination"]["reason"], "energy");
  EXPECT_EQ(summary("out")["termination"]["normal"], false);
  EXPECT_THAT(out, HasSubstr("error termination: energy ratio out of its limits (ENDENG)"));
}

TEST_F(Program, BadUsageIsExitCodeTwoAndSaysWhatIsWrong) {
  EXPECT_EQ(call({}), 2);
  EXPECT_THAT(err, HasSubstr("run"));
  EXPECT_EQ(call({"run"}), 2);
  EXPECT_THAT(err, HasSubstr("deck"));
  EXPECT_EQ(call({"walk", "x.k"}), 2);
  EXPECT_EQ(call({"run", "x.k", "--joints", "glue"}), 2);
  EXPECT_THAT(err, HasSubstr("--joints"));
  EXPECT_EQ(call({"run", "x.k", "-j", "0"}), 2);
  EXPECT_EQ(call({"run", "x.k", "--end", "-1"}), 2);
  EXPECT_EQ(call({"run", "x.k", "--isa", "x86-64-v9"}), 2);
  EXPECT_THAT(err, HasSubstr("x86-64-v9"));
  EXPECT_EQ(call({"run", "x.k", "--without", "gravity"}), 2);
}

TEST_F(Program, MissingDeckIsBadInput) {
  EXPECT_EQ(call({"run", (folder / "nowhere.k").string()}), 2);
  EXPECT_THAT(err, HasSubstr("nowhere.k"));
  EXPECT_THAT(err, HasSubstr("cannot be run"));
}

TEST_F(Program, FaultsOfADeckAreAllReportedWithTheirLines) {
  std::string text = falling_cube;
  text.replace(text.find("1,1.25,2.1e5,0.3"), 16, "1,1.2x5,2.1e5,0.3");
  text.replace(text.find("1,1,1,2,3,4,5,6,7,8"), 19, "1,1,1,2,3,4,5,6,7,99");
  EXPECT_EQ(call({"run", deck("cube.k", text), "-o", (folder / "out").string()}), 2);
  EXPECT_THAT(err, HasSubstr("cube.k:20:"));
  EXPECT_THAT(err, HasSubstr("*MAT_RIGID"));
  EXPECT_THAT(err, HasSubstr("1.2x5"));
  EXPECT_THAT(err, HasSubstr("99"));
  EXPECT_FALSE(fs::exists(folder / "out")) << "a run that did not begin leaves no results";
}

TEST_F(Program, AKeywordThatChangesThePhysicsStopsTheRunUnlessLeftOutByName) {
  const std::string contact = "*CONTACT_AUTOMATIC_SINGLE_SURFACE_MORTAR\n0,0,5\n0.1\n\n*END\n";
  std::string text = falling_cube;
  text.replace(text.find("*END"), 5, contact);
  const std::string path = deck("cube.k", text);
  EXPECT_EQ(call({"run", path, "-o", (folder / "out").string()}), 2);
  EXPECT_THAT(err, HasSubstr("*CONTACT_AUTOMATIC_SINGLE_SURFACE_MORTAR"));
  EXPECT_EQ(call({"run", path, "--without", "contact", "-o", (folder / "out").string()}), 0) << err;
  EXPECT_THAT(summary("out")["warnings"].dump(), HasSubstr("CONTACT"));
}

TEST_F(Program, CheckReportsTheModelAndDoesNotRunIt) {
  EXPECT_EQ(call({"check", deck("cube.k", falling_cube)}), 0) << err;
  EXPECT_THAT(out, HasSubstr("falling cube"));
  EXPECT_THAT(out, HasSubstr("the deck can be run"));
  std::string text = falling_cube;
  text.replace(text.find("1,1.25,"), 7, "1,0.00,");
  EXPECT_EQ(call({"check", deck("massless.k", text)}), 2) << out;
  EXPECT_THAT(err, HasSubstr("mass"));
}

TEST_F(Program, VersionHelpAndKeywords) {
  EXPECT_EQ(call({"--version"}), 0);
  EXPECT_THAT(out, HasSubstr("commit"));
  EXPECT_THAT(out, HasSubstr("no MPI in this build"));
  EXPECT_EQ(call({"--help"}), 0);
  EXPECT_THAT(out, HasSubstr("check"));
  EXPECT_EQ(call({"run", "--help"}), 0);
  EXPECT_THAT(out, HasSubstr("--joints"));
  EXPECT_EQ(call({"keywords", "--markdown"}), 0);
  EXPECT_THAT(out, HasSubstr("CONSTRAINED_JOINT_REVOLUTE"));
}

TEST_F(Program, VerifyListsItsCases) {
  EXPECT_EQ(call({"verify", "--list"}), 0) << err;
  EXPECT_THAT(out, HasSubstr("rssp"));
  EXPECT_EQ(call({"verify", "no_such_case"}), 2);
}

}  // namespace
}  // namespace kardan::app

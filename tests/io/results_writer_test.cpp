// The facade with binout and the ASCII files: what is written, when, and that all formats say the same.
#include "kardan/io/results_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "kardan/base/diagnostics.hpp"
#include "writers_fixture.hpp"

namespace kardan {
namespace {

using testing::advance;
using ::testing::HasSubstr;
using testing::make_model;
using testing::make_state;
using testing::output_directory;

const std::vector<OutputFile> histories = {OutputFile::glstat,  OutputFile::matsum,  OutputFile::nodout,
                                           OutputFile::rbdout,  OutputFile::jntforc, OutputFile::bndout,
                                           OutputFile::spcforc, OutputFile::deforc};

void ask(Model& m, const std::vector<OutputFile>& files, double dt, int binary = 0) {
  for (const OutputFile f : files) m.output.requests[f] = {dt, binary, none};
}

/// Runs the fixture from 0 to `end` in `cycles` steps; returns the times at which something was due.
std::vector<double> run(const Model& m, State& s, ResultsWriter& writer, double end, int cycles) {
  std::vector<double> due;
  const double dt = end / cycles;
  for (int c = 0; c <= cycles; ++c) {
    advance(m, s, c == cycles ? end : c * dt, dt);
    if (!writer.due(s.clock.time, s.clock.dt)) continue;
    due.push_back(s.clock.time);
    writer.write_due(m, s);
  }
  writer.finish();
  return due;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

testing::ScriptResult check_histories(const std::filesystem::path& directory, const nlohmann::json& expected) {
  const auto json = directory / "expected.json";
  std::ofstream(json) << expected;
  return testing::run_script("check_histories.py", "'" + directory.string() + "' '" + json.string() + "'");
}

TEST(ResultsWriter, ForcesOnWallsAndTheirSegments) {
  Model m = make_model();
  State s = make_state(m);
  m.rigid_walls.resize(2);
  m.rigid_walls[1].title = "barrier";
  s.walls.resize(2);
  s.walls[0].id = 4;
  s.walls[1].id = 9;
  s.walls[1].eased_force = {1, 2, -30};
  s.walls[1].eased_normal_force = 30;
  s.walls[1].segment_force = {{0, 0, -20}, {1, 0, -5}};
  ask(m, {OutputFile::rwforc}, 0.1, 3);
  const auto directory = output_directory();
  ResultsWriter writer(m, s, directory, {});
  run(m, s, writer, 0.1, 10);
  const std::string text = text_of(directory / "rwforc");
  EXPECT_THAT(text, HasSubstr(" 1.00000E-01       2   3.000000E+01   1.000000E+00   2.000000E+00  -3.000000E+01\n"
                              "                seg#    \n"
                              "                   1                  0.000000E+00   0.000000E+00  -2.000000E+01\n"
                              "                   2                  1.000000E+00   0.000000E+00  -5.000000E+00\n"
                              "  total force                         1.000000E+00   0.000000E+00  -2.500000E+01\n"));
  EXPECT_EQ(text.find("seg#", text.find("1.00000E-01       1")), text.find("seg#", text.find("1.00000E-01       2")));
}

TEST(ResultsWriter, BinoutHoldsTheNumbersAndAsciiTheSame) {
  if (!testing::python_has("json"))
    GTEST_SKIP() << "skipped: /usr/bin/python3 (Debian package python3) is not installed";
  Model m = make_model();
  ask(m, histories, 0.1);
  m.joints[1].local_body = 0;
  const auto directory = output_directory();
  State s = make_state(m);
  advance(m, s, 0.0, 0.05);
  ResultsWriter writer(m, s, directory, {"kardan 0.1", "01/02/2026", {}});
  EXPECT_EQ(run(m, s, writer, 0.4, 8).size(), 5u);

  const double t = 0.2, degrees = 180 / std::numbers::pi;
  // The plate's local axes are its principal ones, turned about z by 0.3 at the start and by 40 t since.
  const double angle = 0.3 + 40 * t, fx = 100 * t, fy = 200;
  nlohmann::json expected;
  expected["states"] = 5;
  expected["texts"] = {{"/glstat/metadata/title", "writer test"},
                       {"/glstat/metadata/date", "01/02/2026"},
                       {"/rbdout/metadata/version", "kardan 0.1"},
                       {"/jntforc/joints/metadata/legend", "knee"}};
  expected["numbers"] = {{"/glstat/d000003/time", {t}},
                         {"/glstat/d000003/kinetic_energy", {10 + t}},
                         {"/glstat/d000003/total_energy", {10 + t + 2 * t}},
                         {"/glstat/d000003/energy_ratio", {(10 + t + 2 * t) / (10 + 3 * t)}},
                         {"/matsum/metadata/ids", {10, 20, 5, 30, 7}},
                         {"/matsum/d000003/mass", {3.0, 0.5, 0.5, 0.5, 0.5}},
                         {"/matsum/d000003/x_momentum", {3.0, 1.0, 1.0, 1.0, 1.0}},
                         {"/nodout/metadata/ids", {106, 203}},
                         {"/rbdout/metadata/ids", {10, 99}},
                         {"/rbdout/metadata/num_nodal", {1}},
                         {"/rbdout/d000003/global_x", {1 + 1.0 * t, 20.5}},
                         {"/rbdout/d000003/global_rvz", {40.0, 0.0}},
                         {"/jntforc/joints/metadata/ids", {501, 502}},
                         {"/jntforc/joints/metadata/local", {0, 1}},
                         {"/jntforc/joints/d000003/separation", {1e-3 * t, 1e-3 * t}},
                         {"/jntforc/joints/d000003/angular_separation", {1e-4 * degrees, 1e-4 * degrees}},
                         {"/jntforc/type0/d000003/theta_degrees", {0.2 * degrees}},
                         {"/jntforc/type0/d000003/phi_moment_total", {21.0}},
                         {"/jntforc/type1/d000003/gamma_scale_factor", {20.0}},
                         {"/jntforc/type1/d000003/beta_moment_damping", {31.0}},
                         {"/jntforc/type2/d000003/z_displacement", {0.3}},
                         {"/bndout/velocity/nodes/metadata/ids", {1}},
                         {"/bndout/velocity/rigidbodies/metadata/ids", {10}},
                         {"/bndout/velocity/rigidbodies/metadata/setid", {8}},
                         {"/bndout/velocity/rigidbodies/d000003/xmoment", {-4.0}},
                         {"/bndout/velocity/nodes/d000003/etotal", {10.0}},
                         {"/spcforc/metadata/force_ids", {203}},
                         {"/spcforc/d000003/z_moment", {6.0}},
                         {"/deforc/metadata/ids", {31, 32}},
                         {"/deforc/d000003/resultant_force", {-12.5, 0.0}}};
  const auto result = check_histories(directory, expected);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  // One symbol table for each output: a run killed after any of them leaves a readable file.
  EXPECT_THAT(result.output, HasSubstr("5 symbol tables"));

  // The same numbers within rounding of the rotation: local force of joint 502.
  const std::string jntforc = text_of(directory / "jntforc");
  char line[64];
  std::snprintf(line, sizeof line, " x-force  (local) ............%14.5E\n",
                std::cos(angle) * fx + std::sin(angle) * fy);
  EXPECT_THAT(jntforc, HasSubstr(line));
  EXPECT_THAT(jntforc, HasSubstr("{BEGIN LEGEND}\n Entity #        Title\n      501     knee\n{END LEGEND}\n"));
}

TEST(ResultsWriter, RotationsGrowBeyondWholeTurns) {
  Model m = make_model();
  ask(m, {OutputFile::rbdout}, 0.1);  // 4 radians between outputs: more than half a turn
  const auto directory = output_directory();
  State s = make_state(m);
  advance(m, s, 0.0, 0.05);
  ResultsWriter writer(m, s, directory, {});
  run(m, s, writer, 1.0, 20);
  const std::string text = text_of(directory / "rbdout");
  const auto last = text.rfind("r i g i d");
  EXPECT_THAT(text.substr(last, 600), HasSubstr(" displacements:    1.0000E+00 -2.0000E+00  5.0000E-01"));
  const auto line = text.find(" displacements:", last);
  EXPECT_NEAR(std::stod(text.substr(line + 17 + 60, 12)), 40.0, 1e-3);
}

TEST(ResultsWriter, BinaryChoosesTheFormat) {
  Model m = make_model();
  m.output.requests = {{OutputFile::glstat, {0.5, 1, none}},
                       {OutputFile::matsum, {0.5, 2, none}},
                       {OutputFile::rbdout, {0.5, 3, none}},
                       {OutputFile::abstat, {0.5, 0, none}},
                       {OutputFile::nodout, {0.0, 3, none}}};
  const auto directory = output_directory();
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  run(m, s, writer, 1.0, 4);
  EXPECT_FALSE(writer.defaulted());
  EXPECT_THAT(writer.unwritten(), ::testing::ElementsAre(OutputFile::abstat));
  EXPECT_TRUE(std::filesystem::exists(directory / "glstat"));
  EXPECT_FALSE(std::filesystem::exists(directory / "matsum"));
  EXPECT_TRUE(std::filesystem::exists(directory / "rbdout"));
  EXPECT_FALSE(std::filesystem::exists(directory / "nodout"));
  EXPECT_FALSE(std::filesystem::exists(directory / "d3plot"));
  const std::string binout = text_of(directory / "binout0000");
  EXPECT_THAT(binout, ::testing::Not(HasSubstr("/glstat")));
  EXPECT_THAT(binout, HasSubstr("/matsum/d000003"));
  EXPECT_THAT(binout, HasSubstr("/rbdout/d000003"));
}

TEST(ResultsWriter, FilesKeepTheirOwnTimes) {
  Model m = make_model();
  Curve curve;
  curve.x = {0, 1};
  curve.y = {0.5, 0.5};
  m.curves.push_back(curve);
  m.output.requests = {{OutputFile::glstat, {0.25, 0, none}}, {OutputFile::matsum, {0.1, 0, 0}}};
  const auto directory = output_directory();
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  EXPECT_THAT(run(m, s, writer, 1.0, 20),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), {0.0, 0.25, 0.5, 0.75, 1.0}));
  const std::string binout = text_of(directory / "binout0000");
  EXPECT_THAT(binout, HasSubstr("/glstat/d000005"));
  EXPECT_THAT(binout, HasSubstr("/matsum/d000003")) << "LCUR overrides DT";
  EXPECT_THAT(binout, ::testing::Not(HasSubstr("/matsum/d000004")));
}

TEST(ResultsWriter, ADeckThatAsksForNothingGetsD3plotAndGlstat) {
  Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  EXPECT_TRUE(writer.defaulted());
  EXPECT_EQ(run(m, s, writer, 1.0, 2000).size(), 1001u);
  const auto state_words = 1u + 6 + 7 * 5 + 9 * 24 + 7 + 2 * 6 + 4 * 33;
  EXPECT_EQ(std::filesystem::file_size(directory / "d3plot01"), 4 * (21 * state_words + 1));
}

TEST(ResultsWriter, AnEarlyEndWritesTheLastStateOnce) {
  Model m = make_model();
  ask(m, {OutputFile::glstat, OutputFile::d3plot}, 0.5);
  const auto directory = output_directory();
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  for (const double t : {0.0, 0.1, 0.2}) {
    advance(m, s, t, 0.1);
    writer.write_due(m, s);
  }
  writer.write_now(m, s);
  writer.write_now(m, s);
  const std::string text = text_of(directory / "glstat");
  EXPECT_THAT(text, HasSubstr(" time...........................   2.00000E-01\n"));
  EXPECT_EQ(text.find("2.00000E-01\n time step"), text.rfind("2.00000E-01\n time step"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("1.00000E-01\n time step")));
}

TEST(ResultsWriter, ResultsOfAnEarlierRunAreRemoved) {
  Model m = make_model();
  ask(m, {OutputFile::d3plot}, 0.5);
  const auto directory = output_directory();
  for (const char* name : {"d3plot07", "binout0000", "rbdout", "notes.txt", "d3plot_old"})
    std::ofstream(directory / name) << "x";
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  for (const char* name : {"d3plot07", "binout0000", "rbdout"})
    EXPECT_FALSE(std::filesystem::exists(directory / name)) << name;
  for (const char* name : {"notes.txt", "d3plot_old"}) EXPECT_TRUE(std::filesystem::exists(directory / name)) << name;
}

TEST(ResultsWriter, AFullDiskIsSaidWithPathAndReason) {
  Model m = make_model();
  ask(m, {OutputFile::glstat}, 0.001, 1);
  const auto directory = output_directory();
  State s = make_state(m);
  ResultsWriter writer(m, s, directory, {});
  // A limit on the size of files stands for the full disk.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 8192;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    run(m, s, writer, 1.0, 1000);
  } catch (const RunError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr((directory / "glstat").string()));
  EXPECT_THAT(message, HasSubstr("too large"));
}

}  // namespace
}  // namespace kardan

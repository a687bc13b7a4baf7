// Stresses of shells through the whole program: deck, run, d3plot as ParaView reads it, elout.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kardan/app/program.hpp"

namespace kardan::app {
namespace {

namespace fs = std::filesystem;

/// A plate of two squares in the plane y = 0, side 1-2 along z, stretched along x by 1e-3 in 1e-3 s, held against lateral contraction.
const std::string stretched = R"(*KEYWORD
*TITLE
stretched plate
*CONTROL_TERMINATION
1e-3
*DATABASE_ELOUT
1e-3
*DATABASE_BINARY_D3PLOT
1e-3
*DATABASE_HISTORY_SHELL
12
*PART
plate
1,1,1
*SECTION_SHELL
1,2,0.8333,3
0.02
*MAT_ELASTIC
1,7800.0,210e9,0.3
*DEFINE_CURVE
1
0.0,0.0
1.0,1000.0
*BOUNDARY_PRESCRIBED_MOTION_SET
2,1,2,1,1e-3
*SET_NODE_LIST
2
5,6
*BOUNDARY_PRESCRIBED_MOTION_SET
3,1,2,1,0.5e-3
*SET_NODE_LIST
3
3,4
*NODE
1,0.0,0.0,0.0,7,7
2,0.0,0.0,1.0,7,7
3,1.0,0.0,0.0,5,7
4,1.0,0.0,1.0,5,7
5,2.0,0.0,0.0,5,7
6,2.0,0.0,1.0,5,7
*ELEMENT_SHELL
12,1,1,2,4,3
13,1,3,4,6,5
*END
)";

std::string python(const std::string& arguments, int& code) {
  std::string output;
  std::FILE* pipe = popen(("/usr/bin/python3 " + arguments + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  code = pclose(pipe);
  return output;
}

TEST(ShellOutput, StressOfAStretchedPlateIsWhatParaviewAndBinoutShow) {
  int code = 0;
  python("-c 'import vtk'", code);
  if (code != 0) GTEST_SKIP() << "skipped: Debian package python3-vtk9 is not installed";
  const fs::path folder = fs::temp_directory_path() / ("kardan_shell_output_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "plate.k") << stretched;
  std::ostringstream out, err;
  ASSERT_EQ(run_program({"run", (folder / "plate.k").string(), "-o", (folder / "out").string()}, out, err, false), 0) << out.str() << err.str();
  const double strain = std::log(1 + 0.5e-3), f = 210e9 / 0.91, along = f * strain, across = 0.3 * along;
  nlohmann::json expected;
  expected["shell"] = 12;
  expected["scale"] = {{"stress", along}, {"InternalEnergy", 0.5 * along * strain * 10}, {"Thickness", 0.02}, {"EffPlastStrn", 1.0}};
  for (const char* layer : {"Stress", "StressInnerSurf", "StressOuterSurf"}) expected["arrays"][layer] = {along, 0, across, 0, 0, 0};
  expected["arrays"]["Thickness"] = {0.02};
  expected["arrays"]["InternalEnergy"] = {0.5 * along * strain};
  // In the element's axes: x along side 1-2, which is global z.
  expected["elout"] = {{"ids", {12}}, {"nip", {3}}, {"state", {1, 1, 1}}, {"mat", {1}}};
  expected["elout"]["sig_xx"] = {across, across, across};
  expected["elout"]["sig_yy"] = {along, along, along};
  expected["elout"]["sig_xy"] = expected["elout"]["sig_yz"] = expected["elout"]["plastic_strain"] = {0, 0, 0};
  std::ofstream(folder / "expected.json") << expected;
  const std::string said =
      python("'" KARDAN_SOURCE_DIR "/tests/io/python/check_stress.py' '" + (folder / "out").string() + "' '" + (folder / "expected.json").string() + "'", code);
  EXPECT_EQ(code, 0) << said;
  std::ifstream ascii(folder / "out" / "elout");
  const std::string text{std::istreambuf_iterator<char>(ascii), {}};
  EXPECT_NE(text.find(" element  materl(local)"), std::string::npos) << text;
  EXPECT_NE(text.find("      12-      1\n   1-  2 elastic "), std::string::npos) << text;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace kardan::app

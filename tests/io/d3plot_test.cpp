// d3plot: words of the header, what VTK's reader sees, the family of files.
#include "kardan/io/d3plot/d3plot_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kardan/base/diagnostics.hpp"
#include "writers_fixture.hpp"

namespace kardan {
namespace {

using testing::advance;
using testing::bytes_of;
using testing::make_model;
using testing::make_state;
using testing::output_directory;
using testing::words_of;

const RunLabel label{"writer test", "kardan test", "01/02/2026"};

nlohmann::json expected_of(const Model& m) {
  nlohmann::json e;
  e["title"] = m.title;
  e["part_names"] = {"strut", "spring", "rigid plate", "block", "Part 30"};
  e["elements"] = {{"72", {"rigid plate", {102, 105, 106, 103}}},
                   {"71", {"rigid plate", {101, 102, 103, 104}}},
                   {"41", {"Part 30", {201, 202, 203, 204}}},
                   {"80", {"Part 30", {202, 205, 203, 203}}},
                   {"900", {"block", {1, 2, 3, 4, 11, 12, 13, 14}}},
                   {"33", {"strut", {301, 302}}},
                   {"31", {"spring", {303, 106}}}};
  e["part_nodes"] = {{"strut", {301, 302}},
                     {"spring", {106, 303}},
                     {"rigid plate", {101, 102, 103, 104, 105, 106}},
                     {"block", {1, 2, 3, 4, 11, 12, 13, 14}},
                     {"Part 30", {201, 202, 203, 204, 205}}};
  e["cells"] = nlohmann::json::object();
  e["states"] = nlohmann::json::array();
  return e;
}

void add_expected_state(nlohmann::json& e, const Model& m, const State& s) {
  nlohmann::json state;
  state["time"] = s.clock.time;
  for (std::size_t n = 0; n < m.nodes.size(); ++n) {
    if (m.nodes.id[n] > 400) continue;  // nodes of the nodal rigid body belong to no element that VTK shows
    const Vec3 &x = s.nodes.x[n], &v = s.nodes.v_now[n], &a = s.nodes.a[n];
    state["nodes"][std::to_string(m.nodes.id[n])] = {x.x, x.y, x.z, v.x, v.y, v.z, a.x, a.y, a.z};
  }
  e["states"].push_back(state);
}

void expect_vtk_reads(const std::filesystem::path& directory, const nlohmann::json& expected) {
  const auto json = directory / "expected.json";
  std::ofstream(json) << expected;
  const auto result =
      testing::run_script("check_d3plot.py", "'" + (directory / "d3plot").string() + "' '" + json.string() + "'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, ::testing::HasSubstr("compared"));
}

#define SKIP_WITHOUT_VTK() \
  if (!testing::python_has("vtk")) GTEST_SKIP() << "skipped: Debian package python3-vtk9 is not installed"

TEST(D3plot, ControlWordsStandWhereReadersLookForThem) {
  const Model m = make_model();
  const auto directory = output_directory();
  const State s = make_state(m);
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  const auto w = words_of<std::int32_t>(directory / "d3plot");
  const auto raw = bytes_of(directory / "d3plot");
  EXPECT_EQ(std::string(raw.data(), 40), padded("writer test", 40));
  float version;
  std::memcpy(&version, &w[14], 4);
  EXPECT_EQ(version, 971.0f);
  const std::vector<std::pair<std::size_t, std::int32_t>> wanted = {
      {11, 1}, {15, 4},    {16, 24},   {17, 6},    {18, 6 + 7 * 5}, {19, 0}, {20, 1}, {21, 1},
      {22, 1}, {23, 1},    {24, 1},    {27, 7},    {28, 2},         {29, 2}, {30, 6}, {31, 4},
      {32, 2}, {33, 33},   {34, 0},    {35, 0},    {36, 3},         {37, 0}, {38, 0}, {39, 16 + 24 + 1 + 2 + 4 + 3 * 5},
      {40, 0}, {43, 1000}, {44, 1000}, {45, 1000}, {46, 1000},      {50, 0}, {51, 5}, {57, 0}};
  for (const auto& [position, value] : wanted) EXPECT_EQ(w[position], value) << "word " << position;
}

TEST(D3plot, IdsAndPartsAreAscendingAndConnectivityFollows) {
  const Model m = make_model();
  const auto directory = output_directory();
  D3plotWriter writer(directory / "d3plot", label, m, make_state(m), {});
  const auto w = words_of<std::int32_t>(directory / "d3plot");
  const std::size_t solids = 64 + 3 * 24, lines = solids + 9, shells = lines + 2 * 6, numbering = shells + 4 * 5;
  // Sorted nodes: 1 2 3 4 11 12 13 14 101 …; parts 5 7 10 20 30.
  EXPECT_THAT(std::vector(w.begin() + solids, w.begin() + lines), ::testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 4));
  EXPECT_THAT(std::vector(w.begin() + lines, w.begin() + lines + 6), ::testing::ElementsAre(22, 14, 22, 0, 0, 2));
  EXPECT_THAT(std::vector(w.begin() + lines + 6, w.begin() + shells), ::testing::ElementsAre(20, 21, 22, 0, 0, 1));
  EXPECT_THAT(std::vector(w.begin() + shells, w.begin() + shells + 5), ::testing::ElementsAre(15, 16, 17, 18, 5));
  EXPECT_LT(w[numbering], 0);
  EXPECT_THAT(std::vector(w.begin() + numbering + 5, w.begin() + numbering + 10),
              ::testing::ElementsAre(24, 1, 2, 4, 0));
  EXPECT_THAT(std::vector(w.begin() + numbering + 13, w.begin() + numbering + 16), ::testing::ElementsAre(5, 0, 5));
  EXPECT_THAT(std::vector(w.begin() + numbering + 16 + 24, w.begin() + numbering + 16 + 31),
              ::testing::ElementsAre(900, 31, 33, 41, 71, 72, 80));
  const std::size_t part_ids = numbering + 16 + 31;
  EXPECT_THAT(std::vector(w.begin() + part_ids, w.begin() + part_ids + 15),
              ::testing::ElementsAre(5, 7, 10, 20, 30, 5, 7, 10, 20, 30, 1, 2, 3, 4, 5));
  const std::size_t titles = part_ids + 15;
  float marker;
  std::memcpy(&marker, &w[titles], 4);
  EXPECT_EQ(marker, -999999.0f);
  EXPECT_EQ(w[titles + 1], 90001);
  EXPECT_EQ(w[titles + 2], 5);
  EXPECT_EQ(w[titles + 3], 5);
  EXPECT_EQ(w[titles + 3 + 5 * 19], 90000);
  EXPECT_EQ(w.size(), titles + 3 + 5 * 19 + 19 + 1);
}

TEST(D3plot, StateBeginsWithTimeAndEnergies) {
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  advance(m, s, 0.25, 0.01);
  writer.write_state(m, s);
  const auto w = words_of<float>(directory / "d3plot01");
  ASSERT_EQ(w.size(), 1u + 6 + 7 * 5 + 9 * 24 + 7 + 2 * 6 + 4 * 33 + 1);
  EXPECT_FLOAT_EQ(w[0], 0.25f);
  EXPECT_FLOAT_EQ(w[1], 10.25f);
  EXPECT_FLOAT_EQ(w[2], 0.5f);
  EXPECT_FLOAT_EQ(w[3], 10.75f);
  // 16 free nodes of 0.25 and the plate of 3 move, the nodal rigid body of 2 stands: 7 of 9 move.
  EXPECT_FLOAT_EQ(w[4], static_cast<float>(7.0 / 9.0));
  const std::size_t velocities = 7 + 10;
  EXPECT_FLOAT_EQ(w[7 + 3], 0.5f);           // internal energy of part 20
  EXPECT_FLOAT_EQ(w[7 + 5 + 2], 4.25f);      // kinetic energy of part 10
  EXPECT_FLOAT_EQ(w[velocities + 6], 1.0f);  // part 10
  EXPECT_FLOAT_EQ(w[velocities + 7], -2.0f);
  EXPECT_FLOAT_EQ(w[velocities + 15 + 2], 3.0f);  // mass of part 10
  EXPECT_FLOAT_EQ(w.back(), -999999.0f);
}

/// Two walls, the second one moved by 0.5 along z.
void add_walls(Model& m, State& s) {
  RigidWall wall;
  wall.point = {1, 2, 3};
  m.rigid_walls.assign(2, wall);
  s.walls.resize(2);
  s.walls[0].eased_normal_force = 7;
  s.walls[1].displacement = {0, 0, 0.5};
}

TEST(D3plot, ForcesAndPlacesOfWallsFollowThePartsEnergies) {
  Model m = make_model();
  State s = make_state(m);
  add_walls(m, s);
  const auto directory = output_directory();
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  writer.write_state(m, s);
  EXPECT_EQ(words_of<std::int32_t>(directory / "d3plot")[18], 6 + 7 * 5 + 4 * 2);
  const auto w = words_of<float>(directory / "d3plot01");
  const auto walls = w.begin() + 7 + 7 * 5;
  EXPECT_THAT(std::vector(walls, walls + 8), ::testing::ElementsAre(7, 0, 1, 2, 3, 1, 2, 3.5f));
}

TEST(D3plot, VtkSeesEveryNodeElementAndPart) {
  SKIP_WITHOUT_VTK();
  Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  add_walls(m, s);
  s.results.shell.stress.assign(4 * 3, StressVector{});
  s.results.shell.stress[2 * 3 + 1] = {1, 2, 3, 4, 5, 6};  // shell 41, inner surface
  s.results.shell.membrane.assign(4, Vec3{});
  s.results.shell.thickness = {1.5, 1.5, 1.25, 1.5};
  s.results.shell.internal_energy = {0, 0, 77, 0};
  s.results.solid.stress = {{6, 5, 4, 3, 2, 1}};
  s.results.solid.plastic_strain = {0.125};
  s.results.beam.axial = {42};
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  auto expected = expected_of(m);
  expected["cells"] = {
      {"41", {{"StressInnerSurf", {1, 2, 3, 4, 5, 6}}, {"Thickness", {1.25}}, {"InternalEnergy", {77}}}},
      {"900", {{"Stress", {6, 5, 4, 3, 2, 1}}, {"EffPlastStrn", {0.125}}}},
      {"33", {{"AxialForce", {42}}}}};
  for (int i = 0; i < 4; ++i) {
    advance(m, s, 0.1 * i, 0.01);
    writer.write_state(m, s);
    add_expected_state(expected, m, s);
  }
  expect_vtk_reads(directory, expected);
}

TEST(D3plot, AModelOfShellsAloneIsReadToo) {
  SKIP_WITHOUT_VTK();
  Model m = make_model();
  m.solids = {};
  m.beams = {};
  m.discretes = {};
  const auto directory = output_directory();
  State s = make_state(m);
  s.discretes.assign(1, {});
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  auto expected = expected_of(m);
  for (const char* gone : {"900", "33", "31"}) expected["elements"].erase(gone);
  advance(m, s, 0.5, 0.01);
  writer.write_state(m, s);
  expected["states"].push_back({{"time", 0.5}, {"nodes", nlohmann::json::object()}});
  for (const UserId id : {101, 106, 205}) {
    const auto n = static_cast<std::size_t>(m.nodes.index_of.at(id));
    const Vec3 &x = s.nodes.x[n], &v = s.nodes.v_now[n], &a = s.nodes.a[n];
    expected["states"][0]["nodes"][std::to_string(id)] = {x.x, x.y, x.z, v.x, v.y, v.z, a.x, a.y, a.z};
  }
  expect_vtk_reads(directory, expected);
}

TEST(D3plot, SplitsIntoAFamilyThatReadsAsOne) {
  SKIP_WITHOUT_VTK();
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  D3plotOptions options;
  options.file_words = 900;  // a state has about 409 words: two in a file
  D3plotWriter writer(directory / "d3plot", label, m, s, options);
  auto expected = expected_of(m);
  for (int i = 0; i < 5; ++i) {
    advance(m, s, 0.1 * i, 0.01);
    writer.write_state(m, s);
    add_expected_state(expected, m, s);
  }
  for (const char* name : {"d3plot01", "d3plot02", "d3plot03"}) EXPECT_TRUE(std::filesystem::exists(directory / name));
  EXPECT_FALSE(std::filesystem::exists(directory / "d3plot04"));
  expect_vtk_reads(directory, expected);
}

TEST(D3plot, EightByteWordsAreReadToo) {
  SKIP_WITHOUT_VTK();
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  D3plotOptions options;
  options.word_bytes = 8;
  D3plotWriter writer(directory / "d3plot", label, m, s, options);
  auto expected = expected_of(m);
  advance(m, s, 1.0 / 3.0, 0.01);
  writer.write_state(m, s);
  add_expected_state(expected, m, s);
  expect_vtk_reads(directory, expected);
  EXPECT_EQ(words_of<double>(directory / "d3plot01")[0], 1.0 / 3.0);
}

TEST(D3plot, DeletedElementsAreZerosInTheDeletionTable) {
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  s.results.shell.alive = {1, 1, 0, 1};  // shell 41 is gone
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  EXPECT_EQ(words_of<std::int32_t>(directory / "d3plot")[36], -10003);
  advance(m, s, 0.0, 0.01);
  writer.write_state(m, s);
  const auto w = words_of<float>(directory / "d3plot01");
  // Solid 900; shells 41, 71, 72, 80; lines 31 (spring), 33 (beam): internal part numbers.
  EXPECT_THAT(std::vector(w.end() - 8, w.end() - 1), ::testing::ElementsAre(4, 0, 3, 3, 5, 2, 1));
}

TEST(D3plot, VtkReadsTheDeletionTable) {
  SKIP_WITHOUT_VTK();
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  s.results.shell.alive = {1, 1, 0, 1};
  D3plotWriter writer(directory / "d3plot", label, m, s, {});
  auto expected = expected_of(m);
  expected["elements"].erase("41");
  expected.erase("part_nodes");
  for (int i = 0; i < 2; ++i) {
    advance(m, s, 0.5 * i, 0.01);
    writer.write_state(m, s);
    expected["states"].push_back({{"time", s.clock.time}, {"nodes", nlohmann::json::object()}});
  }
  expect_vtk_reads(directory, expected);
}

TEST(D3plot, MaterialTypesLeaveRigidShellsOutOfTheStates) {
  const Model m = make_model();
  const auto directory = output_directory();
  State s = make_state(m);
  D3plotOptions options;
  options.material_types = true;
  D3plotWriter writer(directory / "d3plot", label, m, s, options);
  const auto head = words_of<std::int32_t>(directory / "d3plot");
  EXPECT_EQ(head[15], 5);
  EXPECT_THAT(std::vector(head.begin() + 64, head.begin() + 71), ::testing::ElementsAre(2, 5, 1, 0, 20, 1, 1));
  advance(m, s, 0.0, 0.01);
  writer.write_state(m, s);
  EXPECT_EQ(words_of<float>(directory / "d3plot01").size(), 1u + 6 + 7 * 5 + 9 * 24 + 7 + 2 * 6 + 2 * 33 + 1);
}

TEST(D3plot, RefusalsNameFileAndReason) {
  const Model m = make_model();
  const State s = make_state(m);
  try {
    D3plotWriter writer("/nonexistent/folder/d3plot", label, m, s, {});
    FAIL() << "writing into a folder that is not there must fail";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("/nonexistent/folder/d3plot"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("No such file"));
  }
  Model big = make_model();
  big.shells.id[0] = 3'000'000'000;
  EXPECT_THROW(D3plotWriter(output_directory() / "d3plot", label, big, s, {}), RunError);
}

}  // namespace
}  // namespace kardan

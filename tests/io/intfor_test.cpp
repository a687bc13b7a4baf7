// The interface force family: pressures and forces of segments from the forces of nodes.
#include "kardan/io/d3plot/intfor_writer.hpp"

#include "writers_fixture.hpp"

namespace kardan {
namespace {

using testing::words_of;

/// A square of side 2 and a triangle beside it, numbered against the order of the nodes, pressed by 8 on each node of the square.
struct Pressed {
  Model model;
  State state;
  Pressed() {
    model.nodes.id = {50, 40, 30, 20, 10, 5};
    model.nodes.x = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {4, 0, 0}, {9, 9, 9}};
    Contact contact;
    contact.id = 7;
    model.contacts = {contact};
    state.nodes.resize(6);
    state.nodes.x = model.nodes.x;
    ContactReport report;
    report.segments[1] = {{0, 1, 2, 3}, {1, 4, 2, 2}};
    report.nodes[1] = {0, 1, 2, 3, 4};
    report.nodal_area[1] = {1, 1 + 2. / 3, 1 + 2. / 3, 1, 2. / 3};
    report.nodal_force[1] = {{0, 0, -8}, {0, 0, 0}, {0, 0, 0}, {4, 0, -8}, {0, 0, 0}};
    state.contacts = {report};
  }
};

TEST(Intfor, SegmentsCarryPressureShearAndTheForcesOfTheirNodes) {
  const Pressed p;
  const std::filesystem::path folder = testing::output_directory();
  IntforWriter writer(folder / "intfor", {"title", "version", "date"}, p.model, p.state, {});
  writer.write_state(p.state);
  const auto head = words_of<std::int32_t>(folder / "intfor");
  EXPECT_EQ(head[11], 4) << "file type";
  EXPECT_EQ(head[16], 5) << "only nodes of the surfaces";
  EXPECT_EQ(head[31], 2);
  EXPECT_EQ(head[33], 16);
  const auto state = words_of<float>(folder / "intfor01");
  const std::size_t shells = 1 + 6 + 7 + 5 * 9;
  ASSERT_EQ(state.size(), shells + 2 * 16 + 1);
  const float* square = state.data() + shells;
  EXPECT_FLOAT_EQ(square[0], 16.0f / 4) << "pressure";
  EXPECT_FLOAT_EQ(square[1], 1) << "shear";
  EXPECT_FLOAT_EQ(square[2], 1) << "along the first side";
  EXPECT_FLOAT_EQ(square[3], 0);
  EXPECT_FLOAT_EQ(square[4 + 2], -8) << "force of its first node";
  EXPECT_FLOAT_EQ(square[4 + 9], 4);
  EXPECT_FLOAT_EQ(square[16], 0) << "the triangle carries nothing";
}

TEST(Intfor, ForcesOfSharedNodesAreSplitByArea) {
  Pressed p;
  p.state.contacts[0].nodal_force[1] = {{}, {0, 0, 5}, {}, {}, {}};
  const std::filesystem::path folder = testing::output_directory();
  IntforWriter writer(folder / "intfor", {"title", "version", "date"}, p.model, p.state, {});
  writer.write_state(p.state);
  const auto state = words_of<float>(folder / "intfor01");
  const float* square = state.data() + 1 + 6 + 7 + 5 * 9;
  EXPECT_FLOAT_EQ(square[4 + 3 + 2], 3);
  EXPECT_FLOAT_EQ(square[16 + 4 + 2], 2);
  EXPECT_FLOAT_EQ(square[0] * 4 + square[16] * 2, 5) << "pressures times areas are the force";
}

TEST(Intfor, NothingToWriteWithoutPrintFlags) {
  Pressed p;
  EXPECT_TRUE(IntforWriter::has_surfaces(p.state));
  p.state.contacts[0].segments = {};
  EXPECT_FALSE(IntforWriter::has_surfaces(p.state));
}

}  // namespace
}  // namespace kardan

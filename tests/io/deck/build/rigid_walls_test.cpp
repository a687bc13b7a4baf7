// *RIGIDWALL_PLANAR, *CONTROL_SOLID and the fields of mass scaling and erosion.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string nodes =
    "*NODE\n1,0,0,0.1\n2,1,0,0.2\n3,2,0,0.3\n4,3,0,0.4\n*SET_NODE_LIST\n10\n1,2,3\n*SET_NODE_LIST\n11\n2\n*DEFINE_BOX\n12,-1,1.5,-1,1,-1,1\n";

TEST(BuildRigidWalls, TracksTheNodesOfItsFields) {
  const auto tracked = [](const std::string& card) {
    const Built b(nodes + "*RIGIDWALL_PLANAR\n" + card + "\n0,0,0,0,0,2.0,0.3");
    EXPECT_TRUE(b.diagnostics.ok()) << b.messages();
    EXPECT_TRUE(b.model.unsupported.empty());
    return b.model.rigid_walls.at(0).nodes;
  };
  using Nodes = std::vector<NodeIndex>;
  EXPECT_EQ(tracked("0"), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(tracked("10"), (Nodes{0, 1, 2}));
  EXPECT_EQ(tracked("10,11"), (Nodes{0, 2}));
  EXPECT_EQ(tracked("0,0,12"), (Nodes{0, 1}));
  EXPECT_EQ(tracked("0,0,0,0.25"), (Nodes{0, 1}));
}

TEST(BuildRigidWalls, PlaneFrictionAndLife) {
  const Built b(nodes + "*RIGIDWALL_PLANAR_ID\n5,the wall\n0,0,0,0,0.1,0.7\n0,0,1,0,0,-1,0.3\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const RigidWall& w = b.model.rigid_walls.at(0);
  EXPECT_EQ(w.id, 5);
  EXPECT_EQ(w.title, "the wall");
  EXPECT_EQ(w.point, (Vec3{0, 0, 1}));
  EXPECT_EQ(w.normal, (Vec3{0, 0, -1}));
  EXPECT_EQ((std::array{w.friction, w.birth, w.death}), (std::array{0.3, 0.1, 0.7}));
}

TEST(BuildRigidWalls, WeldingAndNormalsWithoutLengthAreRefused) {
  const Built welded(nodes + "*RIGIDWALL_PLANAR\n0\n0,0,0,0,0,1,2.0");
  EXPECT_NE(welded.unsupported("welded"), nullptr);
  const Built point(nodes + "*RIGIDWALL_PLANAR\n0\n0,0,1,0,0,1");
  EXPECT_FALSE(point.diagnostics.ok());
}

TEST(BuildControls, SolidSortingMassScalingAndErosion) {
  const Built b(nodes + "*CONTROL_SOLID\n1\n*CONTROL_TIMESTEP\n0,0.8,0,0,-1e-6,0,1,1\n");
  EXPECT_TRUE(b.model.unsupported.empty());
  EXPECT_EQ(b.model.control.solid_esort, 1);
  EXPECT_EQ(b.model.control.time_step.dt2ms, -1e-6);
  EXPECT_EQ(b.model.control.time_step.erode, 1);
  EXPECT_TRUE(b.model.control.time_step.scale_mass_once);
  EXPECT_NE(Built(nodes + "*CONTROL_SOLID\n3\n").unsupported("ESORT"), nullptr);
  EXPECT_NE(Built(nodes + "*CONTROL_BULK_VISCOSITY\n1.5,.06,2\n").unsupported("Richards"), nullptr);
  EXPECT_NE(Built(nodes + "*CONTROL_TIMESTEP\n0,0.8,0,0,-1e-6\n0,0,1\n").unsupported("selective mass scaling"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

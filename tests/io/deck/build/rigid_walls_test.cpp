// *RIGIDWALL_…, *CONTROL_SOLID and the fields of mass scaling and erosion.
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

TEST(BuildRigidWalls, PlanarWallsWithAllOptions) {
  const Built b(nodes + "*SET_SEGMENT\n20\n1,2,3,4\n*RIGIDWALL_PLANAR_ORTHO_FINITE_MOVING_FORCES_ID\n5,the wall\n0,0,0,0,0,0,2.5\n0,0,1,0,0,3\n" +
                "0.1,0.2,0.3,0.4,0.5,0.6\n0,0,1,1,0\n2,0,7,4,5\n11,-2\n3,20\n*RIGIDWALL_PLANAR_DISPLAY\n0\n0,0,0,0,0,1,3.0,12\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const RigidWall& w = b.model.rigid_walls.at(0);
  ASSERT_TRUE(w.orthotropic.has_value());
  EXPECT_EQ(w.orthotropic->statical, (std::array{0.1, 0.2}));
  EXPECT_EQ(w.orthotropic->dynamic, (std::array{0.3, 0.4}));
  EXPECT_EQ(w.orthotropic->decay, (std::array{0.5, 0.6}));
  EXPECT_EQ(w.orthotropic->direction, (Vec3{1, 1, 0}));
  EXPECT_EQ(w.edge_l, (Vec3{1, 0, 0}));  // the head need not lie in the plane
  EXPECT_EQ(w.edge_m, (Vec3{0, 1, 0}));
  EXPECT_EQ((std::array{w.length_l, w.length_m, w.mass, w.velocity, w.penalty_scale}), (std::array{4.0, 5.0, 11.0, -2.0, 2.5}));
  EXPECT_EQ(w.soft_cycles, 3);
  EXPECT_EQ(w.segments, (std::vector<std::array<NodeIndex, 4>>{{0, 1, 2, 3}}));
  const RigidWall& sticky = b.model.rigid_walls.at(1);
  EXPECT_TRUE(sticky.welds && !sticky.finite_plane());
  EXPECT_EQ((std::array{sticky.friction, sticky.weld_velocity, sticky.mass}), (std::array{1.0, 12.0, 0.0}));
}

TEST(BuildRigidWalls, GeometricWalls) {
  const Built b(nodes + "*DEFINE_CURVE\n3\n0,0\n1,1\n" +
                "*RIGIDWALL_GEOMETRIC_FLAT_MOTION_DISPLAY\n0\n0,0,0,0,0,1\n1,0,0,2,3\n3,1,0,0,5\n,1e-9\n0\n0,0,1,0,0,2\n1,0,1,2,3\n3,0,1,0,0\n" +
                "*RIGIDWALL_GEOMETRIC_PRISM\n0\n0,0,0,0,0,1\n1,0,0,2,3,4\n" +
                "*RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR_ID\n9,bore\n10,11,0,0.1,0.2\n0,0,0,0,2,0,0.3\n0.7,5,2\n1,2\n3,4\n" +
                "*RIGIDWALL_GEOMETRIC_SPHERE_DISPLAY\n0\n0,0,7,0,0,7,1.0\n0.5\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.rigid_walls.size(), 5u);
  const RigidWall &flat = b.model.rigid_walls[0], &prism = b.model.rigid_walls[2], &bore = b.model.rigid_walls[3], &sphere = b.model.rigid_walls[4];
  using Shape = RigidWall::Shape;
  EXPECT_EQ(flat.shape, Shape::plane);
  EXPECT_EQ(flat.motion, 0);
  EXPECT_TRUE(flat.motion_is_displacement && !b.model.rigid_walls[1].motion_is_displacement);
  EXPECT_EQ(flat.motion_direction, (Vec3{0, 0, 1}));
  EXPECT_EQ(b.model.rigid_walls[1].point, (Vec3{0, 0, 1}));
  EXPECT_EQ(prism.shape, Shape::prism);
  EXPECT_EQ((std::array{prism.length_l, prism.length_m, prism.length_p}), (std::array{2.0, 3.0, 4.0}));
  EXPECT_EQ(bore.shape, Shape::cylinder);
  EXPECT_TRUE(bore.interior);
  EXPECT_EQ(bore.id, 9);
  EXPECT_EQ(bore.nodes, (std::vector<NodeIndex>{0, 2}));
  EXPECT_EQ(bore.normal, (Vec3{0, 1, 0}));
  EXPECT_EQ((std::array{bore.radius, bore.length_p, bore.friction, bore.birth, bore.death}), (std::array{0.7, 5.0, 0.3, 0.1, 0.2}));
  EXPECT_NE(b.messages().find("by sections"), std::string::npos);
  EXPECT_EQ(sphere.shape, Shape::sphere);
  EXPECT_EQ((std::array{sphere.radius, sphere.point.z, sphere.friction}), (std::array{0.5, 7.0, 1.0}));
}

TEST(BuildRigidWalls, FaultsAreReported) {
  EXPECT_NE(Built(nodes + "*RIGIDWALL_GEOMETRIC_SPHERE\n0\n0,0,0,0,0,1,2.0\n1\n").unsupported("welded"), nullptr);
  for (const char* wrong : {"PLANAR\n0\n0,0,1,0,0,1", "PLANAR\n0\n0,0,0,0,0,1,1.5", "PLANAR\n0\n0,0,0,0,0,1,-1", "PLANAR_MOVING\n0\n0,0,0,0,0,1\n0,5",
                            "PLANAR_FINITE\n0\n0,0,0,0,0,1\n0,0,5,1,1", "PLANAR_FINITE\n0\n0,0,0,0,0,1\n1,0,0,-1,1", "GEOMETRIC_SPHERE\n0\n0,0,0\n0",
                            "GEOMETRIC_CYLINDER\n0\n0,0,0,0,0,1\n0,1", "GEOMETRIC_FLAT_MOTION\n0\n0,0,0,0,0,1\n1,0,0\n0,0,0,0,0",
                            "PLANAR_ORTHO\n0\n0,0,0,0,0,1\n0.1\n0,0,0,0,1"})
    EXPECT_FALSE(Built(nodes + "*RIGIDWALL_" + wrong + "\n").diagnostics.ok()) << wrong;
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

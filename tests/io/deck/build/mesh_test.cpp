// *NODE, *ELEMENT_*, *PART, *SECTION, *HOURGLASS.
#include "build_fixture.hpp"

#include "kardan/io/deck/build/measure.hpp"

namespace kardan::deck {
namespace {

TEST(BuildMesh, NodesWithConstraintCodes) {
  const Built b(
      "*NODE\n       7             1.5             2.5             3.5       4       7\n       9             0.0       "
      "      0.0             0.0       6       1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.nodes.size(), 2u);
  EXPECT_EQ(b.model.nodes.x[0], (Vec3{1.5, 2.5, 3.5}));
  EXPECT_EQ(b.model.nodes.constrained[0], dof_x | dof_y | dof_rotations);
  EXPECT_EQ(b.model.nodes.constrained[1], dof_z | dof_x | dof_rx);
  EXPECT_EQ(b.model.nodes.index_of.at(9), 1);
}

TEST(BuildMesh, ShellsTrianglesAndThickness) {
  const Built b(
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*PART\np\n5,6,7\n*SECTION_SHELL\n6,0\n0.5\n*MAT_ELASTIC\n7,2.0,100,0."
      "3\n"
      "*ELEMENT_SHELL\n1,5,1,2,3,4\n2,5,1,2,3\n*ELEMENT_SHELL_THICKNESS\n3,5,1,2,3,4\n.1,.2,.3,.4");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const ShellElements& s = b.model.shells;
  ASSERT_EQ(s.size(), 3u);
  EXPECT_EQ(s.nodes[1], (std::array<NodeIndex, 4>{0, 1, 2, 2}));
  EXPECT_EQ(s.thickness.at(2), (std::array<double, 4>{.1, .2, .3, .4}));
  const Section& section = b.model.sections.at(0);
  EXPECT_EQ(section.shell.elform, 2);
  EXPECT_EQ(section.shell.nip, 2);
  EXPECT_EQ(section.shell.shrf, 1.0);
  EXPECT_EQ(section.shell.thickness, (std::array<double, 4>{.5, .5, .5, .5}));
  // 1 x 0.5 x 2 + 0.5 x 0.5 x 2 + 1 x 0.25 x 2
  EXPECT_NEAR(meshed_masses(b.model).at(0), 2.0, 1e-14);
}

TEST(BuildMesh, SolidsOnOneAndTwoLinesAndDegenerate) {
  const std::string head =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n*PART\np\n1,1,1\n*SECTION_"
      "SOLID\n1,1\n"
      "*MAT_ELASTIC\n1,3.0,100,0.3\n*ELEMENT_SOLID\n";
  const Built one(head + "1,1,1,2,3,4,5,6,7,8\n2,1,1,2,4,5,5,5,5,5\n3,1,1,2,4,5\n4,1,1,2,6,5,4,4,8,8");
  const Built two(head +
                  "       1       1\n       1       2       3       4       5       6       7       8       8       8");
  ASSERT_TRUE(one.diagnostics.ok()) << one.messages();
  ASSERT_TRUE(two.diagnostics.ok()) << two.messages();
  EXPECT_EQ(one.model.solids.nodes[0], two.model.solids.nodes[0]);
  EXPECT_EQ(one.model.solids.nodes[1], one.model.solids.nodes[2]);  // zeros repeat the last node
  EXPECT_NEAR(solid_volume(one.model, 0), 1.0, 1e-14);
  EXPECT_NEAR(solid_volume(one.model, 1), 1.0 / 6, 1e-14);
  EXPECT_NEAR(std::abs(solid_volume(one.model, 3)), 0.5, 1e-14);  // wedge
}

TEST(BuildMesh, DiscreteElementsGroundAndDefaults) {
  const Built b(
      "*NODE\n1,0,0,0\n2,1,0,0\n*PART\ns\n1,1,1\n*SECTION_DISCRETE\n1,1\n0,0\n*MAT_SPRING_ELASTIC\n1,5.0\n*DEFINE_SD_"
      "ORIENTATION\n3,2,0,0,0,1,2\n"
      "*ELEMENT_DISCRETE\n1,1,1,2,3,0.0,1\n2,1,0,2,0,2.5,0,0.25");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const DiscreteElements& d = b.model.discretes;
  EXPECT_EQ(d.scale, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(d.nodes[1], (std::array<NodeIndex, 2>{1, none}));
  EXPECT_EQ(d.orientation, (std::vector<Index>{0, none}));
  EXPECT_EQ(d.print[0], 1);
  EXPECT_EQ(d.offset[1], 0.25);
  EXPECT_EQ(b.model.sd_orientations[0].iop, 2);
  EXPECT_EQ(b.model.sd_orientations[0].nodes, (std::array<NodeIndex, 2>{0, 1}));
}

TEST(BuildMesh, MassesAndInertia) {
  const Built b(two_blocks +
                "*SET_NODE_LIST\n5\n21,22,23\n*ELEMENT_MASS\n1,21,4.0,1\n*ELEMENT_MASS_NODE_SET\n2,5,0.5\n*ELEMENT_"
                "MASS_PART\n1,8.0\n*ELEMENT_INERTIA\n3,22\n1,.1,.2,2,.3,3,9");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.masses.size(), 1u + 3u + 8u);
  EXPECT_EQ(b.model.masses[0].part, 0);
  EXPECT_EQ(b.model.masses[2].mass, 0.5);
  EXPECT_NEAR(b.model.masses[5].mass, 1.0, 1e-15);
  EXPECT_NEAR(meshed_masses(b.model)[0], 2.0 + 4.0 + 8.0, 1e-13);
  EXPECT_EQ(b.model.inertias[0].mass, 9);
  EXPECT_EQ(b.model.inertias[0].inertia[1], (Vec3{.1, 2, .3}));
}

TEST(BuildMesh, ManyPartsInOneBlockAndHourglass) {
  const Built b(
      "*PART\none\n1,1,1,0,4\ntwo\n2,1,1\n*SECTION_SHELL_TITLE\nsheet\n1,16,0.83,5\n1.\n*MAT_ELASTIC_TITLE\nsteel\n1,1,"
      "1,.3\n*HOURGLASS\n4,5,0.05");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.parts.size(), 2u);
  EXPECT_EQ(b.model.parts[1].title, "two");
  EXPECT_EQ(b.model.parts[0].hourglass, 0);
  EXPECT_EQ(b.model.hourglasses[0].type, 5);
  EXPECT_EQ(b.model.hourglasses[0].coefficient, 0.05);
  EXPECT_EQ(b.model.sections[0].title, "sheet");
  EXPECT_EQ(b.model.sections[0].shell.elform, 16);
  EXPECT_EQ(b.model.materials[0].title, "steel");
}

TEST(BuildMesh, PartInertiaWithLocalAxes) {
  const Built b(
      "*NODE\n4,1,2,3\n*SECTION_SOLID\n1\n*MAT_RIGID\n1,1,1,.3\n0\n0\n*PART_INERTIA\nbody\n1,1,1\n0,0,0,5.0,1,4\n1,.1,."
      "2,2,.3,3\n7,8,9,.7,.8,.9\n0,1,0,-1,0,0\n"
      "second\n2,1,1\n.5,.6,.7,2\n1,0,0,1,0,1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const GivenInertia& g = *b.model.parts[0].inertia;
  EXPECT_EQ(g.center, (Vec3{1, 2, 3}));
  EXPECT_EQ(g.mass, 5);
  EXPECT_EQ(g.inertia[0], (Vec3{1, .1, .2}));
  EXPECT_EQ(g.velocity, (Vec3{7, 8, 9}));
  EXPECT_EQ(g.angular_velocity, (Vec3{.7, .8, .9}));
  ASSERT_TRUE(g.axes.has_value());
  EXPECT_EQ(g.axes->column(0), (Vec3{0, 1, 0}));
  EXPECT_EQ(g.axes->column(1), (Vec3{-1, 0, 0}));
  EXPECT_EQ(g.axes->column(2), (Vec3{0, 0, 1}));
  EXPECT_EQ(b.model.parts[1].inertia->center, (Vec3{.5, .6, .7}));
  EXPECT_FALSE(b.model.parts[1].inertia->axes.has_value());
}

TEST(BuildMesh, MaterialsRigidSpringsAndUnknownLaws) {
  const Built b(
      "*DEFINE_CURVE\n9\n0,0\n1,1\n*DEFINE_COORDINATE_VECTOR\n3,0,1,0,-1,0,0\n*MAT_020\n1,7.8,210.,.3\n-1,3,"
      "101011\n3\n*MAT_RIGID\n2,7.8,210.,.3\n2,4,7,0,1.,2.,3.\n0\n"
      "*MAT_S03\n4,10,1,5\n*MAT_SPRING_INELASTIC\n5,9,3.,1.\n*MAT_SPRING_NONLINEAR_ELASTIC\n6,9\n*MAT_BARLAT_ANISOTROPIC_"
      "PLASTICITY\n8,2.7,70,.33");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& rigid = std::get<RigidMaterial>(b.model.materials[0].law);
  EXPECT_EQ(rigid.frame, 0);
  EXPECT_EQ(rigid.output_frame, 0);
  EXPECT_EQ(rigid.con2, dof_x | dof_z | dof_ry | dof_rz);
  const auto& at_point = std::get<RigidMaterial>(b.model.materials[1].law);
  EXPECT_EQ(at_point.con1, 4);
  EXPECT_EQ(at_point.constraint_point, (Vec3{1, 2, 3}));
  const auto& plastic = std::get<SpringMaterial>(b.model.materials[2].law);
  EXPECT_EQ(plastic.law, SpringLaw::elastoplastic_spring);
  EXPECT_EQ(plastic.p[2], 5);
  const auto& inelastic = std::get<SpringMaterial>(b.model.materials[3].law);
  EXPECT_EQ(inelastic.curve[0], 0);
  EXPECT_EQ(inelastic.p[0], 3);
  EXPECT_EQ(std::get<SpringMaterial>(b.model.materials[4].law).curve[1], none);
  const auto& unknown = std::get<UnsupportedMaterial>(b.model.materials[5].law);
  EXPECT_EQ(unknown.density, 2.7);
  EXPECT_EQ(unknown.youngs_modulus, 70);
  EXPECT_TRUE(b.model.unsupported.empty());  // nobody is made of it
}

}  // namespace
}  // namespace kardan::deck

// Rigid bodies, merges, extra nodes, joints, stiffnesses, stoppers.
#include "build_fixture.hpp"

#include <numbers>

namespace kardan::deck {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(BuildRigid, NodalRigidBodiesArePartsToo) {
  const Built b(
      two_blocks +
      "*SET_NODE_LIST\n77\n21,22\n*SET_NODE_LIST\n5\n23,24,25\n*CONSTRAINED_NODAL_RIGID_BODY\n77,0,0\n*CONSTRAINED_"
      "NODAL_RIGID_BODY_SPC_INERTIA_TITLE\nhub\n78,0,5,26\n1,7,4\n1,2,3,9\n"
      "1,0,0,1,0,1\n*LOAD_RIGID_BODY\n77,3,1,2.5\n*DEFINE_CURVE\n1\n0,1\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n78,6,0,1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.nodal_rigid_bodies.size(), 2u);
  const NodalRigidBody& first = b.model.nodal_rigid_bodies[0];
  EXPECT_EQ(first.nodes.size(), 2u);
  ASSERT_EQ(b.model.parts.size(), 4u);
  EXPECT_EQ(b.model.parts[2].id, 77);
  EXPECT_EQ(b.model.parts[2].nodal_rigid_body, 0);
  EXPECT_EQ(b.model.parts[2].material, none);
  EXPECT_EQ(first.part, 2);
  EXPECT_TRUE(b.model.body_part(2));
  EXPECT_FALSE(b.model.rigid_part(2));
  EXPECT_EQ(b.model.point_loads[0].body_part, 2);
  EXPECT_EQ(b.model.prescribed_motions[0].body_part, 3);
  const NodalRigidBody& hub = b.model.nodal_rigid_bodies[1];
  EXPECT_EQ(hub.title, "hub");
  EXPECT_EQ(hub.cmo, 1.0);
  EXPECT_EQ(hub.con1, 7);
  EXPECT_EQ(hub.inertia->mass, 9);
  EXPECT_EQ(b.model.nodes.id[static_cast<std::size_t>(hub.print_node)], 26);
}

TEST(BuildRigid, MergesInColumnsOfTenAndEight) {
  const std::string parts =
      "*PART\na\n12345678,1,1\nb\n87654321,1,1\nc\n3,1,1\n*SECTION_SOLID\n1\n*MAT_RIGID\n1,1,1,.3\n0\n0\n";
  const Built ten(parts + "*CONSTRAINED_RIGID_BODIES\n  12345678  87654321         1\n  87654321         3");
  ASSERT_TRUE(ten.diagnostics.ok()) << ten.messages();
  ASSERT_EQ(ten.model.merges.size(), 2u);
  EXPECT_EQ(ten.model.merges[0].iflag, 1);
  EXPECT_EQ(ten.model.merges[1].constrained, 2);
  const Built eight(parts + "*CONSTRAINED_RIGID_BODIES\n1234567887654321       1");
  ASSERT_TRUE(eight.diagnostics.ok()) << eight.messages();
  ASSERT_EQ(eight.model.merges.size(), 1u);
  EXPECT_EQ(eight.model.merges[0].lead, 0);
  EXPECT_EQ(eight.model.merges[0].constrained, 1);
  EXPECT_EQ(eight.model.merges[0].iflag, 1);
}

TEST(BuildRigid, ExtraNodesAndStoppers) {
  const Built b(two_blocks +
                "*CONSTRAINED_EXTRA_NODES_NODE\n1,21\n2,22,1\n*SET_NODE_LIST\n4\n23,24\n*CONSTRAINED_EXTRA_NODES_"
                "SET\n1,4\n*SET_PART_COLUMN\n6\n2,.75\n"
                "*DEFINE_CURVE\n1\n0,1\n*DEFINE_VECTOR\n9,0,0,0,1,1,0\n*CONSTRAINED_RIGID_BODY_STOPPERS\n1,-1,1,6,0,1,"
                "4,9\n.1,.9");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.extra_nodes.size(), 3u);
  EXPECT_EQ(b.model.extra_nodes[1].iflag, 1);
  EXPECT_EQ(b.model.extra_nodes[2].nodes.size(), 2u);
  const RigidBodyStopper& s = b.model.stoppers.at(0);
  EXPECT_TRUE(s.maximum.displacement);
  EXPECT_FALSE(s.minimum.displacement);
  EXPECT_EQ(s.maximum.curve, 0);
  EXPECT_EQ(s.direction, 4);
  EXPECT_EQ(s.vector, 0);
  ASSERT_EQ(s.followers_maximum.size(), 1u);
  EXPECT_EQ(s.followers_maximum[0].closure, .75);
  EXPECT_EQ(s.death, .9);
}

TEST(BuildJoints, EveryKindAndOption) {
  const Built b(two_blocks +
                "*CONSTRAINED_JOINT_SPHERICAL\n5,11\n6,12,0,0,0,0,2.0,0.01\n*CONSTRAINED_JOINT_REVOLUTE_ID\n40,hinge "
                "of the flap\n5,11,6,12\n"
                "*CONSTRAINED_JOINT_TRANSLATIONAL_LOCAL_FAILURE\n5,11,6,12,8,14\n1,0\n0,.5,1.5\n1,2,3,4,5,6\n*"
                "CONSTRAINED_JOINT_ROTATIONAL_MOTOR\n5,11,6,12\n0,1,2\n"
                "*CONSTRAINED_JOINT_GEARS\n5,11,6,12\n2.5,0,0,.4\n*CONSTRAINED_JOINT_COOR_REVOLUTE_ID\n50,by "
                "points\n1,2\n0,0,1\n\n1,0,1\n1,0,1\n*DEFINE_CURVE\n1\n0,0\n1,1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& j = b.model.joints;
  ASSERT_EQ(j.size(), 7u);
  EXPECT_EQ(j[0].kind, JointKind::spherical);
  EXPECT_EQ(j[0].id, 1);
  EXPECT_EQ(j[0].damp, 1.0);
  EXPECT_EQ(j[1].rps, 2.0);
  EXPECT_EQ(j[1].damp, 0.01);
  EXPECT_EQ(j[2].id, 40);
  EXPECT_EQ(j[2].title, "hinge of the flap");
  EXPECT_EQ(j[3].local_body, 0);
  ASSERT_TRUE(j[3].failure.has_value());
  EXPECT_EQ(j[3].failure->time, .5);
  EXPECT_EQ(j[3].failure->limits[5], 6);
  EXPECT_EQ(j[4].curve, 0);
  EXPECT_EQ(j[4].motor_type, 2);
  EXPECT_EQ(j[5].parameter, 2.5);
  EXPECT_EQ(j[5].radius_1, .4);
  ASSERT_TRUE(j[6].points.has_value());
  EXPECT_EQ((*j[6].points)[1], (Vec3{0, 0, 1}));  // blank: that of body A
  EXPECT_EQ((*j[6].points)[2], (Vec3{1, 0, 1}));
  EXPECT_EQ(j[6].part_b, 1);
}

TEST(BuildJoints, StiffnessesAnglesInRadiansAndFrictionCurves) {
  const Built b(two_blocks +
                "*DEFINE_COORDINATE_VECTOR\n1,1,0,0,0,1,0\n*DEFINE_CURVE\n4\n0,0\n1,1\n*CONSTRAINED_JOINT_STIFFNESS_"
                "GENERALIZED\n7,1,2,1\n4,0,0,0,4\n191,80,10,-4\n-30,45\n"
                "*CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL\n8,1,2,1\n0,4\n5,6,7,8\n-.1,.2,-.3,.4\n*CONSTRAINED_JOINT_"
                "STIFFNESS_FLEXION-TORSION\n9,1,2,1\n4,4\n3,2,1,.5\n90,-10,20\n"
                "*CONSTRAINED_JOINT_STIFFNESS_CYLINDRICAL\n10,1,2,1\n4,,4\n1,2,,,3,4\n,.5,,,-.6,.7");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_TRUE(b.model.unsupported.empty()) << b.messages();
  const auto& s = b.model.joint_stiffnesses;
  ASSERT_EQ(s.size(), 4u);
  EXPECT_EQ(s[0].frame_b, s[0].frame_a);
  EXPECT_EQ(s[0].coordinate[0].moment, 0);
  EXPECT_EQ(s[0].coordinate[1].damping, 0);
  EXPECT_EQ(s[0].coordinate[0].elastic, 191);
  EXPECT_EQ(s[0].coordinate[0].friction, 80);
  EXPECT_EQ(s[0].coordinate[1].friction_curve, 0);
  EXPECT_NEAR(s[0].coordinate[0].stop_negative, -30 * degree, 1e-15);
  EXPECT_NEAR(s[0].coordinate[0].stop_positive, 45 * degree, 1e-15);
  EXPECT_EQ(s[1].coordinate[1].moment, 0);
  EXPECT_EQ(s[1].coordinate[1].stop_positive, .4);
  EXPECT_EQ(s[2].moment_scale, 0);
  EXPECT_NEAR(s[2].coordinate[0].stop_positive, 90 * degree, 1e-15);
  EXPECT_NEAR(s[2].coordinate[2].stop_negative, -10 * degree, 1e-15);
  EXPECT_EQ(s[2].coordinate[2].friction, .5);
  EXPECT_EQ(s[3].coordinate[0].stop_positive, .5);
  EXPECT_EQ(s[3].coordinate[2].stop_negative, -.6);
  EXPECT_EQ(s[3].coordinate[2].friction, 4);
}

TEST(BuildRigid, ConstraintsAtAPointAndReleasesAreRefused) {
  const std::string bodies =
      "*PART\na\n1,1,1\nb\n2,1,2\n*SECTION_SOLID\n1\n*MAT_RIGID\n1,1,1,.3\n2,7,7,0,1,2,3\n0\n*MAT_RIGID\n2,1,1,.3\n";
  const Built held(bodies + "2,7,7\n0");
  EXPECT_TRUE(held.model.unsupported.empty()) << held.messages();
  const Built turning(
      bodies + "2,7,4\n0\n*NODE\n1,0,0,0\n2,1,0,0\n*SET_NODE\n9\n1,2\n*CONSTRAINED_NODAL_RIGID_BODY\n9,0,0,0,0,1");
  EXPECT_NE(turning.unsupported("field CMO: a constraint of the body at a point"), nullptr) << turning.messages();
  EXPECT_NE(turning.unsupported("field DRFLAG: a release"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

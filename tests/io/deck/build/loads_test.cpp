// *BOUNDARY, *INITIAL_VELOCITY, *LOAD, *CONTROL, *DATABASE, include transformations.
#include <unistd.h>

#include "build_fixture.hpp"

#include <filesystem>
#include <fstream>

#include "kardan/io/deck/load.hpp"
#include "kardan/io/report/model_report.hpp"

namespace kardan::deck {
namespace {

TEST(BuildLoads, Supports) {
  const Built b(two_blocks +
                "*BOUNDARY_SPC_NODE_ID\n9,wall\n21,0,1,0,1,0,0,1\n*SET_NODE\n3\n22,23\n*BOUNDARY_SPC_SET_BIRTH_"
                "DEATH\n3,0,1,1,1\n.2,.4");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.constraints.size(), 2u);
  EXPECT_EQ(b.model.constraints[0].id, 9);
  EXPECT_EQ(b.model.constraints[0].dofs, dof_x | dof_z | dof_rz);
  EXPECT_EQ(b.model.constraints[1].nodes.size(), 2u);
  EXPECT_EQ(b.model.constraints[1].birth, .2);
  EXPECT_EQ(b.model.constraints[1].death, .4);
}

TEST(BuildLoads, PrescribedMotions) {
  const Built b(two_blocks +
                "*DEFINE_CURVE\n1\n0,0\n1,1\n*DEFINE_VECTOR\n5,0,0,0,0,0,2\n*BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL\n1,"
                "7,2,1,-3.,0,.8,.1\n"
                "*BOUNDARY_PRESCRIBED_MOTION_RIGID_ID\n3,push\n2,-4,0,1,1.,5\n4,\n1,1,4,1\n0,0,2,21,22\n*BOUNDARY_"
                "PRESCRIBED_MOTION_NODE\n25,9,2,1\n.5,.25\n26,1,0,0,2.5");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& m = b.model.prescribed_motions;
  ASSERT_EQ(m.size(), 4u);
  EXPECT_TRUE(m[0].local);
  EXPECT_EQ(m[0].kind, MotionKind::displacement);
  EXPECT_EQ(m[0].scale, -3);
  EXPECT_EQ(m[0].death, .8);
  EXPECT_EQ(m[0].birth, .1);
  EXPECT_EQ(m[1].id, 3);
  EXPECT_EQ(m[1].dof, -4);
  EXPECT_EQ(m[1].vector, 0);
  EXPECT_EQ(m[1].death, 1e28);
  // VAD = 4: a motor between the two bodies.
  ASSERT_EQ(b.model.joints.size(), 1u);
  EXPECT_EQ(b.model.joints[0].kind, JointKind::translational_motor);
  EXPECT_EQ(b.model.joints[0].part_a, 1);
  EXPECT_EQ(b.model.joints[0].part_b, 0);
  EXPECT_EQ(b.model.joints[0].motor_type, 2);
  EXPECT_EQ(m[2].offset_1, .5);
  // Curve 0: the factor acts as a constant, and that is said.
  EXPECT_EQ(b.model.curves[static_cast<std::size_t>(m[3].curve)].value(0.7), 1.0);
  EXPECT_NE(b.warning("acts as a constant"), nullptr);
}

TEST(BuildLoads, InitialVelocities) {
  const Built b(two_blocks +
                "*SET_NODE\n1\n21,22\n*SET_NODE\n2\n22\n*INITIAL_VELOCITY\n1,2\n1,2,3,4,5,6\n7,8,9\n*INITIAL_"
                "VELOCITY\n0,0,0,-1\n5.\n*INITIAL_VELOCITY_NODE\n23,0,90,0,300\n"
                "*INITIAL_VELOCITY_RIGID_BODY\n2,1,2,3,.1,.2,.3\n*INITIAL_VELOCITY_GENERATION\n1,2,10.,1,2,3\n0,0,1,0,"
                "0,1\n*INITIAL_VELOCITY\n0,0,4\n1.\n*DEFINE_BOX\n4,1.5,9,-1,1,-1,9");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& v = b.model.initial_velocities;
  ASSERT_EQ(v.size(), 6u);
  EXPECT_EQ(v[0].exempt.size(), 1u);
  EXPECT_EQ(v[0].exempt_velocity, (Vec3{7, 8, 9}));
  EXPECT_EQ(v[0].angular_velocity, (Vec3{4, 5, 6}));
  EXPECT_FALSE(v[0].include_rigid);
  EXPECT_TRUE(v[1].all_nodes);
  EXPECT_TRUE(v[1].include_rigid);
  EXPECT_EQ(v[4].nodes.size(), 8u);
  EXPECT_EQ(v[4].omega, 10);
  EXPECT_EQ(v[4].axis_point, (Vec3{0, 0, 1}));
  EXPECT_EQ(v[5].nodes.size(), 5u);  // 21 to 25 lie in the box
  const auto rigid =
      std::find_if(v.begin(), v.end(), [](const auto& x) { return x.kind == InitialVelocity::Kind::rigid_body; });
  ASSERT_NE(rigid, v.end());
  EXPECT_EQ(rigid->body_part, 1);
  EXPECT_EQ(rigid->angular_velocity, (Vec3{.1, .2, .3}));
}

TEST(BuildLoads, BodyAndPointLoads) {
  const Built b(two_blocks +
                "*DEFINE_CURVE\n1\n0,9.81\n*LOAD_BODY_Z\n1,2.\n*LOAD_BODY_RY\n1,1.,0,1,2,3\n*LOAD_BODY_VECTOR\n1\n1,1,"
                "0\n*SET_PART\n3\n2\n*LOAD_BODY_PARTS\n3\n"
                "*LOAD_RIGID_BODY\n1,5,1\n2,4,1,-2.,0,21,22,23\n*LOAD_NODE_POINT\n21,3,1,7.\n*SET_NODE\n5\n22,23\n*"
                "LOAD_NODE_SET\n5,1,1");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.body_loads.size(), 3u);
  EXPECT_EQ(b.model.body_loads[0].axis, 2);
  EXPECT_EQ(b.model.body_loads[0].parts, (std::vector<PartIndex>{1}));
  EXPECT_EQ(b.model.body_loads[1].axis, 4);
  EXPECT_EQ(b.model.body_loads[1].center, (Vec3{1, 2, 3}));
  EXPECT_EQ(b.model.body_loads[2].vector, (Vec3{1, 1, 0}));
  ASSERT_EQ(b.model.point_loads.size(), 4u);
  EXPECT_EQ(b.model.point_loads[0].dof, 5);
  EXPECT_NE(b.model.point_loads[1].m[2], none);
  EXPECT_EQ(b.model.point_loads[3].nodes.size(), 2u);
}

TEST(BuildControl, HoldingOfJoints) {
  // A written 0 asks for penalty joints; a blank field says nothing.
  EXPECT_EQ(Built(two_blocks + "*CONTROL_RIGID\n0,1").model.control.rigid.lmf, 0);
  EXPECT_EQ(Built(two_blocks + "*CONTROL_RIGID\n,1").model.control.rigid.lmf, -1);
  EXPECT_EQ(Built(two_blocks).model.control.rigid.lmf, -1);
}

TEST(BuildControl, ControlsAndResults) {
  const Built b(two_blocks +
                "*TITLE\n a mechanism "
                "\n*CONTROL_TIMESTEP\n0,.67\n*CONTROL_RIGID\n1,1\n0,5.\n*CONTROL_HOURGLASS\n4,.05\n*DATABASE_"
                "GLSTAT\n1e-3,2\n*DATABASE_BINARY_D3PLOT\n0.1,0,0,20\n"
                "*DATABASE_HISTORY_NODE\n1,2,3\n*DATABASE_HISTORY_NODE_ID\n21,tip of the "
                "arm\n*SET_NODE\n8\n5\n*DATABASE_HISTORY_NODE_SET\n8");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_EQ(b.model.title, "a mechanism");
  EXPECT_EQ(b.model.control.termination.end_time, 1.0);
  EXPECT_EQ(b.model.control.time_step.scale, .67);
  EXPECT_EQ(b.model.control.rigid.lmf, 1);
  EXPECT_EQ(b.model.control.rigid.gjadstf, 5);
  EXPECT_EQ(b.model.control.hourglass_type, 4);
  EXPECT_EQ(b.model.output.requests.at(OutputFile::glstat).binary, 2);
  EXPECT_NEAR(b.model.output.requests.at(OutputFile::d3plot).dt, 0.05, 1e-15);
  EXPECT_EQ(b.model.output.history_nodes.size(), 5u);
  const std::string report = model_report(b.model);
  EXPECT_NE(report.find("lower"), std::string::npos) << report;
  EXPECT_NE(report.find("rigid parts          2"), std::string::npos) << report;
  EXPECT_NE(report.find("x 0 to 3"), std::string::npos) << report;
}

TEST(BuildErrors, ReferencesAreNamedPrecisely) {
  const Built b(two_blocks +
                "*CONSTRAINED_JOINT_REVOLUTE\n5,11,6,999\n*LOAD_RIGID_BODY\n8,1,1\n*LOAD_NODE_POINT\n1,9,0\n*BOUNDARY_"
                "SPC_NODE\n1,5,2\n*CONSTRAINED_RIGID_BODIES\n1,1");
  const Diagnostic* node = b.error("field N4: node 999 is not defined");
  ASSERT_NE(node, nullptr) << b.messages();
  EXPECT_EQ(node->where.file, "deck.k");
  EXPECT_EQ(node->keyword, "*CONSTRAINED_JOINT_REVOLUTE");
  EXPECT_FALSE(node->cure.empty());
  EXPECT_NE(b.error("field PID: part 8 is not defined"), nullptr);
  EXPECT_NE(b.error("field LCID: curve 1 is not defined"), nullptr);
  EXPECT_NE(b.error("field DOF: found 9, expected 1 to 8"), nullptr);
  EXPECT_NE(b.error("coordinate system 5 is not defined"), nullptr);
  EXPECT_NE(b.error("field DOFX: found 2, expected 0 to 1"), nullptr);
  EXPECT_NE(b.error("merged with itself"), nullptr);
}

TEST(BuildErrors, ElementsAndParts) {
  const Built b(
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n2,1,0,0\n3,9,9,9\n*PART\np\n1,0,0\nq\n1,0,0\nr\n2,7,1\n*SECTION_"
      "BEAM\n7,1\n1,1,1,1\n*MAT_SPRING_ELASTIC\n1,1\n"
      "*ELEMENT_SHELL\n1,1,1,2,3,4\n1,1,1,2,3,4\n2,1,1,2,2,4\n3,1,1,2,88\n4,6,1,2,3\n5,2,1,2,3");
  EXPECT_NE(b.warning("node 2 is defined twice with the same coordinates"), nullptr) << b.messages();
  EXPECT_NE(b.error("node 3 is defined twice with different coordinates"), nullptr);
  EXPECT_NE(b.error("part 1 is defined twice; first at deck.k:"), nullptr);
  EXPECT_NE(b.error("part 1 has elements but no section"), nullptr);
  EXPECT_NE(b.error("part 1 has elements but no material"), nullptr);
  EXPECT_NE(b.error("part 2 has shell elements but section 7 is one for beam elements"), nullptr);
  EXPECT_NE(b.error("spring or damper material but elements that are not discrete"), nullptr);
  EXPECT_NE(b.error("shell 1 is defined twice"), nullptr);
  EXPECT_NE(b.error("node 2 is repeated in shell 2"), nullptr);
  EXPECT_NE(b.error("node 88 of shell 3 is not defined"), nullptr);
  EXPECT_NE(b.error("part 6 of shell 4 is not defined"), nullptr);
}

TEST(BuildErrors, WhatIsNotHonouredIsSaid) {
  const Built b(two_blocks +
                "*MAT_033\n5,7.8,210,.3\n*PART\nsoft\n9,1,5\n*ELEMENT_SOLID\n3,9,1,2,3,4,5,6,7,8\n*DEFINE_CURVE\n1\n0,1\n*LOAD_BODY_X\n1,1\n"
                "*CONSTRAINED_JOINT_GEARS\n5,11,6,12\n2.,0,0,0,15.\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,1,0,1,1.,-3");
  EXPECT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_NE(b.unsupported("material 5 of the deformable part 9"), nullptr) << b.messages();
  EXPECT_NE(b.unsupported("helix angle"), nullptr);
  EXPECT_NE(b.unsupported("field VID: a motion along the axes"), nullptr);
  EXPECT_NE(model_report(b.model).find("cannot run this model (3 reasons"), std::string::npos);
}

TEST(BuildErrors, AtMostFiftyAreKept) {
  std::string text = two_blocks + "*LOAD_NODE_POINT\n";
  for (int i = 0; i < 200; ++i) text += "9999,1,77\n";
  const Built b(text);
  EXPECT_EQ(b.diagnostics.error_count(), 400u);
  EXPECT_LE(b.diagnostics.all().size(), 60u);
}

TEST(BuildInclude, TransformShiftsNumbersUnitsAndPlaces) {
  const auto folder = std::filesystem::temp_directory_path() / ("kardan_build_include_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "part.k")
      << "*KEYWORD\n"
      << two_blocks
      << "*SET_NODE\n4\n1,2\n*DEFINE_COORDINATE_VECTOR\n2,1,0,0,0,1,0\n*CONSTRAINED_JOINT_SPHERICAL\n5,11\n*END\n";
  std::ofstream(folder / "main.k")
      << "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*DEFINE_TRANSFORMATION\n5\nROTATE,0,0,1,0,0,0,90.\nTRANSL,10.,0,0\n"
         "*INCLUDE_TRANSFORM\npart.k\n100,200,300,400,500,600,700\n800\n1000.,1.,.001\n5\n*LOAD_RIGID_BODY\n301,1,1\n*"
         "DEFINE_CURVE\n1\n0,1\n*BOUNDARY_SPC_SET\n504,702,1,1,1\n*END\n";
  Diagnostics diagnostics;
  const Model m = load_model(folder / "main.k", {}, diagnostics);
  std::string all;
  for (const auto& d : diagnostics.all()) all += to_string(d) + "\n";
  ASSERT_TRUE(diagnostics.ok()) << all;
  const Vec3 x = m.nodes.x[static_cast<std::size_t>(m.nodes.index_of.at(102))];  // (1,0,0) mm -> 0.001 m along y, moved
  EXPECT_NEAR(x.x, 10, 1e-12);
  EXPECT_NEAR(x.y, .001, 1e-15);
  EXPECT_EQ(m.parts[0].id, 301);
  EXPECT_EQ(m.solids.id[1], 202);
  EXPECT_EQ(m.materials[0].id, 401);
  EXPECT_NEAR(std::get<RigidMaterial>(m.materials[0].law).density, 2.0 * 1000 / 1e-9, 1);
  EXPECT_NEAR(m.frames[0].axes.column(0).y, 1, 1e-15);
  EXPECT_EQ(m.constraints.at(0).nodes.size(), 2u);
  std::filesystem::remove_all(folder);
}

TEST(BuildTable, EveryHonouredKeywordHasAPlace) {
  const std::set<std::string> readers{"*",
                                      "KEYWORD",
                                      "END",
                                      "COMMENT",
                                      "INCLUDE",
                                      "INCLUDE_PATH",
                                      "INCLUDE_TRANSFORM",
                                      "DEFINE_TRANSFORMATION",
                                      "PARAMETER",
                                      "PARAMETER_DUPLICATION"};
  for (const KeywordInfo& info : Schema::instance().keywords()) {
    EXPECT_TRUE(info.status != KeywordStatus::honoured || readers.contains(info.name) || builds(info.name))
        << info.name;
  }
}

}  // namespace
}  // namespace kardan::deck

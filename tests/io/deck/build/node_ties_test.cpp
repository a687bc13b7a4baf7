// *DAMPING, welds, ties of nodes, *BOUNDARY_NON_REFLECTING, *CONTROL_DYNAMIC_RELAXATION.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string curve = "*DEFINE_CURVE\n4\n0,0\n1,5\n";

TEST(BuildDamping, GlobalPartAndRelative) {
  const Built b(two_blocks + curve + "*DAMPING_GLOBAL\n0,12.\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.dampings.size(), 1u);
  EXPECT_EQ(b.model.dampings[0].value, 12);
  EXPECT_EQ(b.model.dampings[0].rotation, (Vec3{1, 1, 1}));  // all blank: all one
  const Built p(two_blocks + curve +
                "*DAMPING_PART_MASS\n1,4,2.,1\n1.,.5,,,,3.\n2,4\n*SET_PART\n3\n1,2\n*DAMPING_PART_MASS_SET\n3,4\n"
                "*DAMPING_RELATIVE\n.05,20.,2,3\n");
  ASSERT_TRUE(p.diagnostics.ok()) << p.messages();
  const auto& d = p.model.dampings;
  ASSERT_EQ(d.size(), 4u);
  EXPECT_EQ(d[0].value, 2);
  EXPECT_EQ(d[0].translation, (Vec3{1, .5, 0}));
  EXPECT_EQ(d[0].rotation, (Vec3{0, 0, 3}));
  EXPECT_EQ(d[1].translation, (Vec3{1, 1, 1}));
  EXPECT_EQ(d[2].parts.size(), 2u);
  EXPECT_EQ(d[3].relative_to, 1);
  EXPECT_EQ(d[3].frequency, 20);
  EXPECT_EQ(d[3].value, .05);
}

TEST(BuildDamping, Refusals) {
  const Built b(two_blocks + curve + "*DAMPING_PART_MASS\n1,4,2.,0,1\n*DAMPING_GLOBAL\n0,-1.\n*DAMPING_PART_MASS\n1,0\n*SET_PART\n3\n1\n"
                "*DAMPING_RELATIVE\n.05,0.,2,3,7.\n");
  EXPECT_NE(b.unsupported("field STRUC"), nullptr) << b.messages();
  EXPECT_NE(b.error("cannot be combined with *DAMPING_PART_MASS"), nullptr);
  EXPECT_NE(b.error("field VALDMP: is negative"), nullptr);
  EXPECT_NE(b.error("field LCID: is blank or 0"), nullptr);
  EXPECT_NE(b.error("field FREQ"), nullptr);
  EXPECT_NE(b.unsupported("field DV2"), nullptr);
}

TEST(BuildDamping, StiffnessByPartAndSet) {
  const Built b(two_blocks + "*DAMPING_PART_STIFFNESS\n1,.1\n2,-1.e-5\n*SET_PART\n3\n1,2\n*DAMPING_PART_STIFFNESS_SET\n3,.05\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const auto& d = b.model.stiffness_dampings;
  ASSERT_EQ(d.size(), 3u);
  EXPECT_EQ(d[0].fraction, .1);
  EXPECT_EQ(d[0].beta, 0);
  EXPECT_EQ(d[1].fraction, 0);
  EXPECT_EQ(d[1].beta, 1e-5);
  EXPECT_EQ(d[2].parts, (std::vector<PartIndex>{0, 1}));
  EXPECT_FALSE(Built(two_blocks + "*DAMPING_PART_STIFFNESS\n1,10.\n").diagnostics.ok());
}

TEST(BuildTies, InterpolationInLocalAxes) {
  const Built b(two_blocks + "*DEFINE_COORDINATE_SYSTEM\n6,0,0,0,0,1,0\n-1,0,0\n"
                             "*CONSTRAINED_INTERPOLATION_LOCAL\n5,26,12,6\n21,123,2.\n6\n22,123,1.\n0\n23,123\n0\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const Interpolation& tie = b.model.interpolations.at(0);
  EXPECT_EQ(tie.frame, 0);
  EXPECT_EQ(tie.dofs, dof_x | dof_y);
  EXPECT_EQ(tie.nodes.size(), 3u);
  EXPECT_FALSE(tie.asks_rotations);
}

TEST(BuildTies, WeldsNodeSetsEquationsAndInterpolation) {
  const Built b(two_blocks + "*SET_NODE\n3\n21,22,23\n*CONSTRAINED_SPOTWELD_ID\n8\n21,24,100.,50.,2.,3.,.5\n9\n22,25\n"
                "*CONSTRAINED_GENERALIZED_WELD_FILLET\n3\n.25\n*CONSTRAINED_NODE_SET\n3,5\n"
                "*CONSTRAINED_LINEAR_GLOBAL\n17\n21,2,1.\n22,6,-2.5\n*CONSTRAINED_INTERPOLATION\n5,26,1236\n21,123,2.\n22,123,1.\n23,123\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.rigid_groups.size(), 3u);
  EXPECT_EQ(b.model.rigid_groups[0].name, "weld 8");
  ASSERT_TRUE(b.model.rigid_groups[0].failure.has_value());
  EXPECT_EQ(b.model.rigid_groups[0].failure->shear, 50);
  EXPECT_EQ(b.model.rigid_groups[0].failure->shear_exponent, 3);
  EXPECT_EQ(b.model.rigid_groups[0].death, .5);
  EXPECT_FALSE(b.model.rigid_groups[1].failure.has_value());
  EXPECT_EQ(b.model.rigid_groups[1].death, 1e20);
  EXPECT_EQ(b.model.rigid_groups[2].nodes.size(), 3u);
  EXPECT_EQ(b.model.rigid_groups[2].death, .25);
  EXPECT_EQ(b.model.common_motions.at(0).dofs, dof_y | dof_z);
  const LinearEquation& equation = b.model.linear_equations.at(0);
  EXPECT_EQ(equation.id, 17);
  EXPECT_EQ(equation.terms.at(1).dof, 6);
  EXPECT_EQ(equation.terms[1].coefficient, -2.5);
  const Interpolation& tie = b.model.interpolations.at(0);
  EXPECT_EQ(tie.dofs, dof_translations | dof_rz);
  EXPECT_EQ(tie.weight, (std::vector<double>{2, 1, 1}));
}

TEST(BuildTies, Refusals) {
  const Built b(two_blocks + "*SET_NODE\n3\n21,22,23\n*CONSTRAINED_SPOTWELD\n21,24,100.,50.,2.,3.,.5,.2\n"
                "*CONSTRAINED_GENERALIZED_WELD_SPOT\n3,0,5\n,.1,100.\n*CONSTRAINED_GENERALIZED_WELD_BUTT\n3\n,,7.\n"
                "*CONSTRAINED_LINEAR_LOCAL\n17\n21,7,0,1.\n21,1,0,1.\n*CONSTRAINED_INTERPOLATION\n5,26,1237\n21,12\n22,123,1.,2.\n");
  EXPECT_NE(b.unsupported("field EP:"), nullptr) << b.messages();
  EXPECT_NE(b.unsupported("field EPSF"), nullptr);
  EXPECT_NE(b.unsupported("field FILTER"), nullptr);
  EXPECT_NE(b.unsupported("field SN"), nullptr);
  EXPECT_NE(b.unsupported("field SIGY"), nullptr);
  EXPECT_NE(b.unsupported("field DOF: the voltage"), nullptr);
  EXPECT_NE(b.error("field DDOF: found the digit 7"), nullptr);
  EXPECT_NE(b.unsupported("field IDOF"), nullptr);
  EXPECT_NE(b.unsupported("field TWGHTY"), nullptr);
  EXPECT_NE(b.error("needs three independent nodes"), nullptr);
}

TEST(BuildNonReflecting, FlagsSwitchWavesOff) {
  const Built b(two_blocks + "*SET_SEGMENT\n3\n1,2,3,4\n*BOUNDARY_NON_REFLECTING\n3\n3,1.,0.\n3,0.,1.\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.non_reflecting.size(), 3u);
  EXPECT_TRUE(b.model.non_reflecting[0].dilatational && b.model.non_reflecting[0].shear);
  EXPECT_FALSE(b.model.non_reflecting[1].dilatational);
  EXPECT_FALSE(b.model.non_reflecting[2].shear);
}

TEST(BuildRelaxation, IsOnByItsFlagOrByACurve) {
  const Built flag(two_blocks + "*CONTROL_DYNAMIC_RELAXATION\n100,1.e-6,.99,2.,.5,0,,1\n");
  ASSERT_TRUE(flag.diagnostics.ok()) << flag.messages();
  const DynamicRelaxation& r = flag.model.control.relaxation;
  EXPECT_TRUE(r.on);
  EXPECT_EQ(r.check, 100);
  EXPECT_EQ(r.tolerance, 1e-6);
  EXPECT_EQ(r.factor, .99);
  EXPECT_EQ(r.end_time, 2);
  EXPECT_EQ(r.step_scale, .5);
  EXPECT_FALSE(Built(two_blocks + "*CONTROL_DYNAMIC_RELAXATION\n\n").model.control.relaxation.on);
  const std::string both = "*DEFINE_CURVE\n4,2\n0,0\n1,5\n*LOAD_BODY_Z\n4,1.,4\n";
  const Built by_curve(two_blocks + both);
  EXPECT_TRUE(by_curve.model.control.relaxation.on);
  EXPECT_EQ(by_curve.model.control.relaxation.check, 250);
  EXPECT_EQ(by_curve.model.curves[0].phase, Curve::Phase::both);
  EXPECT_EQ(by_curve.model.body_loads[0].relaxation_curve, 0);
  EXPECT_FALSE(Built(two_blocks + both + "*CONTROL_DYNAMIC_RELAXATION\n,,,,,,,-999\n").model.control.relaxation.on);
}

TEST(BuildRelaxation, Refusals) {
  const Built b(two_blocks + curve + "*CONTROL_DYNAMIC_RELAXATION\n,,,,,1,,1\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,1,0,4\n");
  EXPECT_NE(b.unsupported("field IRELAL"), nullptr) << b.messages();
  EXPECT_NE(b.unsupported("prescribed motions of rigid bodies"), nullptr);
  const Built other(two_blocks + "*CONTROL_DYNAMIC_RELAXATION\n,,2.,,,,,5\n");
  EXPECT_NE(other.unsupported("IDRFLG = 5"), nullptr);
  EXPECT_NE(other.error("field DRFCTR"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

// *DEFORMABLE_TO_RIGID, _AUTOMATIC.
#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string soft =
    "*MAT_ELASTIC\n5,3.,100.,.3\n*MAT_NULL\n6,4.\n*PART\nsoft\n9,1,5\n*PART\nsofter\n10,1,6\n*ELEMENT_SOLID\n"
    "3,9,1,2,3,4,5,6,7,8\n4,10,11,12,13,14,15,16,17,18\n*SET_PART\n3\n9,10\n";

TEST(BuildSwitch, DeformableToRigidIsAMergeOfRigidParts) {
  const Built b(two_blocks + soft + "*DEFORMABLE_TO_RIGID\n3,1,PSET\n*LOAD_RIGID_BODY\n9,1,4\n*DEFINE_CURVE\n4\n0,0\n1,5\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  EXPECT_TRUE(b.model.unsupported.empty()) << b.messages();  // the laws of the parts do not matter any more
  ASSERT_EQ(b.model.merges.size(), 2u);
  EXPECT_EQ(b.model.merges[0].lead, 0);
  EXPECT_EQ(b.model.merges[1].constrained, 3);
  ASSERT_TRUE(b.model.rigid_part(2) && b.model.rigid_part(3));
  const auto law = [&](std::size_t p) { return std::get<RigidMaterial>(b.model.materials[static_cast<std::size_t>(b.model.parts[p].material)].law); };
  EXPECT_EQ(law(2).density, 3);
  EXPECT_EQ(law(2).youngs_modulus, 100);
  EXPECT_EQ(law(3).density, 4);
  const Built wrong(two_blocks + "*DEFORMABLE_TO_RIGID\n77\n1,0,NODE\n");
  EXPECT_NE(wrong.error("part 77"), nullptr) << wrong.messages();
  EXPECT_NE(wrong.error("field PTYPE"), nullptr);
}

TEST(BuildSwitch, PartsThatSharePlanesOfNodesAreOneRigidBody) {
  const Built b(two_blocks + soft + "*DEFORMABLE_TO_RIGID\n9\n");  // part 9 lies on the nodes of the rigid block 1
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.merges.size(), 1u);
  EXPECT_EQ(b.model.merges[0].lead, 0);
  EXPECT_EQ(b.model.merges[0].constrained, 2);
  EXPECT_NE(b.warning("shares 8 nodes with rigid part 1"), nullptr);
}

TEST(BuildSwitch, AutomaticMakesGroupsForATime) {
  const Built b(two_blocks + soft + "*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,0,.2\n,,,,2\n9\n10,9\n2,0,.5\n,,,,,1\n3,PSET\n");
  EXPECT_TRUE(b.diagnostics.ok()) << b.messages();
  ASSERT_EQ(b.model.rigid_groups.size(), 1u);
  EXPECT_EQ(b.model.rigid_groups[0].birth, .2);
  EXPECT_EQ(b.model.rigid_groups[0].death, .5);
  EXPECT_EQ(b.model.rigid_groups[0].nodes.size(), 16u);
}

TEST(BuildSwitch, Refusals) {
  const Built b(two_blocks + soft + "*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,3,.2,,,,7,1\n1,,,1.e-3,3\n9,1\n1\n10\n2,0,.5\n,,,,1\n10\n3,0,.1\n,,,,,1\n9\n");
  EXPECT_NE(b.unsupported("field CODE"), nullptr) << b.messages();
  EXPECT_NE(b.unsupported("field RELSW"), nullptr);
  EXPECT_NE(b.unsupported("field PAIRED"), nullptr);
  EXPECT_NE(b.unsupported("field NRBF"), nullptr);
  EXPECT_NE(b.warning("field DTMAX"), nullptr);
  EXPECT_NE(b.unsupported("field LRB"), nullptr);
  EXPECT_NE(b.unsupported("part 1 is rigid by its material"), nullptr);
  EXPECT_NE(b.unsupported("part 10 is switched twice"), nullptr);
  EXPECT_NE(b.error("part 9 is made deformable without"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

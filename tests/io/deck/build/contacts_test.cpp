// *CONTACT, *CONTROL_CONTACT, *PART_CONTACT, *DEFINE_FRICTION.
#include <gmock/gmock.h>

#include "build_fixture.hpp"

namespace kardan::deck {
namespace {

const std::string mesh =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*MAT_ELASTIC\n1,1e-6,200,0.3\n*SECTION_SHELL\n1,2\n1,1,1,1\n"
    "*PART\nplate\n1,1,1\n*PART_CONTACT\nother\n2,1,1\n0.2,0.1,3,4,0.5,0.6,0.7\n*PART\nthird\n3,1,1\n"
    "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,2,1,2,3\n3,3,1,2,3,4\n"
    "*SET_PART_LIST\n5\n1,3\n*SET_NODE_LIST\n6\n3,1\n*SET_SEGMENT\n7\n1,2,3,3\n*SET_SHELL_LIST\n8\n2\n*SET_NODE_LIST\n9\n*DEFINE_BOX\n4,-1,1,-2,2,-3,3\n";

/// The only contact of a deck.
Contact contact_of(const std::string& text) {
  const Built b(mesh + text);
  EXPECT_TRUE(b.diagnostics.ok()) << b.messages();
  return b.model.contacts.at(0);
}

TEST(BuildContacts, SidesOfEveryType) {
  const auto tracked = [](const std::string& who) { return contact_of("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + who + "\n\n\n").tracked; };
  using Kind = ContactSide::Kind;
  EXPECT_EQ(tracked("7,1,0,3").segments, (std::vector<std::array<NodeIndex, 4>>{{0, 1, 2, 2}}));
  EXPECT_EQ(tracked("8,1,1,3").segments, (std::vector<std::array<NodeIndex, 4>>{{0, 1, 2, 2}}));
  EXPECT_EQ(tracked("5,1,2,3").parts, (std::vector<PartIndex>{0, 2}));
  EXPECT_EQ(tracked("2,1,3,3").parts, (std::vector<PartIndex>{1}));
  EXPECT_EQ(tracked("6,1,4,3").nodes, (std::vector<NodeIndex>{0, 2}));
  EXPECT_EQ(tracked("0,1,5,3").kind, Kind::everything);
  EXPECT_EQ(tracked("5,1,6,3").parts, (std::vector<PartIndex>{1})) << "all but those of the set";
  EXPECT_EQ(tracked("2,1,3,3,4").box, (std::array<Vec3, 2>{Vec3{-1, -2, -3}, Vec3{1, 2, 3}}));
  EXPECT_TRUE(tracked("2,1,3,3,0,0,1").report_nodes);
}

TEST(BuildContacts, FieldsOfTheCards) {
  const Contact c = contact_of(
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE_MPP_ID\n77,self contact\n1\n&,2\n0\n0.3,0.2,5,6,20,0,1,9\n0.5,0.6,0.7,0.8,0.9,1.1,2,3\n"
      "1,0.25,0,0,3,5\n,,2,,,,0.4,8\n,0,,1e-4\n");
  EXPECT_EQ(c.id, 77);
  EXPECT_EQ(c.title, "self contact");
  EXPECT_TRUE(c.single && c.automatic && !c.two_way && !c.edges);
  EXPECT_EQ((std::array{c.friction.statical, c.friction.dynamic, c.friction.decay, c.friction.shear_limit}), (std::array{0.6, 0.4, 5.0, 18.0}))
      << "FSF and VSF scale the friction";
  EXPECT_EQ((std::array{c.damping, c.birth, c.death}), (std::array{0.2, 1.0, 9.0}));
  EXPECT_EQ((std::array{c.tracked.stiffness_scale, c.tracked.thickness, c.tracked.thickness_scale}), (std::array{0.5, 0.7, 0.9}));
  EXPECT_EQ(c.soft, 1);
  EXPECT_EQ(c.soft_scale, 0.25);
  EXPECT_EQ(c.depth, 5);
  EXPECT_EQ(c.shell_thickness, 2);
  EXPECT_EQ((std::array{c.solid_thickness, c.solid_stiffness, c.step_of_stiffness}), (std::array{0.4, 8.0, 1e-4}));
  EXPECT_EQ(c.initial_penetration, 1) << "of the MPP card, where card C says nothing";
}

TEST(BuildContacts, BlankCardsAreDefaults) {
  const Contact c = contact_of("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n\n\n\n");
  EXPECT_EQ(c.tracked.kind, ContactSide::Kind::everything);
  EXPECT_EQ(c.death, 1e20);
  EXPECT_EQ(c.tracked.stiffness_scale, 1);
  EXPECT_EQ(c.soft_scale, 0.1);
}

TEST(BuildContacts, KeywordsDiffer) {
  const auto made = [](const std::string& name) { return contact_of("*CONTACT_" + name + "\n1,2,3,3\n\n\n"); };
  EXPECT_TRUE(made("SURFACE_TO_SURFACE").two_way);
  EXPECT_FALSE(made("SURFACE_TO_SURFACE").automatic);
  EXPECT_FALSE(made("NODES_TO_SURFACE").two_way);
  EXPECT_LT(made("FORMING_ONE_WAY_SURFACE_TO_SURFACE").reference.thickness, 0) << "tools have no thickness";
  EXPECT_EQ(made("FORCE_TRANSDUCER_PENALTY").law, ContactLaw::transducer);
  EXPECT_EQ(made("TIED_NODES_TO_SURFACE_OFFSET").tie.holding, Tie::Holding::offset);
  EXPECT_EQ(made("TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET").tie.holding, Tie::Holding::beam_offset);
  EXPECT_TRUE(made("SPOTWELD").tie.rotations);
  EXPECT_FALSE(made("TIED_SURFACE_TO_SURFACE").tie.rotations);
  EXPECT_TRUE(contact_of("*CONTACT_ERODING_SINGLE_SURFACE\n1,0,3\n\n\n0,1,1\n").eroding);
}

TEST(BuildContacts, Ties) {
  const Tie nodes = contact_of("*CONTACT_TIEBREAK_NODES_TO_SURFACE\n6,2,4,3\n\n\n100,200,1.5\n").tie;
  EXPECT_EQ((std::array{nodes.normal_limit, nodes.shear_limit, nodes.normal_exponent, nodes.shear_exponent}), (std::array{100., 200., 1.5, 2.}));
  const Tie damage = contact_of("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK\n1,2,3,3\n\n\n6,10,20,0.3\n").tie;
  EXPECT_EQ(damage.option, 6);
  EXPECT_EQ((std::array{damage.normal_limit, damage.shear_limit, damage.critical_distance}), (std::array{10., 20., 0.3}));
  const Built cohesive(mesh + "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK\n1,2,3,3\n\n\n9,10,20,0.3\n1,2,3\n");
  EXPECT_NE(cohesive.unsupported("OPTION = 9"), nullptr);
  EXPECT_EQ(contact_of("*CONTACT_TIED_NODES_TO_SURFACE\n6,2,4,3\n\n0,0,-0.5\n").tie.distance, 0.5) << "SAST < 0: how far nodes may lie";
}

TEST(BuildContacts, ControlIsTheDefaultOfContactsBeforeAndAfterIt) {
  const std::string contact = "*CONTACT_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n";
  const Built b(mesh + contact + "*CONTROL_CONTACT\n0.2,1.5,0,2,3\n0,0,0,0,4,1\n\n1,0,1\n" + contact);
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const ContactControl& c = b.model.control.contact;
  EXPECT_EQ((std::array{c.stiffness_scale, c.wall_penalty}), (std::array{0.2, 1.5}));
  EXPECT_EQ(c.penalty_option, 3);
  EXPECT_TRUE(c.full_thickness && c.skip_walls);
  for (const Contact& one : b.model.contacts) {
    EXPECT_EQ(one.shell_thickness, 2);
    EXPECT_EQ(one.initial_penetration, 1);
  }
}

TEST(BuildContacts, FrictionOfPartsAndTables) {
  const Built b(mesh + "*DEFINE_FRICTION\n12,0.5,0.4,1,2\n1,5,0.9,0.8,0,0,PART,PSET\n*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n-2,12\n\n");
  ASSERT_TRUE(b.diagnostics.ok()) << b.messages();
  const Contact& c = b.model.contacts.at(0);
  EXPECT_EQ(c.friction_source, Contact::FrictionSource::table);
  const FrictionTable& table = b.model.friction_tables.at(static_cast<std::size_t>(c.friction_table));
  EXPECT_EQ(table.otherwise.statical, 0.5);
  EXPECT_EQ(table.rows.at(0).first, (std::vector<PartIndex>{0}));
  EXPECT_EQ(table.rows.at(0).second, (std::vector<PartIndex>{0, 2}));
  EXPECT_EQ(table.rows.at(0).friction.dynamic, 0.8);
  const PartContact& part = b.model.parts.at(1).contact.value();
  EXPECT_EQ((std::array{part.friction.statical, part.thickness, part.thickness_scale, part.stiffness_scale}), (std::array{0.2, 0.5, 0.6, 0.7}));
  EXPECT_EQ(contact_of("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n-1\n\n").friction_source, Contact::FrictionSource::part);
}

TEST(BuildContacts, FaultsAreNamed) {
  const auto said = [](const std::string& text) { return Built(mesh + text).messages(); };
  EXPECT_THAT(said("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n99,0,2\n\n\n"), testing::HasSubstr("99"));
  EXPECT_THAT(said("*CONTACT_NODES_TO_SURFACE\n9,1,4,3\n\n\n"), testing::HasSubstr("no members"));
  EXPECT_THAT(said("*CONTACT_NODES_TO_SURFACE\n1,6,3,4\n\n\n"), testing::HasSubstr("nodes cannot be the surface"));
  EXPECT_THAT(said("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n-2,13\n\n"), testing::HasSubstr("friction table 13"));
  EXPECT_NE(Built(mesh + "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n1,0,7\n\n\n").unsupported("type"), nullptr);
  EXPECT_NE(Built(mesh + "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n\n\n4\n").unsupported("SOFT = 4"), nullptr);
}

}  // namespace
}  // namespace kardan::deck

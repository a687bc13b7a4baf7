#include "kardan/contact/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/meshes.hpp"

namespace kardan {
namespace {

const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};
constexpr double bulk = 210e9 / (3 * (1 - 0.6));

Surface surface_of(const Model& model, const ContactSide& side, const SurfaceRules& rules, Diagnostics& diagnostics) {
  State state;
  state.nodes.resize(model.nodes.size());
  state.nodes.x = model.nodes.x;
  Contact contact;
  contact.id = 9;
  contact.tracked = side;
  return {model, state, contact, contact.tracked, rules, diagnostics};
}

TEST(Surface, OfABlockIsItsFreeFacesWithNormalsOutwards) {
  test::Meshes m;
  const PartIndex p = m.solid_part(steel);
  m.block(p, {2, 3, 4}, {}, {2, 3, 4});
  Diagnostics diagnostics;
  const Surface s = surface_of(m.model, test::Meshes::side({p}), {.automatic = true}, diagnostics);
  EXPECT_EQ(s.segments().size(), 2u * (6 + 8 + 12));
  EXPECT_EQ(s.nodes().size(), 3u * 4 * 5 - 1 * 2 * 3);
  double volume = 0;
  for (const Segment& segment : s.segments()) {
    const auto& x = m.model.nodes.x;
    const auto& n = segment.nodes;
    const Vec3 center = (x[n[0]] + x[n[1]] + x[n[2]] + x[n[3]]) * 0.25;
    volume += dot(center, cross(x[n[2]] - x[n[0]], x[n[3]] - x[n[1]])) * 0.5 / 3;  // divergence theorem
    EXPECT_TRUE(segment.one_sided);
    EXPECT_NEAR(segment.stiffness, bulk, 1e-12 * bulk);
    EXPECT_NEAR(segment.depth, 0.5, 1e-14);
    EXPECT_EQ(segment.half_thickness, 0);
    EXPECT_EQ(segment.body, 0);
  }
  EXPECT_NEAR(volume, 24, 1e-12);
  double area = 0;
  for (const SurfaceNode& node : s.nodes()) area += node.area;
  EXPECT_NEAR(area, 52, 1e-12);
}

TEST(Surface, FacesBetweenPartsOfOneSideAreNotFree) {
  test::Meshes m;
  const PartIndex p = m.solid_part(steel), q = m.solid_part(steel);
  m.block(p, {1, 1, 2}, {}, {1, 1, 2});
  m.model.solids.part[1] = q;
  Diagnostics diagnostics;
  EXPECT_EQ(surface_of(m.model, test::Meshes::side({p, q}), {}, diagnostics).segments().size(), 10u);
  EXPECT_EQ(surface_of(m.model, test::Meshes::side({q}), {}, diagnostics).segments().size(), 6u);
}

TEST(Surface, ThicknessOfShells) {
  test::Meshes m;
  const PartIndex p = m.shell_part(steel, 0.5);
  m.plate(p, 2, 2, {}, {2, 0, 0}, {0, 2, 0});
  Diagnostics diagnostics;
  ContactSide side = test::Meshes::side({p});
  const auto half = [&](const SurfaceRules& rules) { return surface_of(m.model, side, rules, diagnostics).segments()[0].half_thickness; };
  EXPECT_DOUBLE_EQ(half({.automatic = true}), 0.25);
  EXPECT_DOUBLE_EQ(half({.automatic = true, .limited_thickness = true}), 0.2);  // 0.4 of the side of 1
  EXPECT_DOUBLE_EQ(half({}), 0);
  EXPECT_DOUBLE_EQ(half({.shell_thickness = 1}), 0.25);
  side.thickness_scale = 0.5;
  EXPECT_DOUBLE_EQ(half({.automatic = true}), 0.125);
  side.thickness = 0.3;
  EXPECT_DOUBLE_EQ(half({.automatic = true}), 0.075);
  side.thickness = -1;
  EXPECT_DOUBLE_EQ(half({.automatic = true}), 0);
  side.thickness = 0;
  side.thickness_scale = 1;
  m.model.parts[p].contact = PartContact{.friction = {}, .thickness = 0.1, .thickness_scale = 2, .stiffness_scale = 3};
  EXPECT_DOUBLE_EQ(half({.automatic = true}), 0.1);
  side.stiffness_scale = 2;
  const Surface s = surface_of(m.model, side, {.automatic = true}, diagnostics);
  EXPECT_DOUBLE_EQ(s.segments()[0].stiffness, 6 * bulk / std::sqrt(2.0));
  EXPECT_FALSE(s.segments()[0].one_sided);
  EXPECT_EQ(s.segments_at(s.place_of(4)).size(), 4u);  // the node in the middle
  EXPECT_DOUBLE_EQ(s.nodes()[4].area, 1);
}

TEST(Surface, GivenSegmentsTakeTheirElements) {
  test::Meshes m;
  const PartIndex p = m.shell_part(steel, 0.1), q = m.solid_part(steel);
  m.plate(p, 1, 1, {}, {1, 0, 0}, {0, 1, 0});
  m.block(q, {1, 1, 1}, {5, 0, 0}, {1, 1, 1});
  ContactSide side;
  side.kind = ContactSide::Kind::segments;
  side.segments = {{0, 2, 3, 1}, {8, 9, 11, 10}, {0, 1, 8, 9}};
  Diagnostics diagnostics;
  const Surface s = surface_of(m.model, side, {}, diagnostics);
  ASSERT_EQ(s.segments().size(), 2u);
  EXPECT_EQ(s.segments()[0].part, p);
  EXPECT_EQ(s.segments()[0].nodes, (std::array<NodeIndex, 4>{0, 2, 3, 1}));
  EXPECT_EQ(s.segments()[1].part, q);
  EXPECT_NE(s.segments()[0].body, s.segments()[1].body);
  const std::string text = test::messages(diagnostics);
  EXPECT_NE(text.find("contact 9: 1 of its segments lie on no shell and no face of a solid; they are left out: 1 2 9 10"), std::string::npos) << text;
}

TEST(Surface, OfNodesAndBeamsAndBoxes) {
  test::Meshes m;
  const PartIndex p = m.shell_part(steel, 0.1);
  m.plate(p, 2, 1, {}, {2, 0, 0}, {0, 1, 0});
  Section section;
  section.kind = ElementKind::beam;
  section.beam.elform = 2;
  section.beam.area = std::numbers::pi * 0.04;
  const PartIndex q = m.HandmadeModel::part(section, test::Meshes::material_of(steel));
  const NodeIndex a = m.node({0, 0, 1}), b = m.node({2, 0, 1});
  m.model.beams.id.push_back(1);
  m.model.beams.part.push_back(q);
  m.model.beams.nodes.push_back({a, b, none});
  Diagnostics diagnostics;
  const Surface both = surface_of(m.model, test::Meshes::side({p, q}), {.automatic = true}, diagnostics);
  ASSERT_EQ(both.nodes().size(), 8u);
  EXPECT_NEAR(both.nodes()[6].half_thickness, 0.2, 1e-15);
  EXPECT_NEAR(both.nodes()[6].stiffness, bulk * section.beam.area / 2, 1e-6);
  EXPECT_EQ(both.beams().size(), 1u);
  ContactSide side;
  side.kind = ContactSide::Kind::nodes;
  side.nodes = {1, 4, 6};
  const Surface nodes = surface_of(m.model, side, {.automatic = true}, diagnostics);
  ASSERT_EQ(nodes.nodes().size(), 3u);
  EXPECT_TRUE(nodes.segments().empty());
  EXPECT_DOUBLE_EQ(nodes.nodes()[0].half_thickness, 0.05);
  EXPECT_NEAR(nodes.nodes()[2].half_thickness, 0.2, 1e-15);
  side = test::Meshes::side({p});
  side.box = {{Vec3{0.5, -1, -1}, Vec3{3, 3, 3}}};
  EXPECT_EQ(surface_of(m.model, side, {}, diagnostics).segments().size(), 1u);
  EXPECT_EQ(diagnostics.warning_count(), 0u);
  side.box = {{Vec3{50, -1, -1}, Vec3{60, 3, 3}}};
  EXPECT_TRUE(surface_of(m.model, side, {}, diagnostics).empty());
  EXPECT_NE(test::messages(diagnostics).find("neither segments nor nodes"), std::string::npos);
}

}  // namespace
}  // namespace kardan

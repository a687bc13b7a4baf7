// *CONTACT_AUTOMATIC_GENERAL: edges of shells and beams meet between their nodes.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};

/// Two upright plates cross like the cards of a house: only their edges meet, between their nodes.
test::Meshes crossed_plates(bool edges) {
  test::Meshes m;
  const PartIndex lower = m.shell_part(steel, 0.004), upper = m.shell_part(steel, 0.004);
  m.plate(lower, 5, 2, {-0.05, 0.001, -0.05}, {0.1, 0, 0}, {0, 0, 0.05});
  const NodeIndex first = m.plate(upper, 5, 2, {0.003, -0.05, 0.005}, {0, 0.1, 0}, {0, 0, 0.05});
  m.throw_from(first, m.node_count(), {0, 0, -3});
  Contact& c = m.single_surface({lower, upper});
  c.keyword = "*CONTACT_AUTOMATIC_GENERAL";
  c.edges = edges;
  m.model.control.hourglass_type = 4;
  m.model.control.time_step.scale = 0.4;
  m.model.control.termination.end_time = 1.5e-3;
  return m;
}

TEST(Edges, OfShellsMeetOnlyWhereTheContactLooksAtThem) {
  for (const bool edges : {false, true}) {
    test::Meshes m = crossed_plates(edges);
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    test::Watch watch;
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const double up = test::momentum(solver.state(), 18, 36).z;
    if (!edges) {
      EXPECT_LT(up, -0.99 * watch.scale);  // through each other, as cards without edges do
      continue;
    }
    EXPECT_GT(watch.most_touches, 0);
    EXPECT_GT(up, test::momentum(solver.state(), 0, 18).z);
    EXPECT_LT(watch.momentum_error, 1e-12 * watch.scale);
    EXPECT_LT(watch.angular_error, 1e-9 * watch.scale * 0.1);
    EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
    EXPECT_LT(std::abs(watch.sliding_when_free), 0.01 * watch.energy);
  }
}

/// A falling chain of beams is caught by a crossing one, also where nodes and ends are nearest.
TEST(Edges, BeamsDoNotPassEachOther) {
  for (const double at : {0.0, 0.013, 0.025, 0.0499, 0.05}) {
    test::Meshes m;
    Section section;
    section.kind = ElementKind::beam;
    section.beam.elform = 2;
    section.beam.area = std::numbers::pi * 2.5e-5;  // radius 5 mm
    section.beam.iss = section.beam.itt = std::numbers::pi / 4 * 6.25e-10;
    section.beam.j = 2 * section.beam.iss;
    const auto chain = [&](const Vec3& from, const Vec3& step) {
      const PartIndex p = m.HandmadeModel::part(section, test::Meshes::material_of(steel));
      const NodeIndex first = m.node_count(), orientation = first + 5;
      for (int i = 0; i <= 4; ++i) m.node(from + step * i);
      m.node(from + Vec3{0.01, 0.013, 0.5});
      for (int i = 0; i < 4; ++i) {
        m.model.beams.id.push_back(static_cast<UserId>(m.model.beams.size()) + 1);
        m.model.beams.part.push_back(p);
        m.model.beams.nodes.push_back({first + i, first + i + 1, orientation});
      }
      return first;
    };
    chain({-0.1, 0, 0}, {0.05, 0, 0});
    const NodeIndex first = chain({0.05 - at, -0.1 + at, 0.012}, {0, 0.05, 0});
    m.throw_from(first, first + 5, {0, 0, -4});
    m.single_surface({0, 1}).edges = true;
    m.model.control.time_step.scale = 0.4;
    m.model.control.termination.end_time = 3e-3;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << test::messages(diagnostics);
    test::Watch watch;
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    EXPECT_GT(watch.most_touches, 0) << at;
    EXPECT_GT(test::momentum(solver.state(), first, first + 5).z, test::momentum(solver.state(), 0, 5).z) << at;
    EXPECT_LT(watch.momentum_error, 1e-12 * watch.scale) << at;
    EXPECT_LT(watch.energy_error, 0.01 * watch.energy) << at;
  }
}

}  // namespace
}  // namespace kardan

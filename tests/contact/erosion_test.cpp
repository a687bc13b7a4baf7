// Deleted elements leave the contact, and *CONTACT_RIGID_… follows its curve.
#include <gtest/gtest.h>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};

/// The upper of two layers of solids is deleted before a node arrives: an eroding contact catches it on the lower one, any other lets it through; while
/// the layer stands, both stop it there.
TEST(Erosion, LaysFacesBareForErodingContactsOnly) {
  for (const bool eroding : {false, true})
    for (const bool deleted : {false, true}) {
      test::Meshes m;
      const PartIndex lower = m.solid_part(steel), upper = m.solid_part(steel);
      m.block(lower, {3, 3, 2}, {0, 0, 0}, {0.3, 0.3, 0.2});
      for (std::size_t e = 9; e < 18; ++e) m.model.solids.part[e] = upper;
      ErosionCriteria criteria;
      criteria.time = deleted ? 1e-4 : ErosionCriteria::never;
      m.model.materials[upper].erosion = criteria;
      const NodeIndex n = m.point({0.141, 0.163, 0.21}, 0.05, {0, 0, -50});
      m.nodes_to_surface({n}, {lower, upper}).eroding = eroding;
      m.model.control.termination.end_time = 4e-3;
      Diagnostics diagnostics;
      Solver solver(m.model, {}, diagnostics);
      ASSERT_TRUE(diagnostics.ok()) << test::messages(diagnostics);
      double lowest = 1;
      test::Watch watch;
      watch.each = [&](const Model&, const State& s) { lowest = std::min(lowest, s.nodes.x[n].z); };
      solver.attach(watch);
      ASSERT_EQ(solver.run(), StopReason::end_time);
      EXPECT_EQ(solver.state().results.deleted_solids, deleted ? 9 : 0);
      if (!deleted) {
        EXPECT_NEAR(lowest, 0.2, 0.005);
      } else if (eroding) {
        EXPECT_NEAR(lowest, 0.1, 0.005);
        EXPECT_GT(solver.state().nodes.v[n].z, 0);
      } else {
        EXPECT_LT(lowest, 0.08);
      }
    }
}

TEST(Erosion, DeletedShellsLetThrough) {
  test::Meshes m;
  const PartIndex p = m.shell_part(steel, 0.01);
  m.plate(p, 3, 3, {}, {0.3, 0, 0}, {0, 0.3, 0});
  ErosionCriteria criteria;
  criteria.time = 1e-4;
  m.model.materials[p].erosion = criteria;
  const NodeIndex n = m.point({0.141, 0.163, 0.02}, 0.05, {0, 0, -50});
  m.nodes_to_surface({n}, {p});
  m.model.control.termination.end_time = 1e-3;
  Diagnostics diagnostics;
  Solver solver(m.model, {.dt = 2e-6}, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << test::messages(diagnostics);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  EXPECT_NEAR(solver.state().nodes.x[n].z, 0.02 - 50 * 1e-3, 1e-9);
}

/// A rigid plate with four corners is pushed onto a fixed one: the forces are the curve's, of each node, of the sum or of the pressure.
TEST(RigidContact, FollowsItsCurve) {
  for (const int method : {1, 2, 3}) {
    test::Meshes m;
    const PartIndex floor = m.fixed_shell_part(0.02);
    m.plate(floor, 3, 3, {-0.1, -0.1, 0}, {1.2, 0, 0}, {0, 1.2, 0});
    RigidMaterial law{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3};
    const PartIndex plate = m.shell_part(law, 0.02);
    const NodeIndex first = m.plate(plate, 2, 1, {0, 0, 0.02}, {1, 0, 0}, {0, 1, 0});
    m.throw_from(first, m.node_count(), {0, 0, -1});
    Contact& contact = m.surface_to_surface({plate}, {floor});
    contact.two_way = false;
    contact.rigid_curve = true;
    contact.curve = m.curve({0, 0.001, 0.004}, {0, 4e4, 6e4});
    contact.curve_method = method;
    contact.unload_stiffness = method == 2 ? 1e8 : 0.0;
    m.model.control.termination.end_time = 0.01;
    Diagnostics diagnostics;
    Solver solver(m.model, {.dt = 1e-5}, diagnostics);
    ASSERT_TRUE(diagnostics.ok()) << test::messages(diagnostics);
    double worst = 0, deepest = 0, back = 0;
    test::Watch watch;
    watch.each = [&](const Model& model, const State& s) {
      const double p = 0.02 - s.nodes.x[first].z;
      if (s.nodes.v_now[first].z < -1e-2) {  // loading
        const double f = p > 0 ? model.curves[model.contacts[0].curve].value(p) : 0.0;
        worst = std::max(worst, std::abs(s.contacts[0].force.z - (method == 1 ? f : method == 2 ? 6 * f : f)));
      } else if (p > 0.0001) {
        back = std::max(back, s.contacts[0].force.z);
      }
      deepest = std::max(deepest, p);
    };
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    EXPECT_GT(deepest, 0.0005) << method;
    EXPECT_LT(worst, 1e-6 * 6e4) << method;
    EXPECT_LT(watch.energy_error, 0.01 * watch.energy) << method;
    const double mass = 7800 * 0.02, speed = test::momentum(solver.state(), first, m.node_count()).z / mass;
    if (method == 2) EXPECT_LT(speed, 0.9);  // unloading is steeper: energy is lost
    else EXPECT_NEAR(speed, 1, 0.02) << method;
  }
}

}  // namespace
}  // namespace kardan

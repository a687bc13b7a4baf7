// Contacts as a system: threads, initial penetrations, messages, times of birth and death.
#include <gtest/gtest.h>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};

/// Two wavy plates of n * n shells, `gap` between their surfaces.
test::Meshes two_plates(int n, double gap) {
  test::Meshes m;
  const double thick = 0.004;
  for (int i = 0; i < 2; ++i) {
    const PartIndex p = m.shell_part(steel, thick);
    const NodeIndex first = m.plate(p, n, n, {0.003 * i, 0.004 * i, i * (thick + gap)}, {0.02 * n, 0, 0}, {0, 0.02 * n, 0});
    for (NodeIndex k = first; k < m.node_count(); ++k) m.model.nodes.x[k].z += 1e-4 * std::sin(20 * m.model.nodes.x[k].x);
  }
  return m;
}

TEST(Contacts, AreTheSameToTheLastBitForAnyNumberOfThreads) {
  test::Meshes m = two_plates(20, 1e-5);
  m.throw_from(21 * 21, 2 * 21 * 21, {0.4, 0.2, -3});
  Contact& contact = m.single_surface({0, 1});
  contact.friction = {0.2, 0.2, 0, 0};
  m.model.control.termination.end_cycle = 60;
  m.model.control.termination.end_time = 1;
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    Diagnostics diagnostics;
    Solver solver(m.model, {.threads = threads}, diagnostics);
    test::Watch watch;
    solver.attach(watch);
    solver.run();
    EXPECT_GT(watch.most_touches, 500);  // enough for the parallel sum
    hashes.push_back(solver.state().registry.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

/// Plates that begin inside each other: one warning with ids, positions and depths; they stay at rest, and bounce off what goes deeper.
TEST(Contacts, AThousandInitialPenetrationsAreToldOfAndMakeNoEnergy) {
  for (const bool thrown : {false, true}) {
    test::Meshes m = two_plates(32, -0.001);
    m.single_surface({0, 1}).initial_penetration = 2;
    if (thrown) m.throw_from(33 * 33, 2 * 33 * 33, {0, 0, -1});
    m.model.control.time_step.scale = 0.25;  // all nodes bounce at once: short against the contact's springs
    m.model.control.termination.end_time = 2e-4;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    const std::string text = test::messages(diagnostics);
    EXPECT_NE(text.find(" nodes in initial penetration; the deepest:\n  node "), std::string::npos) << text.substr(0, 400);
    EXPECT_NE(text.find("the other initial penetrations (IGNORE = 2)"), std::string::npos);
    const auto at = text.find("contact 1: ");
    EXPECT_GT(std::stoi(text.substr(at + 11)), 1000);
    test::Watch watch;
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    EXPECT_GT(watch.most_touches, 1000);
    if (!thrown) {
      EXPECT_LT(solver.state().energy.kinetic, 1e-20);
      continue;
    }
    EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
    EXPECT_GT(test::momentum(solver.state(), 33 * 33, 2 * 33 * 33).z, test::momentum(solver.state(), 0, 33 * 33).z);
  }
}

TEST(Contacts, LiveFromBirthToDeath) {
  for (const bool alive : {false, true}) {
    test::Meshes m = two_plates(3, 0.0005);
    m.throw_from(16, 32, {0, 0, -10});
    Contact& contact = m.surface_to_surface({1}, {0});
    (alive ? contact.death : contact.birth) = alive ? 1.0 : 1e-3;
    m.model.control.termination.end_time = 8e-4;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    test::Watch watch;
    solver.attach(watch);
    solver.run();
    const double low = test::momentum(solver.state(), 0, 16).z, up = test::momentum(solver.state(), 16, 32).z;
    EXPECT_EQ(watch.most_touches > 0, alive);
    EXPECT_EQ(up > low, alive);
  }
}

/// A rigid part that is held is as firm as any, however light it is and however many nodes meet it.
TEST(Contacts, AHeldBodyIsFirmWhateverItWeighs) {
  std::vector<Vec3> end;
  for (const double density : {7800.0, 1e-3}) {
    test::Meshes m = two_plates(8, 1e-5);
    m.model.materials[0].law = RigidMaterial{.density = density, .youngs_modulus = 210e9, .poissons_ratio = 0.3, .cmo = 1, .con1 = 7, .con2 = 7};
    m.throw_from(81, 162, {0, 0, -3});
    m.surface_to_surface({1}, {0});
    m.model.control.termination.end_time = 2e-4;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    solver.run();
    end.push_back(solver.state().nodes.x[120]);
  }
  EXPECT_LT(norm(end[0] - end[1]), 1e-12);
}

/// What SPR and MPR ask for: forces of single nodes, whose sums are the contact's.
TEST(Contacts, ReportForcesOfNodes) {
  test::Meshes m = two_plates(4, 1e-5);
  m.throw_from(25, 50, {0, 0, -3});
  Contact& contact = m.surface_to_surface({1}, {0});
  contact.tracked.report_nodes = contact.reference.report_nodes = true;
  m.model.control.termination.end_time = 1e-3;
  Diagnostics diagnostics;
  Solver solver(m.model, {}, diagnostics);
  test::Watch watch;
  solver.attach(watch);
  const ContactReport& report = solver.state().contacts[0];
  while (report.touching < 5 && solver.step()) {
  }
  ASSERT_EQ(report.nodal_force[0].size(), 25u);
  Vec3 tracked, reference;
  for (const Vec3& f : report.nodal_force[0]) tracked += f;
  for (const Vec3& f : report.nodal_force[1]) reference += f;
  ASSERT_GT(norm(report.force), 0);
  EXPECT_LT(norm(tracked - report.force), 1e-12 * norm(report.force));
  EXPECT_LT(norm(reference + report.force), 1e-12 * norm(report.force));
  double area = 0;
  for (const double a : report.nodal_area[0]) area += a;
  EXPECT_NEAR(area, 0.08 * 0.08, 1e-5);
  EXPECT_EQ(report.segments[0].size(), 16u);  // each once
  EXPECT_EQ(report.segments[1].size(), 16u);
}

}  // namespace
}  // namespace kardan

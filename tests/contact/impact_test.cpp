// Impacts by penalty contact: momentum, energy, and nothing passes.
#include <gtest/gtest.h>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};
const RigidMaterial rigid_steel{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3};

/// Who meets whom in ElasticRebound.
struct Pairing {
  const char* name;
  bool first_solid, first_rigid, second_solid, second_rigid;
};
void PrintTo(const Pairing& p, std::ostream* os) { *os << p.name; }

class Rebound : public testing::TestWithParam<Pairing> {};

/// A plate or block falls on another one, askew and off its centre: the momenta of both together stay, the energy comes back, nothing gets through.
TEST_P(Rebound, KeepsMomentumAndEnergy) {
  const Pairing& p = GetParam();
  test::Meshes m;
  const auto body = [&](bool solid, bool rigid, int n, const Vec3& origin, double size) {
    const PartIndex part = solid ? m.solid_part(steel) : m.shell_part(steel, 0.004);
    if (rigid) m.model.materials.back().law = rigid_steel;
    if (solid) m.block(part, {n, n, 2}, origin, {size, size, 0.03});
    else m.plate(part, n, n, origin, {size, 0, 0}, {0, size, 0});
    return part;
  };
  const PartIndex lower = body(p.first_solid, p.first_rigid, 5, {0, 0, 0}, 0.1);
  const NodeIndex split = m.node_count();
  const double top = p.first_solid ? 0.03 : 0.002, half = p.second_solid ? 0.0 : 0.002;
  const PartIndex upper = body(p.second_solid, p.second_rigid, 4, {0.021, 0.017, top + half + 0.001}, 0.07);
  for (NodeIndex n = split; n < m.node_count(); ++n) {  // askew
    Vec3& x = m.model.nodes.x[n];
    x.z += 0.05 * (x.x - 0.021) + 0.03 * (x.y - 0.017);
  }
  m.throw_from(split, m.node_count(), {0.5, 0.3, -5});
  m.surface_to_surface({upper}, {lower});
  m.model.control.hourglass_type = 4;
  m.model.control.time_step.scale = 0.4;  // short against the contact's springs
  m.model.control.termination.end_time = 1.5e-3;
  Diagnostics diagnostics;
  Solver solver(m.model, {}, diagnostics);
  EXPECT_EQ(diagnostics.warning_count(), 0u) << test::messages(diagnostics);
  test::Watch watch;
  solver.attach(watch);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  const State& s = solver.state();
  EXPECT_GT(watch.most_touches, 0);
  EXPECT_LT(watch.momentum_error, 1e-12 * watch.scale);
  EXPECT_LT(watch.angular_error, (p.first_solid && p.second_solid ? 1e-11 : 1e-9) * watch.scale * 0.1);
  EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
  EXPECT_LT(std::abs(watch.sliding_when_free), 0.01 * watch.energy);  // all came back
  double low = 0, up = 0, mass_low = 0, mass_up = 0;
  for (NodeIndex n = 0; n < m.node_count(); ++n) {
    (n < split ? low : up) += s.nodes.mass[n] * s.nodes.x[n].z;
    (n < split ? mass_low : mass_up) += s.nodes.mass[n];
  }
  EXPECT_GT(up / mass_up, low / mass_low + 0.002);
  EXPECT_GT(test::momentum(s, split, m.node_count()).z / mass_up, test::momentum(s, 0, split).z / mass_low);
}

/// Meshes one element thick, all of their nodes in the same two planes (but for rounding): each node of one body lies in the plane of a face of the other,
/// and they meet nevertheless, by whichever contact, in whichever material, momentum and energy kept.
TEST(Impact, BodiesWithFlushSidesMeetInTheirPlane) {
  for (const bool rigid : {false, true})
    for (const double rounding : {0.0, 1e-16, -1e-16, 1e-9})
      for (const bool single : {false, true}) {
        SCOPED_TRACE(testing::Message() << "rigid " << rigid << ", rounding " << rounding << ", single " << single);
        test::Meshes m;
        const PartIndex lower = m.solid_part(steel), upper = m.solid_part(steel);
        if (rigid) m.model.materials.back().law = rigid_steel;
        m.block(lower, {8, 2, 1}, {0, 0, 0}, {0.08, 0.02, 0.01});
        const NodeIndex split = m.node_count();
        m.block(upper, {3, 2, 1}, {0.023, 0.0201, rounding}, {0.03, 0.02, 0.01});
        m.throw_from(split, m.node_count(), {0, -5, 0});
        if (single) m.single_surface({lower, upper});
        else m.surface_to_surface({lower}, {upper});
        m.model.control.hourglass_type = 4;
        m.model.control.time_step.scale = 0.4;
        m.model.control.termination.end_time = 2.5e-4;
        Diagnostics diagnostics;
        Solver solver(m.model, {}, diagnostics);
        test::Watch watch;
        solver.attach(watch);
        ASSERT_EQ(solver.run(), StopReason::end_time);
        const State& s = solver.state();
        EXPECT_LT(watch.momentum_error, 1e-12 * watch.scale);
        EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
        EXPECT_LT(std::abs(watch.sliding_when_free), 0.01 * watch.energy);
        double top = 0, bottom = 1;
        for (NodeIndex n = 0; n < m.node_count(); ++n) n < split ? top = std::max(top, s.nodes.x[n].y) : bottom = std::min(bottom, s.nodes.x[n].y);
        EXPECT_GT(bottom, top - 1e-5);
        EXPECT_LT(test::momentum(s, 0, split).y, -0.3 * watch.scale);
      }
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, Rebound,
    testing::Values(Pairing{"solids", true, false, true, false}, Pairing{"solid_on_shells", false, false, true, false},
                    Pairing{"shells_on_solid", true, false, false, false}, Pairing{"shells", false, false, false, false},
                    Pairing{"rigid_solid_on_solid", true, false, true, true}, Pairing{"shells_on_rigid_shells", false, true, false, false},
                    Pairing{"solid_on_rigid_solid", true, true, true, false}, Pairing{"rigid_solids", true, true, true, true},
                    Pairing{"rigid_shells", false, true, false, true}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace kardan

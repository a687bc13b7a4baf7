#include "kardan/elements/section_forces.hpp"

#include "elements/beam_bench.hpp"

namespace kardan {
namespace {

/// A strip pulled along x: tension acts away from the elements on the tail's side, with the closed form's size; turned axes turn it.
TEST(SectionForces, StripInTensionPullsTowardsTheHead) {
  test::Bench b;
  const PartIndex p = b.shell_part(0.01, 7800, 210e9, 0.0);
  test::mesh(b, p, 6, 1, 0.6, 0.1, [](const Vec3& x) { return x; });
  Frame frame;
  frame.axes = Mat3::columns({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  b.model.frames.push_back(frame);
  CrossSection section;
  section.nodes = {3, 10};  // x = 0.3
  section.elements[static_cast<std::size_t>(ElementKind::shell)] = {2};
  b.model.cross_sections = {section, section};
  b.model.cross_sections[1].frame = 0;
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const double rate = 10, dt = 1e-6;
  double stretched = 0;
  for (int i = 0; i < 20; ++i) {
    b.step(dt, [] {},
           [&] {
             for (std::size_t n = 0; n < b.state.nodes.v.size(); ++n) b.state.nodes.v[n] = {rate * b.model.nodes.x[n].x, 0, 0};
           });
    if (i > 0) stretched += rate * dt;
  }
  const SectionReport& s = b.state.sections.at(0);
  EXPECT_NEAR(s.force.x, 210e9 * std::log1p(stretched) * 0.01 * 0.1, 1e-6 * s.force.x);
  EXPECT_NEAR(s.force.y, 0, 1e-9 * s.force.x);
  EXPECT_NEAR(s.centroid.x, b.state.nodes.x[3].x - b.state.nodes.v[3].x * dt, 1e-12);
  EXPECT_NEAR(norm(s.moment), 0, 1e-9 * s.force.x);
  const SectionReport& turned = b.state.sections.at(1);
  EXPECT_NEAR(turned.force.y, -s.force.x, 1e-9 * s.force.x);
  EXPECT_NEAR(turned.force.x, 0, 1e-9 * s.force.x);
}

/// A cantilever of beams: at the cut the section carries what the end is loaded with, and its moment about the section's middle.
TEST(SectionForces, CutThroughBeamsCarriesTheEndsForceAndItsMoment) {
  test::BeamBench b;
  const PartIndex p = b.beam_part(test::rectangle(0.02, 0.02), 7800, 210e9, 0.3);
  const std::vector<NodeIndex> nodes = b.line(p, {0, 0, 0}, {0.4, 0, 0}, 4, {0, 1, 0});
  CrossSection section;
  section.nodes = {nodes[2]};
  section.elements[static_cast<std::size_t>(ElementKind::beam)] = {1};  // on the clamped side of the cut
  b.model.cross_sections = {section};
  b.start();
  ASSERT_TRUE(b.diagnostics.ok());
  const Vec3 load{50, 20, -10};
  b.forces();
  const double dt = 0.8 * b.elements->stable_time_step();
  for (int i = 0; i < 60000; ++i) {
    b.step(dt, [&] { b.state.nodes.force[static_cast<std::size_t>(nodes[4])] += load * std::min(1.0, i / 6000.0); },
           [&] {
             b.slow_down(0.999);
             b.clamp(nodes[0]);
           });
  }
  const SectionReport& s = b.state.sections.at(0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(s.force[c], load[c], 0.01 * norm(load));
  const Vec3 arm = b.state.nodes.x[static_cast<std::size_t>(nodes[4])] - b.state.nodes.x[static_cast<std::size_t>(nodes[2])];
  const Vec3 moment = cross(arm, load);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(s.moment[c], moment[c], 0.01 * norm(moment));
}

}  // namespace
}  // namespace kardan

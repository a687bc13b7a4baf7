#include "kardan/elements/section_forces.hpp"

#include "elements/bench.hpp"

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

}  // namespace
}  // namespace kardan

// SOFT = 1 and 2: contact of parts whose stiffnesses differ by far.
#include <gtest/gtest.h>

#include "contact/contact_run.hpp"

namespace kardan {
namespace {

/// A steel plate falls flat on a block of foam fifty thousand times softer. The stiffness of the materials (SOFT = 0) would let it sink in by
/// much of an element; by masses and step it does not, the run stays stable and the energy closes.
TEST(Soft, FoamIsNotSwallowedBySteel) {
  std::vector<double> deepest;
  for (const int soft : {0, 1, 2}) {
    SCOPED_TRACE(soft);
    test::Meshes m;
    const PartIndex foam = m.solid_part(ElasticMaterial{50, 4e6, 0.0, 0, 0}), steel = m.solid_part(ElasticMaterial{7800, 210e9, 0.3, 0, 0});
    m.block(foam, {5, 5, 5}, {}, {0.1, 0.1, 0.1});
    const NodeIndex split = m.node_count();
    m.block(steel, {3, 3, 1}, {-0.021, -0.017, 0.1005}, {0.14, 0.14, 0.01});
    for (NodeIndex n = 0; n < 36; ++n) m.model.nodes.constrained[n] = 7;  // the foam stands on the ground
    m.throw_from(split, m.node_count(), {0, 0, -2});
    Contact& contact = m.surface_to_surface({steel}, {foam});
    contact.soft = soft;
    m.model.control.hourglass_type = 4;
    m.model.control.termination.end_time = 0.008;
    Diagnostics diagnostics;
    Solver solver(m.model, {}, diagnostics);
    double depth = 0;
    test::Watch watch;
    watch.each = [&](const Model&, const State& s) {
      double top = 0, bottom = 1;
      for (NodeIndex n = 0; n < m.node_count(); ++n) n < split ? top = std::max(top, s.nodes.x[n].z) : bottom = std::min(bottom, s.nodes.x[n].z);
      depth = std::max(depth, top - bottom);
    };
    solver.attach(watch);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    EXPECT_GT(watch.most_touches, 20);
    EXPECT_LT(watch.energy_error, 0.01 * watch.energy);
    EXPECT_GT(test::momentum(solver.state(), split, m.node_count()).z, 0);  // it came back
    deepest.push_back(depth);
  }
  EXPECT_LT(deepest[1], 0.1 * 0.02);  // a tenth of an element
  EXPECT_LT(deepest[2], 0.1 * 0.02);
  EXPECT_GT(deepest[0], 2 * deepest[1]);
  EXPECT_GT(deepest[0], 2 * deepest[2]);
}

}  // namespace
}  // namespace kardan

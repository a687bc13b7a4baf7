// Deformable solids in the whole step, joined to a rigid body at shared nodes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kardan/solver/solver.hpp"

namespace kardan {
namespace {

PartIndex add_part(Model& model, Material material) {
  Section section;
  section.kind = ElementKind::solid;
  const auto p = static_cast<PartIndex>(model.parts.size());
  section.id = material.id = p + 1;
  model.sections.push_back(section);
  model.materials.push_back(material);
  Part part;
  part.id = p + 1;
  part.section = part.material = p;
  model.parts.push_back(part);
  return p;
}

/// A column of `count` cubes of 0.1 along z: the first of part 0 (rigid), the others of part 1 (elastic), in free
/// space; the free nodes start with a velocity that bends, twists and stretches.
Model column(int count) {
  Model model;
  Material rigid, elastic;
  rigid.law = RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3};
  elastic.law = ElasticMaterial{7800, 210e9, 0.3, 0, 0};
  add_part(model, rigid);
  add_part(model, elastic);
  constexpr double h = 0.1;
  for (int k = 0; k <= count; ++k) {
    for (const auto& corner : {std::array{0, 0}, std::array{1, 0}, std::array{1, 1}, std::array{0, 1}}) {
      const auto n = static_cast<NodeIndex>(model.nodes.size());
      model.nodes.id.push_back(n + 1);
      model.nodes.index_of.emplace(n + 1, n);
      model.nodes.x.push_back({h * corner[0], h * corner[1], h * k});
      model.nodes.constrained.push_back(0);
      if (k < 2) continue;
      InitialVelocity initial;
      initial.nodes = {n};
      initial.velocity = Vec3{3.0 * k - 4.0 * corner[1], 2.0 + 4.0 * corner[0], 0.5 * k};
      model.initial_velocities.push_back(initial);
    }
  }
  for (int k = 0; k < count; ++k) {
    const NodeIndex a = 4 * k;
    model.solids.id.push_back(k + 1);
    model.solids.part.push_back(k == 0 ? 0 : 1);
    model.solids.nodes.push_back({a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7});
  }
  model.control.termination.end_time = 1e-2;
  model.control.hourglass_type = 4;
  return model;
}

/// Linear and angular momentum (about the origin) of bodies and free nodes; with `size`, the sum of their magnitudes.
std::array<Vec3, 2> momentum(const State& s, double* size = nullptr) {
  Vec3 linear, angular;
  double sum = 0;
  const auto add = [&](const Vec3& x, const Vec3& p) {
    linear += p;
    angular += cross(x, p);
    sum += norm(p);
  };
  for (std::size_t b = 0; b < s.bodies.motion.size(); ++b) {
    add(s.bodies.motion[b].center, s.bodies.motion[b].velocity * s.bodies.info[b].mass);
    angular += s.bodies.motion[b].angular_momentum;
  }
  for (std::size_t n = 0; n < s.nodes.x.size(); ++n) {
    if (s.nodes.body[n] == none) add(s.nodes.x[n], s.nodes.v[n] * s.nodes.mass[n]);
  }
  if (size) *size = sum;
  return {linear, angular};
}

TEST(DeformableSolids, ColumnOnARigidBodyKeepsMomentumAndEnergy) {
  const Model model = column(8);
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  const State& state = solver.state();
  ASSERT_EQ(state.bodies.motion.size(), 1u);
  EXPECT_NEAR(state.bodies.info[0].mass, 1.5 * 7.8, 1e-9);  // the shared nodes bring half a cube of the elastic part
  double size = 0;
  const auto start = momentum(state, &size);
  ASSERT_GT(size, 0.0);
  ASSERT_TRUE(solver.step());
  EXPECT_EQ(state.step_owner.kind, TimeStepOwner::Kind::solid);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  EXPECT_GT(state.clock.cycle, 500);
  EXPECT_GT(norm(state.bodies.motion[0].angular_velocity), 1.0);  // it was dragged along
  const auto end = momentum(state);
  EXPECT_LT(norm(end[0] - start[0]), 1e-11 * size);
  EXPECT_LT(norm(end[1] - start[1]), 1e-11 * size);  // arms are about 1 m
  EXPECT_NEAR(state.energy.ratio(), 1.0, 0.01);
  EXPECT_GT(state.energy.part_internal[1], 0.0);
  EXPECT_EQ(state.energy.part_internal[0], 0.0);
}

TEST(DeformableSolids, PartsReportTheirMassAndShareTheMomentum) {
  Model model = column(8);
  model.materials[0].law = model.materials[1].law;
  model.control.termination.end_time = 1e-3;
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  const State& state = solver.state();
  EXPECT_NEAR(state.energy.part_mass[0], 7.8, 1e-9);
  EXPECT_NEAR(state.energy.part_mass[1], 7 * 7.8, 1e-9);
  double size = 0;
  const auto start = momentum(state, &size);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  ASSERT_EQ(state.energy.part_momentum.size(), 2u);
  EXPECT_LT(norm(state.energy.part_momentum[0] + state.energy.part_momentum[1] - start[0]), 1e-11 * size);
  EXPECT_GT(norm(state.energy.part_momentum[0]), 0.0);  // it began at rest
}

/// What is seen of a section and of the nodes beyond it, in every cycle.
class SectionWatch : public Observer {
 public:
  bool due(const State&, const StepView&) override { return true; }
  void at(const Model& model, const State& state, const StepView&) override {
    const SectionReport& section = state.sections.at(0);
    Vec3 force, moment;
    for (std::size_t n = 0; n < state.nodes.x.size(); ++n) {
      if (model.nodes.x[n].z < 0.45) continue;
      const Vec3 ma = state.nodes.a[n] * state.nodes.mass[n];
      force += ma;
      moment += cross(state.nodes.x[n] - section.centroid, ma);
    }
    largest = std::max(largest, norm(force));
    force_error = std::max(force_error, norm(force + section.force));
    moment_error = std::max(moment_error, norm(moment + section.moment));
  }
  double largest = 0, force_error = 0, moment_error = 0;
};

/// Newton's law for the free end: its nodes lose what the section's nodes exert on the elements that the plane cuts.
TEST(DeformableSolids, SectionForceMovesTheEndBeyondIt) {
  Model model = column(8);
  model.control.termination.end_time = 1e-3;
  CrossSection section;
  section.nodes = {20, 21, 22, 23};  // z = 0.5
  section.elements[static_cast<std::size_t>(ElementKind::solid)] = {4};
  model.cross_sections.push_back(section);
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  SectionWatch watch;
  solver.attach(watch);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  EXPECT_GT(watch.largest, 1e5);
  EXPECT_LT(watch.force_error, 1e-10 * watch.largest);
  EXPECT_LT(watch.moment_error, 1e-10 * watch.largest);
}

TEST(DeformableSolids, VelocitiesAgainstSupportsAreNoEnergyToBeginWith) {
  Model model = column(4);
  for (const NodeIndex n : model.solids.nodes[3]) model.nodes.constrained[static_cast<std::size_t>(n)] = 0b000001;  // x
  model.control.termination.end_time = 1e-3;
  Diagnostics diagnostics;
  Solver solver(model, {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok());
  EXPECT_EQ(solver.run(), StopReason::end_time);
  const EnergyLedger& energy = solver.state().energy;
  EXPECT_NEAR(energy.total(), energy.initial, 0.05 * energy.initial);  // counted with them it would be 2.3 times that
}

}  // namespace
}  // namespace kardan

// Beams of all kinds between a rigid part, deformable shells and a nodal rigid body, in the whole step.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "handmade_model.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan {
namespace {

struct Assembly : test::HandmadeModel {
  template <class Law>
  PartIndex part(const Section& section, const Law& law) {
    return HandmadeModel::part(section, material_of(law));
  }
  template <class Law>
  PartIndex beam_part(const BeamSection& beam, const Law& law) {
    Section section;
    section.kind = ElementKind::beam;
    section.beam = beam;
    return part(section, law);
  }
  void beam(PartIndex p, NodeIndex a, NodeIndex b, NodeIndex c) {
    model.beams.id.push_back(100 + static_cast<UserId>(model.beams.id.size()));
    model.beams.part.push_back(p);
    model.beams.nodes.push_back({a, b, c});
  }
  NodeIndex chain(PartIndex p, NodeIndex from, const Vec3& step, int count, NodeIndex third) {
    for (int i = 0; i < count; ++i) {
      const NodeIndex next = node(model.nodes.x[static_cast<std::size_t>(from)] + step);
      beam(p, from, next, third);
      from = next;
    }
    return from;
  }
};

/// A rigid cube, a Hughes-Liu chain from its corner to a plate of shells, a Belytschko-Schwer chain from the plate to a nodal rigid body,
/// and a discrete beam from there to a loose mass. All parts fly, turn and swing.
Model assembly() {
  Assembly a;
  const ElasticMaterial steel{7800, 210e9, 0.3, 0, 0};
  Section solid, shell;
  solid.kind = ElementKind::solid;
  shell.kind = ElementKind::shell;
  shell.shell.thickness = {0.01, 0.01, 0.01, 0.01};
  const PartIndex cube = a.part(solid, RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3});
  const PartIndex plate = a.part(shell, steel);
  BeamSection sizes;
  sizes.ts = {0.02, 0.02};
  sizes.tt = {0.03, 0.03};
  const PartIndex integrated = a.beam_part(sizes, steel);
  BeamSection resultant;
  resultant.elform = beam_elform::belytschko_schwer;
  resultant.area = 4e-4;
  resultant.iss = resultant.itt = 2e-8;
  const PartIndex cubic = a.beam_part(resultant, steel);
  BeamSection spring;
  spring.elform = beam_elform::discrete;
  spring.scoor = 3;
  spring.volume = 1e-3;
  spring.inertia = 0.1;
  FieldMaterial law;
  law.number = 66;
  law.density = 1000;
  law.values = {{"tkr", 1e6}, {"tks", 2e6}, {"tkt", 1e6}, {"rkr", 1e3}, {"rks", 1e3}, {"rkt", 2e3}};
  const PartIndex discrete = a.beam_part(spring, law);

  std::array<NodeIndex, 8> corner{};
  for (int i = 0; i < 8; ++i) {
    const int k = i % 4;
    corner[static_cast<std::size_t>(i)] = a.node({k == 1 || k == 2 ? 0.1 : 0.0, k >= 2 ? 0.1 : 0.0, i >= 4 ? 0.1 : 0.0});
  }
  a.model.solids.id.push_back(1);
  a.model.solids.part.push_back(cube);
  a.model.solids.nodes.push_back(corner);
  const NodeIndex third = a.node({0, 9, 3});
  const NodeIndex at_plate = a.chain(integrated, corner[6], {0.1, 0.02, 0.0}, 6, third);
  const Vec3 o = a.model.nodes.x[static_cast<std::size_t>(at_plate)];
  const NodeIndex p2 = a.node(o + Vec3{0.15, 0, 0}), p3 = a.node(o + Vec3{0.15, 0.15, 0}), p4 = a.node(o + Vec3{0, 0.15, 0});
  a.model.shells.id.push_back(1);
  a.model.shells.part.push_back(plate);
  a.model.shells.nodes.push_back({at_plate, p2, p3, p4});
  const NodeIndex end = a.chain(cubic, p3, {0.02, 0.1, 0.05}, 5, third);
  const NodeIndex far = a.node(a.model.nodes.x[static_cast<std::size_t>(end)] + Vec3{0.2, 0, 0.1});
  NodalRigidBody body;
  body.id = 900;
  body.nodes = {end, far};
  a.model.nodal_rigid_bodies.push_back(body);
  Part of_body;
  of_body.id = 900;
  of_body.nodal_rigid_body = 0;
  a.model.nodal_rigid_bodies[0].part = static_cast<PartIndex>(a.model.parts.size());
  a.model.parts.push_back(of_body);
  PointInertia heavy;
  heavy.node = far;
  heavy.mass = 3;
  heavy.inertia = Mat3::identity() * 0.02;
  a.model.inertias.push_back(heavy);
  const NodeIndex loose = a.node(a.model.nodes.x[static_cast<std::size_t>(far)] + Vec3{0.3, 0.1, 0});
  a.beam(discrete, far, loose, third);
  for (std::size_t n = 8; n < a.model.nodes.size(); ++n) {
    const Vec3 x = a.model.nodes.x[n];
    if (static_cast<NodeIndex>(n) == third || static_cast<NodeIndex>(n) == end || static_cast<NodeIndex>(n) == far) continue;
    InitialVelocity initial;
    initial.nodes = {static_cast<NodeIndex>(n)};
    initial.velocity = Vec3{-3 * x.y, 3 * x.x, 6 * x.x * x.x};
    a.model.initial_velocities.push_back(initial);
  }
  a.model.control.termination.end_time = 0.02;
  a.model.control.hourglass_type = 4;
  return a.model;
}

std::array<Vec3, 2> momentum(const State& s) {
  Vec3 linear, angular;
  for (std::size_t b = 0; b < s.bodies.motion.size(); ++b) {
    const Vec3 p = s.bodies.motion[b].velocity * s.bodies.info[b].mass;
    linear += p;
    angular += cross(s.bodies.motion[b].center, p) + s.bodies.motion[b].angular_momentum;
  }
  for (std::size_t n = 0; n < s.nodes.x.size(); ++n) {
    if (s.nodes.body[n] != none) continue;
    linear += s.nodes.v[n] * s.nodes.mass[n];
    angular += cross(s.nodes.x[n], s.nodes.v[n] * s.nodes.mass[n]) + s.nodes.omega[n] * s.nodes.inertia[n];
  }
  return {linear, angular};
}

TEST(Beams, BetweenRigidBodiesAndShellsKeepMomentaAndEnergy) {
  Diagnostics diagnostics;
  const Model model = assembly();
  Solver solver(model, {}, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) ASSERT_NE(d.severity, Severity::error) << d.message;
  const State& state = solver.state();
  ASSERT_EQ(state.bodies.motion.size(), 2u);
  const auto start = momentum(state);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  const auto end = momentum(state);
  EXPECT_LT(norm(end[0] - start[0]), 1e-10 * norm(start[0]));
  EXPECT_LT(norm(end[1] - start[1]), 1e-9 * norm(start[1]));
  EXPECT_NEAR(state.energy.ratio(), 1.0, 0.01);
  for (const PartIndex p : {2, 3, 4}) EXPECT_GT(state.energy.part_internal[static_cast<std::size_t>(p)], 0) << p;
  for (const BodyMotion& body : state.bodies.motion) EXPECT_GT(norm(body.angular_velocity), 0.1);
  EXPECT_GT(std::abs(state.results.beam.axial.back()), 0);
}

TEST(Beams, SmallNodalRigidBodyBetweenBeamsIsStable) {
  Assembly a;
  BeamSection sizes;
  sizes.ts = sizes.tt = {0.02, 0.02};
  const PartIndex p = a.beam_part(sizes, ElasticMaterial{7800, 210e9, 0.3, 0, 0});
  const NodeIndex third = a.node({0, 9, 3});
  const NodeIndex left = a.chain(p, a.node({0, 0, 0}), {0.1, 0, 0}, 3, third);
  const NodeIndex right = a.node({0.3, 1e-4, 0}), loose = a.node({0.3, 0, 1e-4});  // a tenth of a millimetre: hardly an inertia of its own
  a.chain(p, right, {0.1, 0, 0}, 3, third);
  PointInertia mass;
  mass.node = loose;
  mass.mass = 1e-3;
  a.model.inertias.push_back(mass);
  NodalRigidBody body;
  body.id = 900;
  body.nodes = {left, right, loose};
  body.part = static_cast<PartIndex>(a.model.parts.size());
  a.model.nodal_rigid_bodies.push_back(body);
  Part of_body;
  of_body.id = 900;
  of_body.nodal_rigid_body = 0;
  a.model.parts.push_back(of_body);
  for (const NodeIndex n : a.model.beams.nodes[3]) {
    if (n == third || n == right) continue;
    InitialVelocity initial;
    initial.nodes = {n};
    initial.velocity = Vec3{0, 1, -20};
    a.model.initial_velocities.push_back(initial);
  }
  a.model.control.termination.end_time = 0.05;
  a.model.control.time_step.scale = 0.3;  // a jump of velocity excites the highest modes, whose energy is measured well only in small steps
  Diagnostics diagnostics;
  Solver solver(a.model, {}, diagnostics);
  ASSERT_TRUE(diagnostics.ok());
  EXPECT_EQ(solver.run(), StopReason::end_time);
  EXPECT_GT(solver.state().clock.cycle, 2000);
  EXPECT_NEAR(solver.state().energy.ratio(), 1.0, 0.02);
}

}  // namespace
}  // namespace kardan

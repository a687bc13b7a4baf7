// Ties without springs, in the whole step.
#include "kardan/contact/kinematic_ties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "contact/ties.hpp"
#include "kardan/model/beam_sections.hpp"

namespace kardan {
namespace {

using test::Balance;
using test::balance_of;
using test::Each;
using test::messages;
using test::Ties;
using Holding = Tie::Holding;

/// A coarse block under a fine one, n by n elements in the interface, on a square of edge 1; `gap` between them.
struct TwoBlocks : Ties {
  PartIndex low, high;
  NodeIndex first_high;
  TwoBlocks(const decltype(Material::law)& law, int coarse, int fine, double gap, Holding holding) {
    low = solid_part(law);
    high = solid_part(law);
    block(low, {coarse, coarse, 3}, {0, 0, -1.5}, {1, 1, 1.5});
    first_high = block(high, {fine, fine, 4}, {0, 0, gap}, {1, 1, 1});
    tie(side({high}), {low}, holding);
    model.control.hourglass_type = 4;
  }
};

/// Uniform uniaxial strain rate: with nested meshes the trapezoidal sums of the tied nodes are the integrals of the corners' shape functions, so
/// the tractions of both blocks cancel node by node and nothing in the interface moves off the linear field. With other meshes only the
/// sum does.
TEST(KinematicTies, PassUniformStressBetweenNestedMeshes) {
  const auto worst_acceleration = [](int coarse, int fine) {
    TwoBlocks b(test::cork, coarse, fine, 0, Holding::constraint);
    b.start(0, b.node_count(), [](const Vec3& x) { return Vec3{0, 0, -x.z}; });
    b.model.control.bulk_q1 = b.model.control.bulk_q2 = 0;  // pressures of the elements' sizes
    b.model.control.termination.end_cycle = 1;
    b.model.control.termination.end_time = 1;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    double at_ends = 0, inside = 0;
    Each each([&](const State& s) {
      for (std::size_t n = 0; n < s.nodes.x.size(); ++n) {
        const double z = b.model.nodes.x[n].z, a = norm(s.nodes.a[n]);
        (z < -1.4 || z > 0.9 ? at_ends : inside) = std::max(z < -1.4 || z > 0.9 ? at_ends : inside, a);
      }
    });
    solver.attach(each);
    solver.run();
    return inside / at_ends;
  };
  EXPECT_LT(worst_acceleration(2, 4), 1e-9);
  EXPECT_LT(worst_acceleration(1, 3), 1e-9);
  const double unmatched = worst_acceleration(2, 3);
  EXPECT_GT(unmatched, 1e-3);
  EXPECT_LT(unmatched, 0.5);
}

/// A step wave of velocity runs through the interface of two meshes as through one: the far end, at rest before, moves with twice the velocity
/// of the wave, d'Alembert's solution, and comes no later than through a bar of one mesh.
TEST(KinematicTies, LetWavesThrough) {
  const double c = std::sqrt(test::cork.youngs_modulus / test::cork.density);
  const auto far_end = [&](bool tied) {
    Ties b;
    const PartIndex left = b.solid_part(test::cork), right = b.solid_part(test::cork);
    b.block(left, {40, 1, 1}, {}, {4, 0.2, 0.2});
    if (tied) {
      b.block(right, {80, 2, 2}, {4, 0, 0}, {4, 0.2, 0.2});
      b.tie(b.side({right}), {left}, Holding::constraint);
    } else {
      b.model = {};
      const PartIndex whole = b.solid_part(test::cork);
      b.block(whole, {80, 1, 1}, {}, {8, 0.2, 0.2});
    }
    b.model.control.hourglass_type = 4;
    std::vector<NodeIndex> driven;
    std::size_t end = 0;
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      if (b.model.nodes.x[n].x == 0) driven.push_back(static_cast<NodeIndex>(n));
      if (b.model.nodes.x[n].x > b.model.nodes.x[end].x) end = n;
    }
    b.drive(driven, 1, 1.0);
    b.model.control.termination.end_time = 10 / c;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    solver.run();
    return solver.state().nodes.x[end].x - b.model.nodes.x[end].x;
  };
  const double exact = 2 * 2 / c, tied = far_end(true);
  EXPECT_NEAR(tied, exact, 0.02 * exact);
  EXPECT_NEAR(tied, far_end(false), 0.01 * exact);
}

/// What SPR and MPR ask for: forces of single nodes, whose sums are the contact's, without and with springs.
TEST(KinematicTies, ReportForcesOfNodes) {
  for (const Holding holding : {Holding::constrained_offset, Holding::offset}) {
    TwoBlocks b(test::steel, 2, 3, 0.01, holding);
    b.model.contacts[0].tracked.report_nodes = b.model.contacts[0].reference.report_nodes = true;
    b.spin({0.3, 0.2, 0}, {300, -200, 400}, {50, 20, -10});
    b.model.control.termination.end_time = 5e-4;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    ASSERT_EQ(solver.run(), StopReason::end_time);
    const ContactReport& report = solver.state().contacts[0];
    ASSERT_GT(norm(report.force), 0);
    Vec3 tracked, reference, moment;
    std::size_t loaded = 0;
    for (std::size_t i = 0; i < report.nodes[0].size(); ++i) {
      tracked += report.nodal_force[0][i];
      moment += cross(solver.state().nodes.x[static_cast<std::size_t>(report.nodes[0][i])], report.nodal_force[0][i]);
      loaded += report.nodal_force[0][i] != Vec3{};
    }
    for (const Vec3& f : report.nodal_force[1]) reference += f;
    EXPECT_EQ(loaded, 16u);
    EXPECT_LT(norm(tracked - report.force), 1e-12 * norm(report.force));
    EXPECT_LT(norm(reference + report.force), 1e-11 * norm(report.force));
    EXPECT_LT(norm(moment - report.moment), 1e-11 * norm(report.moment));
    EXPECT_EQ(report.segments[0].size(), 2 * 9 + 4 * 12u);
  }
}

/// Unmatched blocks that fly, turn and swing, with and without a gap; plates tied with their rotations.
TEST(KinematicTies, KeepMomentaAndEnergy) {
  for (const double gap : {0.0, 0.01}) {
    TwoBlocks b(test::steel, 2, 3, gap, Holding::constrained_offset);
    b.spin({0.3, 0.2, 0}, {300, -200, 400}, {50, 20, -10});
    b.model.control.termination.end_time = 0.01;
    const Balance worst = balance_of(b.model);
    EXPECT_LT(worst.linear, 1e-12) << gap;
    EXPECT_LT(worst.angular, 1e-12) << gap;
    EXPECT_LT(worst.energy, 1e-3) << gap;
  }
  Ties b;
  const PartIndex floor = b.shell_part(test::steel, 0.02), web = b.shell_part(test::steel, 0.02);
  b.plate(floor, 3, 3, {}, {1, 0, 0}, {0, 1, 0});
  const NodeIndex edge = b.plate(web, 4, 3, {0.1, 0.55, 0.01}, {0.8, 0, 0}, {0, 0, 0.6});
  b.tie(Ties::side_of_nodes(Ties::range(edge, edge + 5)), {floor}, Holding::constrained_offset).tie.rotations = true;
  b.spin({0.3, 0.2, 0}, {30, -20, 40}, {50, 20, -10});
  b.model.control.time_step.scale = 0.45;
  b.model.control.termination.end_time = 0.01;
  const Balance worst = balance_of(b.model);
  EXPECT_LT(worst.linear, 1e-12);
  EXPECT_LT(worst.angular, 1e-12);
  EXPECT_LT(worst.energy, 1e-3);
}

/// A weld beam upright on a plate of one shell, whose corners are held.
struct Weld : Ties {
  PartIndex plate;
  static constexpr NodeIndex foot = 4, tip = 10;
  explicit Weld(std::uint8_t held) {
    Section section;
    section.kind = ElementKind::beam;
    section.beam.elform = beam_elform::hughes_liu;
    section.beam.ts = {0.02, 0.02};
    section.beam.tt = {0.02, 0.02};
    const PartIndex weld = part(section, material_of(test::steel));
    plate = shell_part(test::steel, 0.01);
    Ties::plate(plate, 1, 1, {-0.1, -0.12, 0}, {0.3, 0, 0}, {0, 0.3, 0});
    for (int i = 0; i <= 6; ++i) node({0, 0, 0.03 * i});
    const NodeIndex third = node({1, 0, 0.1});
    for (NodeIndex n = foot; n < tip; ++n) {
      model.beams.id.push_back(n);
      model.beams.part.push_back(weld);
      model.beams.nodes.push_back({n, n + 1, third});
    }
    for (std::size_t n = 0; n < foot; ++n) model.nodes.constrained[n] = held;
    model.control.termination.end_time = 2e-3;
  }
  void load(int dof, double force) {
    PointLoad load;
    load.nodes = {tip};
    load.dof = dof;
    load.curve = curve({0, 1}, {force, force});
    model.point_loads.push_back(load);
  }
};

/// A beam welded to a plate whose nodes are held behaves as one whose end is held: its axial and shear forces and all moments are carried. By
/// springs nearly so.
TEST(KinematicTies, WeldCarriesForcesAndMoments) {
  const auto path_of_tip = [](std::optional<Holding> holding) {
    Weld b(dof_all);
    if (holding) b.tie(Ties::side_of_nodes({Weld::foot}), {b.plate}, *holding).tie.rotations = true;
    else b.model.nodes.constrained[Weld::foot] = dof_all;
    for (int dof = 1; dof <= 3; ++dof) b.load(dof, dof * 1e4);
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    std::vector<Vec3> path;
    Each each([&](const State& s) { path.push_back(s.nodes.x[Weld::tip]); });
    solver.attach(each);
    solver.run();
    return path;
  };
  const std::vector<Vec3> held = path_of_tip({}), welded = path_of_tip(Holding::constraint), sprung = path_of_tip(Holding::beam_offset);
  ASSERT_EQ(welded.size(), held.size());
  double way = 0, apart = 0, softer = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    way = std::max(way, norm(held[i] - held[0]));
    apart = std::max(apart, norm(welded[i] - held[i]));
  }
  for (const Vec3& x : sprung) softer = std::max(softer, norm(x - held[0]));
  EXPECT_GT(way, 1e-3);
  EXPECT_LT(apart, 1e-9 * way);
  EXPECT_GT(softer, way);
  EXPECT_LT(softer, 1.3 * way);
}

/// The corners' rotations are free: torsion about the plate's normal finds resistance only _WITH_TORSION, by forces on the corners. The dynamic
/// angle is then at most twice the static one, T L/(G J), J = 0.1406 a^4 (Saint-Venant).
TEST(KinematicTies, TorsionIsCarriedIfAskedFor) {
  for (const Holding holding : {Holding::constraint, Holding::beam_offset})
    for (const bool torsion : {false, true}) {
      Weld b(dof_translations);
      Tie& tie = b.tie(Ties::side_of_nodes({Weld::foot}), {b.plate}, holding).tie;
      tie.rotations = true;
      tie.torsion = torsion;
      b.load(7, 100);
      b.model.control.termination.end_time = 1.2e-2;
      Diagnostics diagnostics;
      Solver solver(b.model, {}, diagnostics);
      double angle = 0, largest = 0;
      Each each([&](const State& s) {
        angle += s.nodes.omega[Weld::tip].z * s.clock.dt;
        largest = std::max(largest, angle);
      });
      solver.attach(each);
      solver.run();
      const double static_angle = 100 * 0.18 / (210e9 / 2.6 * 0.1406 * std::pow(0.02, 4));
      if (torsion) EXPECT_NEAR(largest, 2 * static_angle, 0.5 * static_angle);
      else EXPECT_GT(largest, 5 * static_angle);
    }
}

/// A block tied to the side of a block whose bottom is tied to a third one: the segments' nodes are tied themselves.
TEST(KinematicTies, ChainsPassOnMassAndForces) {
  TwoBlocks b(test::steel, 2, 3, 0, Holding::constraint);
  const PartIndex third = b.solid_part(test::steel);
  const NodeIndex first = b.block(third, {2, 4, 3}, {1, 0, 0}, {0.5, 1, 0.8});
  b.tie(b.side({third}), {b.high}, Holding::constraint);
  b.spin({0.3, 0.2, 0}, {300, -200, 400}, {50, 20, -10});
  b.model.control.termination.end_time = 0.005;
  const Balance worst = balance_of(b.model);
  EXPECT_LT(worst.linear, 1e-12);
  EXPECT_LT(worst.angular, 1e-12);
  EXPECT_LT(worst.energy, 1e-3);
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.run();
  const auto& x = solver.state().nodes.x;
  const auto high = static_cast<std::size_t>(b.first_high);
  EXPECT_LT(norm(x[static_cast<std::size_t>(first)] - x[high + 3]), 1e-12);  // corners that began at one place
}

TEST(KinematicTies, NodesAreMovedOntoTheSurface) {
  TwoBlocks b(test::steel, 2, 3, 0.01, Holding::constraint);
  Diagnostics diagnostics;
  move_tied_nodes(b.model, diagnostics);
  for (int n = 0; n < 16; ++n) EXPECT_EQ(b.model.nodes.x[static_cast<std::size_t>(b.first_high + n)].z, 0);
  EXPECT_EQ(b.model.nodes.x[static_cast<std::size_t>(b.first_high) + 16].z, 0.26);
  EXPECT_NE(messages(diagnostics).find("16 nodes are moved onto the surface they are tied to, node"), std::string::npos) << messages(diagnostics);
  EXPECT_NE(messages(diagnostics).find("the farthest: 0.01"), std::string::npos) << messages(diagnostics);
}

TEST(KinematicTies, WhatCannotBeTiedIsNamed) {
  const auto said = [](Ties& b) {
    b.model.control.termination.end_time = 1e-5;
    Diagnostics diagnostics;
    try {
      Solver solver(b.model, {}, diagnostics);
    } catch (const InputError&) {
    }
    return messages(diagnostics);
  };
  {
    Ties b;  // a rigid block on a deformable one
    const PartIndex low = b.solid_part(test::steel), high = b.solid_part(RigidMaterial{.density = 7800, .youngs_modulus = 210e9, .poissons_ratio = 0.3});
    b.block(low, {1, 1, 1}, {0, 0, -1}, {1, 1, 1});
    b.block(high, {1, 1, 1}, {}, {1, 1, 1});
    b.tie(b.side({high}), {low}, Holding::constraint);
    EXPECT_NE(said(b).find("4 nodes to be tied without a spring belong to rigid bodies or lie on segments of them: 9, 10, 11, 12"), std::string::npos) << said(b);
    b.model.contacts[0].tie.holding = Holding::offset;
    EXPECT_EQ(said(b).find("error"), std::string::npos) << said(b);
  }
  {
    TwoBlocks b(test::steel, 1, 2, 0, Holding::constraint);  // a support of a tied node alone, then of its segment too
    const auto corner = static_cast<std::size_t>(b.first_high);
    b.model.nodes.constrained[corner] = dof_x;
    EXPECT_NE(said(b).find("1 node to be tied are held"), std::string::npos) << said(b);
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n)
      if (b.model.nodes.x[n].x == 0) b.model.nodes.constrained[n] = dof_x;
    EXPECT_EQ(said(b).find("error"), std::string::npos) << said(b);
    b.drive({b.first_high + 4}, 3, 1);
    EXPECT_NE(said(b).find("moved by a prescribed motion"), std::string::npos) << said(b);
  }
  {
    TwoBlocks b(test::steel, 1, 2, 0, Holding::constraint);  // each on the other
    b.tie(b.side({b.low}), {b.high}, Holding::constraint);
    EXPECT_NE(said(b).find("by way of others, to segments of theirs"), std::string::npos) << said(b);
  }
  {
    TwoBlocks b(test::steel, 1, 2, 0.3, Holding::offset);  // too far, then near enough by SAST
    b.model.contacts[0].tracked = Ties::side_of_nodes(Ties::range(b.first_high, b.first_high + 9));
    EXPECT_NE(said(b).find("0 of 9 nodes are tied; the others are too far from the surface or beside it, node (distance): 17 (0.3)"), std::string::npos) << said(b);
    b.model.contacts[0].tie.distance = 0.31;
    EXPECT_NE(said(b).find("9 of 9 nodes are tied"), std::string::npos) << said(b);
    b.model.contacts[0].birth = 1;
    EXPECT_NE(said(b).find("a tie that is born later is not available"), std::string::npos) << said(b);
  }
}

}  // namespace
}  // namespace kardan

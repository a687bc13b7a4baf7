// Mass scaling and the deletion of solids by DTMIN, in the whole step.
#include <gtest/gtest.h>

#include <cmath>

#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

constexpr double density = 7800, h = 0.1;

/// A column of `count` elastic cubes in free flight, bending and stretching; the last element is `squeezed` times as long.
Bricks flying_column(int count, double squeezed = 1) {
  Bricks b;
  b.column(b.part(ElasticMaterial{density, 210e9, 0.3, 0, 0}), count, h);
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    Vec3& x = b.model.nodes.x[n];
    if (n >= b.model.nodes.size() - 4) x.z -= h * (1 - squeezed);
    InitialVelocity initial;
    initial.nodes = {static_cast<NodeIndex>(n)};
    initial.velocity = {3 + 20 * x.z * x.z, 2, 10 * x.z};
    b.model.initial_velocities.push_back(initial);
  }
  b.model.control.hourglass_type = 4;
  b.model.control.termination.end_time = 1e-3;
  return b;
}

double first_step(const Bricks& b) {
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.step();
  return solver.view().step.dt;
}

/// One cube, DT2MS = -3 times its step: nine times the mass.
TEST(MassScaling, OneElementGetsTheMassOfItsStep) {
  Bricks b = flying_column(1);
  const double own = first_step(b) / 0.9;
  b.model.control.time_step.dt2ms = -3 * own;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.step();
  EXPECT_NEAR(solver.view().step.dt, 0.9 * 3 * own, 1e-12 * own);
  const double mass = density * h * h * h;
  EXPECT_NEAR(solver.state().added_mass.physical, mass, 1e-12 * mass);
  EXPECT_NEAR(solver.state().added_mass.added, 8 * mass, 1e-9 * mass);
  EXPECT_NEAR(solver.state().added_mass.percent(), 800, 1e-6);
  for (const double m : solver.state().nodes.mass) EXPECT_NEAR(m, 9 * mass / 8, 1e-9 * mass);
}

/// Only the short element is below DT2MS: the step is kept through the run, energy and momentum with what was added are conserved.
TEST(MassScaling, OnlyElementsBelowTheStepGetMass) {
  Bricks b = flying_column(6, 0.3);
  const double short_step = first_step(b);
  const double wanted = 1.8 * short_step / 0.9;
  b.model.control.time_step.dt2ms = -wanted;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  ASSERT_EQ(solver.run(), StopReason::end_time);
  const State& s = solver.state();
  EXPECT_GT(s.added_mass.added, 0.9 * 0.3 * density * h * h * h * (1.8 * 1.8 - 1));
  for (std::size_t n = 0; n < 16; ++n) EXPECT_NEAR(s.nodes.mass[n], density * h * h * h / (n < 4 ? 8 : 4), 1e-12) << n;
  EXPECT_NEAR(s.energy.total() - s.energy.external_work, s.energy.initial, 0.01 * s.energy.initial);
  // More cycles than the plain step would need means that the step was not kept.
  EXPECT_LT(static_cast<double>(s.clock.cycle), 1.05 * 1e-3 / (0.9 * wanted) + 10);
}

/// DT2MS > 0: all elements have the same step, long ones lose mass.
TEST(MassScaling, PositiveStepIsThatOfAllElements) {
  Bricks b = flying_column(4, 0.5);
  const double own = first_step(b) / 0.9;
  b.model.control.time_step.dt2ms = own;
  Diagnostics diagnostics;
  Solver solver(b.model, {}, diagnostics);
  solver.step();
  EXPECT_NEAR(solver.view().step.dt, 0.9 * own, 1e-9 * own);
  EXPECT_LT(solver.state().added_mass.added, 0.0);
}

/// Steps of elements that only fly differ by rounding from DT2MS in every cycle: that is no mass.
TEST(MassScaling, RoundingAddsNoMass) {
  for (const double sign : {-1.0, 1.0}) {
    Bricks b = flying_column(3, 0.7);
    for (InitialVelocity& initial : b.model.initial_velocities) initial.velocity = {31, 17, -23};
    b.model.control.time_step.dt2ms = sign * 1.37 * first_step(b);
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    solver.step();
    const double added = solver.state().added_mass.added, mass = solver.state().nodes.mass[0];
    for (int i = 0; i < 50; ++i) solver.step();
    EXPECT_EQ(solver.state().added_mass.added, added) << sign;
    EXPECT_EQ(solver.state().nodes.mass[0], mass) << sign;
  }
}

TEST(MassScaling, StopsAtEndmasAndActsOnceWithMs1st) {
  Bricks b = flying_column(1);
  b.model.control.time_step.dt2ms = -3 * first_step(b) / 0.9;
  b.model.control.termination.end_mass = 700;
  Diagnostics diagnostics;
  Solver stopped(b.model, {}, diagnostics);
  EXPECT_EQ(stopped.run(), StopReason::mass);
  b.model.control.termination.end_mass = 1e8;
  b.model.control.time_step.scale_mass_once = true;
  Solver once(b.model, {}, diagnostics);
  once.step();
  const double added = once.state().added_mass.added;
  ASSERT_EQ(once.run(), StopReason::end_time);
  EXPECT_EQ(once.state().added_mass.added, added);
}

/// A column is slowly pushed flat: with ERODE = 1 and DTMIN elements are deleted when their step has fallen far enough, and the run goes
/// on; their energy stays in the balance, the nodes fly on. Without ERODE the run stops at DTMIN.
TEST(Erosion, SolidsWhoseStepFallsBelowDtminAreDeleted) {
  for (const int erode : {1, 0}) {
    Bricks b;
    b.column(b.part(ElasticMaterial{density, 1e6, 0.0, 0, 0}), 3, h);
    for (const NodeIndex n : {0, 1, 2, 3}) b.model.nodes.constrained[static_cast<std::size_t>(n)] = dof_all;
    PointLoad load;
    load.nodes = {12, 13, 14, 15};
    load.dof = 3;
    load.curve = b.curve({0, 0.5}, {0, -2e3});
    b.model.point_loads.push_back(load);
    b.model.control.hourglass_type = 4;
    b.model.control.time_step.erode = erode;
    b.model.control.termination.dt_min = 0.6;
    b.model.control.termination.end_time = 0.5;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    const StopReason reason = solver.run();
    const State& s = solver.state();
    if (erode == 0) {
      EXPECT_EQ(reason, StopReason::min_step);
      continue;
    }
    EXPECT_EQ(reason, StopReason::end_time);
    EXPECT_GT(s.results.deleted_solids, 0);
    EXPECT_GT(s.energy.eroded_internal, 0.0);
    EXPECT_NEAR(s.energy.total(), s.energy.initial + s.energy.external_work, 0.02 * s.energy.external_work);
  }
}

/// The far face of a cube is thrown through the near one: with ERODE = 1 the cube turned inside out is deleted and its nodes fly
/// on with their velocity, without it the run breaks and says which element it was.
TEST(Erosion, SolidsTurnedInsideOutAreDeleted) {
  for (const int erode : {1, 0}) {
    Bricks b;
    b.column(b.part(ElasticMaterial{density, 1e6, 0.0, 0, 0}), 1, h);
    for (const NodeIndex n : {4, 5, 6, 7}) {
      InitialVelocity initial;
      initial.nodes = {n};
      initial.velocity = {0, 0, -30};
      b.model.initial_velocities.push_back(initial);
    }
    b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-12;  // it would stop the face
    b.model.control.time_step.erode = erode;
    b.model.control.termination.end_time = 0.05;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    if (erode == 0) {
      EXPECT_THROW(solver.run(), RunError);
      continue;
    }
    EXPECT_EQ(solver.run(), StopReason::end_time);
    const State& s = solver.state();
    EXPECT_EQ(s.results.deleted_solids, 1);
    EXPECT_NEAR(s.nodes.v[4].z, -30, 1e-9);
    EXPECT_NEAR(s.nodes.x[4].z, h - 30 * s.clock.time, 1e-9);
  }
}

/// A strip of shells is pulled together in its plane: ERODE = 10 deletes shells whose step falls below DTMIN, ERODE = 1 only solids.
TEST(Erosion, ShellsWhoseStepFallsBelowDtminAreDeleted) {
  for (const int erode : {10, 1}) {
    test::HandmadeModel b;
    Section section;
    section.kind = ElementKind::shell;
    section.shell.thickness = {0.01, 0.01, 0.01, 0.01};
    b.part(section, b.material_of(ElasticMaterial{density, 1e8, 0.0, 0, 0}));
    for (int i = 0; i <= 3; ++i) {
      for (const double y : {0.0, h}) {
        const NodeIndex n = b.node({h * i, y, 0});
        b.model.nodes.constrained[static_cast<std::size_t>(n)] = i == 0 ? dof_all : dof_y | dof_z | dof_rotations;
      }
    }
    for (int i = 0; i < 3; ++i) {
      b.model.shells.id.push_back(i + 1);
      b.model.shells.part.push_back(0);
      b.model.shells.nodes.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    PrescribedMotion motion;
    motion.nodes = {6, 7};
    motion.curve = b.curve({0, 1}, {-1, -1});
    b.model.prescribed_motions.push_back(motion);
    b.model.control.time_step.erode = erode;
    b.model.control.termination.dt_min = 0.6;
    b.model.control.termination.end_time = 0.16;
    Diagnostics diagnostics;
    Solver solver(b.model, {}, diagnostics);
    EXPECT_EQ(solver.run(), erode == 10 ? StopReason::end_time : StopReason::min_step);
    EXPECT_EQ(solver.state().results.deleted_shells > 0, erode == 10);
  }
}

}  // namespace
}  // namespace kardan

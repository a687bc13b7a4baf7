// *DAMPING_PART_STIFFNESS: damping ratios of modes whose frequency is known in closed form, energies, the stable step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "handmade_model.hpp"
#include "kardan/model/beam_sections.hpp"
#include "kardan/solver/solver.hpp"
#include "solver/bricks.hpp"

namespace kardan {
namespace {

constexpr double density = 1000, e_modulus = 4e9, h = 0.1;  // c = 2000
const double wave_speed = std::sqrt(e_modulus / density);

/// A free bar of `count` elements along z; its nodes stand in layers of `across`.
struct Bar {
  Bricks b;
  std::size_t across = 1;
  int count = 0;

  void swing(int half_waves) {
    for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
      InitialVelocity v;
      v.nodes = {static_cast<NodeIndex>(n)};
      v.velocity = {0, 0, std::cos(std::numbers::pi * half_waves * static_cast<double>(n / across) / count)};
      b.model.initial_velocities.push_back(v);
    }
  }
  /// omega of a mode of the lumped bar: 2 c/h sin(pi m/(2 N)).
  double frequency(int half_waves) const { return 2 * wave_speed / h * std::sin(0.5 * std::numbers::pi * half_waves / count); }
};

enum class Kind { truss, hughes_liu, hexahedron, full_hexahedron, shell, full_shell };

Bar bar(Kind kind, int count) {
  Bar bar;
  bar.count = count;
  Bricks& b = bar.b;
  const ElasticMaterial law{density, e_modulus, 0.0, 0, 0};
  if (kind == Kind::hexahedron || kind == Kind::full_hexahedron) {
    const PartIndex p = b.part(law);
    b.model.sections[0].solid.elform = kind == Kind::hexahedron ? 1 : 2;
    b.column(p, count, h);
    bar.across = 4;
  } else if (kind == Kind::shell || kind == Kind::full_shell) {
    Section section;
    section.kind = ElementKind::shell;
    section.shell.elform = kind == Kind::shell ? 2 : 16;
    section.shell.thickness = {h, h, h, h};
    const PartIndex p = b.HandmadeModel::part(section, b.material_of(law));
    for (int i = 0; i <= count; ++i) {
      b.node({0, 0, h * i});
      b.node({h, 0, h * i});
    }
    for (int i = 0; i < count; ++i) {
      b.model.shells.id.push_back(i + 1);
      b.model.shells.part.push_back(p);
      b.model.shells.nodes.push_back({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
    }
    bar.across = 2;
  } else {
    Section section;
    section.kind = ElementKind::beam;
    section.beam.elform = kind == Kind::truss ? beam_elform::truss : beam_elform::hughes_liu;
    section.beam.area = h * h;
    section.beam.ts = section.beam.tt = {h, h};
    const PartIndex p = b.HandmadeModel::part(section, b.material_of(law));
    for (int i = 0; i <= count; ++i) b.node({0, 0, h * i});
    const NodeIndex third = b.node({1, 0, 0});
    for (int i = 0; i < count; ++i) {
      b.model.beams.id.push_back(i + 1);
      b.model.beams.part.push_back(p);
      b.model.beams.nodes.push_back({i, i + 1, third});
    }
  }
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) b.model.nodes.constrained[n] = dof_x | dof_y | dof_rotations;
  b.model.control.bulk_q1 = b.model.control.bulk_q2 = 1e-20;
  return bar;
}

/// What is left of the kinetic energy after `periods` whole periods of the mode, when it is at a peak again.
double kinetic_left(Bar& bar, int half_waves, double periods, double* balance = nullptr) {
  bar.swing(half_waves);
  const double omega = bar.frequency(half_waves);
  bar.b.model.control.termination.end_time = periods * 2 * std::numbers::pi / omega;
  SolverOptions options;
  options.dt = 0.01 / omega;
  Diagnostics diagnostics;
  Solver solver(bar.b.model, options, diagnostics);
  solver.step();
  const double start = solver.state().energy.kinetic;
  EXPECT_EQ(solver.run(), StopReason::end_time);
  if (balance) *balance = solver.state().energy.total() / solver.state().energy.initial;
  return solver.state().energy.kinetic / start;
}

/// zeta = beta omega/2: the amplitude falls with exp(-zeta omega t), whatever element the bar is made of; what is lost stays in the ledger.
TEST(StiffnessDamping, RayleighsFactorDampsEveryModeByItsFrequency) {
  for (const Kind kind : {Kind::truss, Kind::hughes_liu, Kind::hexahedron, Kind::full_hexahedron, Kind::shell, Kind::full_shell}) {
    for (const int half_waves : {4, 8}) {
      Bar own = bar(kind, 8);
      const double omega = own.frequency(half_waves), zeta = 0.02, beta = 2 * zeta / omega, periods = 5;
      StiffnessDamping damping;
      damping.parts = {0};
      damping.beta = beta;
      own.b.model.stiffness_dampings = {damping};
      double balance = 0;
      const double left = kinetic_left(own, half_waves, periods, &balance);
      EXPECT_NEAR(std::log(left), -2 * zeta * 2 * std::numbers::pi * periods, 0.03) << static_cast<int>(kind) << " " << half_waves;
      EXPECT_NEAR(balance, 1.0, 0.005) << static_cast<int>(kind);
    }
  }
}

/// COEF > 0: at the highest frequency of the elements, 2 c/l, it is the damping ratio; a mode of n elements a wave has COEF sin(pi/n).
TEST(StiffnessDamping, TheFractionIsThatOfTheHighestFrequency) {
  for (const int half_waves : {2, 8}) {
    Bar own = bar(Kind::truss, 8);
    StiffnessDamping damping;
    damping.parts = {0};
    damping.fraction = 0.03;
    own.b.model.stiffness_dampings = {damping};
    const double zeta = 0.03 * std::sin(0.5 * std::numbers::pi * half_waves / 8), periods = 4;
    EXPECT_NEAR(std::log(kinetic_left(own, half_waves, periods)), -2 * zeta * 2 * std::numbers::pi * periods, 0.03) << half_waves;
  }
}

/// The step is sqrt(dt^2 + beta^2) - beta, and at nearly that step the bar is stable while slightly above it is not.
TEST(StiffnessDamping, TheStableStepKnowsIt) {
  const double undamped = h / wave_speed, fraction = 0.3;
  for (const double scale : {0.98, 1.03}) {
    Bar own = bar(Kind::truss, 8);
    StiffnessDamping damping;
    damping.parts = {0};
    damping.fraction = fraction;
    own.b.model.stiffness_dampings = {damping};
    own.swing(8);
    own.b.model.control.time_step.scale = scale;
    own.b.model.control.termination.end_time = 400 * undamped;
    Diagnostics diagnostics;
    Solver solver(own.b.model, {}, diagnostics);
    solver.step();
    EXPECT_NEAR(solver.view().step.dt, scale * undamped * (std::sqrt(1 + fraction * fraction) - fraction), 1e-9 * undamped);
    const double start = solver.state().energy.kinetic;
    double most = 0;
    try {
      while (solver.step()) most = std::max(most, solver.state().nodes.v[0].z);
    } catch (const RunError&) {
      most = 1e300;
    }
    EXPECT_GT(start, 0.0);
    EXPECT_EQ(most < 2, scale < 1) << most;
  }
}

/// Mass scaling knows that the damped step does not go with the root of the mass.
TEST(StiffnessDamping, MassScalingReachesTheStep) {
  Bar own = bar(Kind::truss, 4);
  StiffnessDamping damping;
  damping.parts = {0};
  damping.fraction = 0.2;
  own.b.model.stiffness_dampings = {damping};
  const double wanted = 1.5 * h / wave_speed;
  own.b.model.control.time_step.dt2ms = -wanted;
  own.b.model.control.termination.end_time = 1;
  Diagnostics diagnostics;
  Solver solver(own.b.model, {}, diagnostics);
  solver.step();
  const double first = solver.state().added_mass.added;
  EXPECT_NEAR(solver.view().step.dt, 0.9 * wanted, 1e-9 * wanted);
  solver.step();
  solver.step();
  EXPECT_NEAR(solver.state().added_mass.added, first, 1e-9 * first) << "the first time was enough";
}

TEST(StiffnessDamping, ARigidMotionIsNotDamped) {
  Bar own = bar(Kind::hexahedron, 2);
  for (std::size_t n = 0; n < own.b.model.nodes.size(); ++n) {
    own.b.model.nodes.constrained[n] = 0;
    InitialVelocity v;
    v.nodes = {static_cast<NodeIndex>(n)};
    v.velocity = Vec3{3, -1, 2} + cross(Vec3{20, 30, -10}, own.b.model.nodes.x[n]);
    own.b.model.initial_velocities.push_back(v);
  }
  StiffnessDamping damping;
  damping.parts = {0};
  damping.fraction = 0.25;
  own.b.model.stiffness_dampings = {damping};
  own.b.model.control.termination.end_time = 0.02;
  Diagnostics diagnostics;
  Solver solver(own.b.model, {}, diagnostics);
  solver.step();
  const double start = solver.state().energy.kinetic;
  solver.run();
  EXPECT_NEAR(solver.state().energy.kinetic, start, 1e-3 * start);
}

}  // namespace
}  // namespace kardan

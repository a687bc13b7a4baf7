#include "kardan/solver/solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace kardan {
namespace {

using testing::HasSubstr;

/// Point masses in space: node ids 101, 102, …
struct PointMasses {
  Model model;

  PointMasses(double end_time, double dt) {
    model.control.termination.end_time = end_time;
    model.control.time_step.initial = dt;
  }

  NodeIndex add(const Vec3& x, double mass) {
    const auto node = static_cast<NodeIndex>(model.nodes.size());
    model.nodes.id.push_back(101 + node);
    model.nodes.index_of.emplace(101 + node, node);
    model.nodes.x.push_back(x);
    model.nodes.constrained.push_back(0);
    if (mass > 0) {
      PointMass point;
      point.id = node + 1;
      point.node = node;
      point.mass = mass;
      model.masses.push_back(point);
    }
    return node;
  }

  CurveIndex curve(std::vector<double> x, std::vector<double> y) {
    Curve c;
    c.id = static_cast<UserId>(model.curves.size()) + 1;
    c.x = std::move(x);
    c.y = std::move(y);
    model.curves.push_back(c);
    return static_cast<CurveIndex>(model.curves.size()) - 1;
  }

  void gravity(double g) {
    BodyLoad load;
    load.axis = 2;
    load.curve = curve({0, 1e6}, {1, 1});
    load.scale = g;
    model.body_loads.push_back(load);
  }

  void velocity(NodeIndex node, const Vec3& v) {
    InitialVelocity initial;
    initial.nodes = {node};
    initial.velocity = v;
    model.initial_velocities.push_back(initial);
  }

  void spring(NodeIndex a, NodeIndex b, double stiffness) {
    Section section;
    section.kind = ElementKind::discrete;
    model.sections.push_back(section);
    Material material;
    SpringMaterial law;
    law.p[0] = stiffness;
    material.law = law;
    model.materials.push_back(material);
    Part part;
    part.id = 1;
    part.section = static_cast<Index>(model.sections.size()) - 1;
    part.material = static_cast<Index>(model.materials.size()) - 1;
    model.parts.push_back(part);
    model.discretes.id.push_back(1);
    model.discretes.part.push_back(static_cast<PartIndex>(model.parts.size()) - 1);
    model.discretes.nodes.push_back({a, b});
    model.discretes.orientation.push_back(none);
    model.discretes.scale.push_back(1);
    model.discretes.print.push_back(0);
    model.discretes.offset.push_back(0);
  }
};

/// Two masses on a spring, pulled apart at 1 length/time.
PointMasses oscillator(double end_time) {
  PointMasses masses(end_time, 0);
  const NodeIndex a = masses.add({0, 0, 0}, 2.0), b = masses.add({1, 0, 0}, 2.0);
  masses.spring(a, b, 100.0);
  masses.velocity(a, {-0.5, 0, 0});
  masses.velocity(b, {0.5, 0, 0});
  return masses;
}

/// Calls back where told to.
struct Watcher : Observer {
  std::function<bool(const State&)> when = [](const State&) { return true; };
  std::function<void(const State&, const StepView&)> what = [](const State&, const StepView&) {};
  int calls = 0;
  bool due(const State& state, const StepView&) override { return when(state); }
  void at(const Model&, const State& state, const StepView& view) override {
    ++calls;
    what(state, view);
  }
};

TEST(Solver, FreeFallIsExactAndCompleteAtTheEndTime) {
  PointMasses masses(0.3, 1e-3);
  masses.add({1, 2, 3}, 0.7);
  masses.add({0, 0, 0}, 0);  // hangs on nothing: stays
  masses.gravity(9.81);
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  EXPECT_EQ(solver.run(), StopReason::end_time);
  const State& state = solver.state();
  EXPECT_EQ(state.clock.time, 0.3);
  EXPECT_EQ(state.clock.cycle, 300);
  EXPECT_NEAR(state.nodes.x[0].z, 3 - 0.5 * 9.81 * 0.09, 1e-13);
  EXPECT_NEAR(state.nodes.v_now[0].z, -9.81 * 0.3, 1e-13);
  EXPECT_NEAR(state.nodes.a[0].z, -9.81, 1e-10);
  EXPECT_EQ(state.nodes.x[1], Vec3{});
  EXPECT_NEAR(state.energy.kinetic, 0.5 * 0.7 * std::pow(9.81 * 0.3, 2), 1e-12);
  EXPECT_NEAR(state.energy.ratio(), 1, 1e-12);
}

TEST(Solver, SpringOscillatesAtItsFrequencyAndStepIsSetByIt) {
  const double omega = std::sqrt(100.0 / 1.0);  // reduced mass 1
  PointMasses masses = oscillator(2 * M_PI / omega);
  Diagnostics diagnostics;
  Solver solver(masses.model, {.dt = 1e-4}, diagnostics);
  double largest = 0;
  Watcher watcher;
  watcher.what = [&](const State& s, const StepView&) { largest = std::max(largest, s.nodes.x[1].x - s.nodes.x[0].x); };
  solver.attach(watcher);
  solver.run();
  EXPECT_NEAR(largest, 1 + 1 / omega, 1e-6);
  EXPECT_NEAR(solver.state().nodes.x[1].x, 1, 1e-6);
  EXPECT_NEAR(solver.state().nodes.v_now[1].x, 0.5, 1e-6);
  EXPECT_NEAR(solver.state().energy.ratio(), 1, 1e-6);

  masses.model.control.termination.end_time = 1e4;  // 1/20,000 of it is more than the spring allows
  Solver free_step(masses.model, {}, diagnostics);
  ASSERT_TRUE(free_step.step());
  EXPECT_EQ(to_string(free_step.view().step), "discrete 1");
}

TEST(Solver, EndsAtTheCycleLimit) {
  PointMasses masses(1, 1e-3);
  masses.add({}, 1);
  masses.model.control.termination.end_cycle = 7;
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  EXPECT_EQ(solver.run(), StopReason::end_cycle);
  EXPECT_TRUE(normal(solver.stop_reason()));
  EXPECT_EQ(solver.state().clock.cycle, 7);
  EXPECT_FALSE(solver.step());
  EXPECT_EQ(solver.state().clock.cycle, 7);
}

TEST(Solver, EndsWhereTheStepFallsBelowItsLimit) {
  PointMasses masses(1, 0);
  masses.add({}, 1);
  masses.model.control.time_step.limit = masses.curve({0, 1}, {1e-2, 1e-4});
  masses.model.control.termination.dt_min = 0.5;
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  EXPECT_EQ(solver.run(), StopReason::min_step);
  EXPECT_NEAR(solver.state().clock.time, 0.505, 0.01);
}

TEST(Solver, EndsWhereTheEnergyRatioLeavesItsLimits) {
  PointMasses masses = oscillator(1e4);
  masses.model.control.termination.end_energy = 0.01;  // percent; the leapfrog's own ripple at 0.9 of the stable step is more
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  EXPECT_EQ(solver.run(), StopReason::energy);
  EXPECT_FALSE(normal(solver.stop_reason()));
  EXPECT_GT(std::abs(solver.state().energy.ratio() - 1), 1e-4);
}

TEST(Solver, StopsAfterTheCycleInProgressWhenAsked) {
  PointMasses masses(1, 1e-3);
  masses.add({}, 1);
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  Watcher watcher;
  watcher.what = [&](const State& state, const StepView& view) {
    if (state.clock.cycle == 10) solver.request_stop();
    EXPECT_EQ(view.last(), state.clock.cycle == 11);
  };
  solver.attach(watcher);
  EXPECT_EQ(solver.run(), StopReason::interrupted);
  EXPECT_EQ(solver.state().clock.cycle, 11);
  EXPECT_EQ(watcher.calls, 12);
}

TEST(Solver, EveryObserverSeesTheLastStateDueOrNot) {
  PointMasses masses(0.01, 1e-3);
  masses.add({}, 1);
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  Watcher third, never;
  third.when = [](const State& s) { return s.clock.cycle % 3 == 0; };
  never.when = [](const State&) { return false; };
  double last = -1;
  never.what = [&](const State& s, const StepView& view) {
    last = s.clock.time;
    EXPECT_EQ(view.stop, StopReason::end_time);
  };
  solver.attach(third);
  solver.attach(never);
  solver.run();
  EXPECT_EQ(third.calls, 5);  // cycles 0, 3, 6, 9 and the last
  EXPECT_EQ(never.calls, 1);
  EXPECT_EQ(last, 0.01);
}

TEST(Solver, BrokenRunNamesTheNodeAndShowsTheLastGoodState) {
  PointMasses masses(1, 1e-3);
  masses.add({5, 6, 7}, 1);
  masses.velocity(0, {1, 0, 0});
  PointLoad load;
  load.nodes = {0};
  load.dof = 1;
  load.curve = masses.curve({0, 0.5, 0.5001, 1}, {0, 0, 1e308, 1e308});
  load.scale = 1e10;
  masses.model.point_loads.push_back(load);
  Diagnostics diagnostics;
  Solver solver(masses.model, {}, diagnostics);
  Watcher watcher;
  watcher.when = [](const State&) { return false; };
  Vec3 x, v;
  StopReason seen = StopReason::running;
  watcher.what = [&](const State& state, const StepView& view) {
    x = state.nodes.x[0];
    v = state.nodes.v[0];
    seen = view.stop;
  };
  solver.attach(watcher);
  try {
    solver.run();
    FAIL() << "the run should have broken";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("node 101"));
    EXPECT_THAT(error.what(), HasSubstr("(5.501, 6, 7)"));
    EXPECT_THAT(error.what(), HasSubstr("cycle 501"));
  }
  EXPECT_EQ(seen, StopReason::broken);
  EXPECT_EQ(solver.stop_reason(), StopReason::broken);
  EXPECT_NEAR(x.x, 5.501, 1e-12);
  EXPECT_EQ(v.x, 1);
}

TEST(Solver, RefusesWhatCannotBeRunNamingTheIds) {
  PointMasses masses(0, 1e-3);
  masses.add({}, 1);
  Diagnostics no_end;
  EXPECT_THROW(Solver(masses.model, {}, no_end), InputError);
  EXPECT_THAT(to_string(no_end.all().back()), HasSubstr("*CONTROL_TERMINATION: the run has no end time"));

  PointMasses loose(1, 1e-3);
  loose.add({}, 1);
  loose.add({1, 0, 0}, 0);
  loose.spring(0, 1, 10);
  Diagnostics massless;
  EXPECT_THROW(Solver(loose.model, {}, massless), InputError);
  EXPECT_THAT(to_string(massless.all().back()), HasSubstr("node 102"));
}

TEST(Solver, CommandLineOverridesEndTimeAndStep) {
  PointMasses masses(1, 1e-3);
  masses.add({}, 1);
  Diagnostics diagnostics;
  Solver solver(masses.model, {.end_time = 0.5, .dt = 0.25}, diagnostics);
  solver.run();
  EXPECT_EQ(solver.state().clock.time, 0.5);
  EXPECT_EQ(solver.state().clock.cycle, 2);
}

TEST(Solver, StateIsTheSameToTheLastBitForAnyNumberOfThreads) {
  const auto hash = [](int threads) {
    PointMasses masses(0.02, 1e-3);
    for (int i = 0; i < 20'000; ++i) {  // more than one thread is given work
      const NodeIndex node = masses.add({std::sin(i), std::cos(3 * i), 0.1 * i}, 1 + std::fmod(0.37 * i, 1));
      if (i % 7 == 0) masses.velocity(node, {std::cos(i), 0.3, -0.1});
    }
    masses.gravity(9.81);
    Diagnostics diagnostics;
    Solver solver(masses.model, {.threads = threads}, diagnostics);
    solver.run();
    return solver.state().registry.hash();
  };
  const std::uint64_t one = hash(1);
  EXPECT_EQ(one, hash(2));
  EXPECT_EQ(one, hash(3));
}

TEST(JointHolding, DeckAndCommandLine) {
  Model model;
  EXPECT_EQ(joint_holding(model, {}).holding, JointHolding::exact);
  model.control.rigid.lmf = 1;
  EXPECT_THAT(joint_holding(model, {}).reason, HasSubstr("LMF = 1"));
  model.control.rigid.lmf = 0;
  EXPECT_EQ(joint_holding(model, {}).holding, JointHolding::penalty);
  EXPECT_THAT(joint_holding(model, {}).reason, HasSubstr("--joints exact"));
  EXPECT_EQ(joint_holding(model, JointHolding::exact).holding, JointHolding::exact);
  EXPECT_EQ(joint_holding(model, JointHolding::penalty).holding, JointHolding::penalty);
}

}  // namespace
}  // namespace kardan

// Mass damping: decay, terminal velocity, oscillator, energy, momentum of relative damping.
#include <gtest/gtest.h>

#include <cmath>

#include "loads/bench.hpp"

namespace kardan {
namespace {

TEST(Damping, FreeMassDecaysByTheFormOfTheHalfStepAndItsEnergyIsInTheLedger) {
  Bench b;
  b.node({0, 0, 0});
  DampingLaw law;
  law.value = 3;
  law.translation = {1, 0.5, 0};
  law.rotation = {0, 0, 2};
  b.model.dampings.push_back(law);
  b.size_state(2.0, 0.5);
  b.state.nodes.v[0] = {4, 4, 4};
  b.state.nodes.omega[0] = {1, 1, 1};
  LoadSystem loads(b.model, b.state, b.diagnostics);
  const double dt = 0.02;
  for (int i = 0; i < 100; ++i) b.step(loads, dt);
  // The first kick is half a step long.
  const auto decay = [&](double d) { return (2 - d * dt / 2) / (2 + d * dt / 2) * std::pow((2 - d * dt) / (2 + d * dt), 99); };
  EXPECT_NEAR(b.state.nodes.v[0].x, 4 * decay(3), 1e-14);
  EXPECT_NEAR(b.state.nodes.v[0].y, 4 * decay(1.5), 1e-14);
  EXPECT_EQ(b.state.nodes.v[0].z, 4.0);
  EXPECT_EQ(b.state.nodes.omega[0].x, 1.0);
  EXPECT_NEAR(b.state.nodes.omega[0].z, decay(6), 1e-14);
  EXPECT_NEAR(decay(3), std::exp(-3 * 1.99), 1e-3 * std::exp(-3 * 1.99) + 1e-4);  // t = 99.5 dt
  b.state.energy.system_damping = 0;
  b.model.dampings[0].value = 0;
  b.step(loads, dt);  // closes the last kick
  const double start = 0.5 * 2 * 48 + 0.5 * 0.5 * 3;
  const double end = b.kinetic_energy_after_kick() + 0.25 * dot(b.state.nodes.omega[0], b.state.nodes.omega[0]);
  EXPECT_NEAR(b.state.energy.system_damping, start - end, 1e-12 * start);
}

TEST(Damping, AnyConstantIsStableAndTheTerminalVelocityIsExact) {
  for (const double rate : {10.0, 1e3, 1e7}) {
    Bench b;
    b.node({0, 0, 0});
    DampingLaw law;
    law.value = rate;
    b.model.dampings.push_back(law);
    BodyLoad gravity;
    gravity.axis = 2;
    gravity.curve = b.curve({0, 1}, {-9.81, -9.81});
    b.model.body_loads.push_back(gravity);
    b.size_state();
    b.state.nodes.v[0] = {0, 0, 9.81 / rate};
    LoadSystem loads(b.model, b.state, b.diagnostics);
    for (int i = 0; i < 50; ++i) b.step(loads, 0.01);
    EXPECT_NEAR(b.state.nodes.v[0].z, 9.81 / rate, 1e-12 * 9.81 / rate + 1e-16) << rate;
    b.state.nodes.v[0].z *= 1.5;
    for (int i = 0; i < 50; ++i) b.step(loads, 0.01);
    EXPECT_LE(std::abs(b.state.nodes.v[0].z - 9.81 / rate), 0.5001 * 9.81 / rate) << rate;
  }
}

TEST(Damping, OscillatorDecaysAsInTheClosedForm) {
  // m x'' + D m x' + k x = 0: x = x0 exp(-D t/2) (cos wd t + D/(2 wd) sin wd t).
  const double omega = 50, rate = 10, wd = std::sqrt(omega * omega - rate * rate / 4);
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Bench b;
    b.node({0.3, 0, 0});
    DampingLaw law;
    law.curve = b.curve({0, 1}, {5, 5});
    law.value = 2;
    b.model.dampings.push_back(law);
    b.size_state(2.0);
    LoadSystem loads(b.model, b.state, b.diagnostics);
    const double dt = level == 0 ? 2e-3 : 1e-3;
    error[level] = 0;
    while (b.state.clock.time < 0.5) {
      b.step(loads, dt, [&](State& s) { s.nodes.force[0].x -= 2.0 * omega * omega * s.nodes.x[0].x; });
      const double t = b.state.clock.time;
      const double exact = 0.3 * std::exp(-rate * t / 2) * (std::cos(wd * t) + rate / (2 * wd) * std::sin(wd * t));
      error[level] = std::max(error[level], std::abs(b.state.nodes.x[0].x - exact));
    }
  }
  EXPECT_LT(error[1], 2e-3 * 0.3);
  EXPECT_NEAR(error[0] / error[1], 4, 0.2);  // of second order
}

TEST(Damping, NodeBetweenADampedAndAFreePartHasItsShare) {
  Bench b;
  for (int i = 0; i < 6; ++i) b.node({double(i), 0, 0});
  b.model.parts.resize(2);
  for (int p = 0; p < 2; ++p) {
    b.model.shells.id.push_back(p + 1);
    b.model.shells.part.push_back(p);
  }
  b.model.shells.nodes = {{0, 1, 2, 3}, {2, 3, 4, 5}};
  DampingLaw law;
  law.parts = {0};
  law.value = 8;
  b.model.dampings.push_back(law);
  b.size_state();
  for (Vec3& v : b.state.nodes.v) v = {1, 0, 0};
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.step(loads, 0.1);
  const auto after = [](double d) { return (2 - d * 0.05) / (2 + d * 0.05); };
  EXPECT_NEAR(b.state.nodes.v[0].x, after(8), 1e-15);
  EXPECT_NEAR(b.state.nodes.v[2].x, after(4), 1e-15);
  EXPECT_EQ(b.state.nodes.v[5].x, 1.0);
}

TEST(Damping, RelativeDampingReactsOnTheLeadBody) {
  Bench b;
  b.node({3, 1, 0});
  b.node({2, 0, 1});
  b.model.parts.resize(2);
  b.model.beams.id = {1};
  b.model.beams.part = {0};
  b.model.beams.nodes = {{0, 1, none}};
  DampingLaw law;
  law.parts = {0};
  law.relative_to = 1;
  law.value = 0.1;
  law.frequency = 20;
  b.model.dampings.push_back(law);
  b.size_state();
  b.state.bodies.of_part[1] = b.body(9, {1, 2, 3}, {0, 0, 0});
  b.state.bodies.motion[0].velocity = {1, 0, 0};
  b.state.bodies.motion[0].angular_velocity = {0, 0, 2};
  b.state.nodes.v[0] = Vec3{1, 0, 0} + cross(Vec3{0, 0, 2}, Vec3{3, 1, 0});           // moves with the body: no force
  b.state.nodes.v[1] = Vec3{1, 0, 0} + cross(Vec3{0, 0, 2}, Vec3{2, 0, 1}) + Vec3{0, 5, 0};
  LoadSystem loads(b.model, b.state, b.diagnostics);
  b.step(loads, 1e-5);
  const double rate = 4 * 3.14159265358979323846 * 20 * 0.1, kick = 0.5e-5;
  const double force = -rate * 2.0 * 5 / (1 + rate * kick / 2);
  EXPECT_NEAR(b.state.nodes.v[0].y, 6, 1e-14);
  EXPECT_NEAR(b.state.nodes.v[1].y, 9 + force * kick / 2.0, 1e-13);
  EXPECT_NEAR(norm(b.state.bodies.force[0] - Vec3{0, -force, 0}), 0, 1e-11);
  EXPECT_NEAR(norm(b.state.bodies.moment[0] - cross(Vec3{2, 0, 1}, Vec3{0, -force, 0})), 0, 1e-11);
}

}  // namespace
}  // namespace kardan

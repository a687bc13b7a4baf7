#include "elements/law_bench.hpp"

namespace kardan {
namespace {

using test::Bench;
using test::fields;

/// Behind the front of a shock.
struct Shocked {
  double front = 0, pressure = 0, volume = 0, energy = 0;  ///< speed of the front; p, V/V0, E
  double imbalance = 0;                                    ///< of the work of the piston, relative
};

/// A piston of constant speed at the end of a bar of null material that is free to move along x only.
Shocked drive(const EquationOfState& eos, double density, double piston, double speed_guess) {
  Bench b;
  FieldMaterial null = fields(9, 0, density, {{"pc", -1e9}});
  const PartIndex part = test::solid_part(b, null);
  b.model.equations_of_state.push_back(eos);
  b.model.parts[static_cast<std::size_t>(part)].equation_of_state = 0;
  const int cells = 200;
  test::block_of_cubes(b, part, cells, 1, 1, 1.0);
  b.start();
  EXPECT_TRUE(b.diagnostics.ok());
  const double end = 0.7 * cells / speed_guess;
  double work = 0, force = 0;
  const std::size_t columns = static_cast<std::size_t>(cells) + 1;
  b.forces();
  while (b.state.clock.time < end) {
    const double dt = std::min(0.5 * b.elements->stable_time_step(), 0.3 / speed_guess);
    double now = 0;
    b.step(
        dt,
        [&] {
          for (std::size_t n = 0; n < b.model.nodes.size(); n += columns) now -= b.state.nodes.force[n].x;
        },
        [&] {
          for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
            Vec3& v = b.state.nodes.v[n];
            v = {n % columns == 0 ? piston : v.x, 0, 0};
          }
        });
    work += now * piston * dt;
    force = now;
  }
  EXPECT_GT(force, 0);
  b.look();
  const auto at = [&](int cell) { return b.state.nodes.x[static_cast<std::size_t>(cell)].x; };
  Shocked s;
  // Far from the heated cells at the piston and from the front.
  const int first = cells * 3 / 10, last = cells / 2;
  for (int i = first; i < last; ++i) s.pressure -= b.state.results.solid.stress[static_cast<std::size_t>(i)][0] / (last - first);
  s.volume = (at(last) - at(first)) / (last - first);
  int front = 0;
  while (-b.state.results.solid.stress[static_cast<std::size_t>(front)][0] > 0.5 * s.pressure) ++front;
  s.front = front / b.state.clock.time;
  double kinetic = 0;
  for (std::size_t n = 0; n < b.model.nodes.size(); ++n) {
    if (n % columns != 0) kinetic += 0.5 * b.state.nodes.mass[n] * dot(b.state.nodes.v[n], b.state.nodes.v[n]);
  }
  s.imbalance = (kinetic + b.state.energy.internal - work) / work;
  return s;
}

/// rho0 U u = p, V = 1 - u/U and E = p (1 - V)/2 of Rankine 1870 and Hugoniot 1889, with the shock speed that the constants say.
TEST(Shock, GruneisenSatisfiesTheJumpConditions) {
  EquationOfState copper;
  copper.form = EquationOfState::Form::gruneisen;
  copper.constants = {3.94, 1.489, 0, 0, 2.02, 0.47, 0};
  const double density = 8.93, u = 1.0, speed = 3.94 + 1.489 * u, p = density * speed * u, v = 1 - u / speed;
  const Shocked s = drive(copper, density, u, speed);
  EXPECT_NEAR(s.front / speed, 1, 0.02);
  EXPECT_NEAR(s.pressure / p, 1, 0.02);
  EXPECT_NEAR((1 - s.volume) / (1 - v), 1, 0.02);
  EXPECT_NEAR(s.imbalance, 0, 0.01);
}

/// A strong shock in an ideal gas, p0 = 0.4 (gamma = 1.4): (gamma + 1)/2 u = U - c^2/U …
TEST(Shock, IdealGasSatisfiesTheJumpConditions) {
  EquationOfState gas;
  const double gamma = 1.4, energy = 1.0, density = 1.0, u = 3.0, p0 = (gamma - 1) * energy;
  gas.constants = {0, 0, 0, 0, gamma - 1, gamma - 1, 0};
  gas.initial_energy = energy;
  const double c2 = gamma * p0 / density, a = 0.25 * (gamma + 1) * u, speed = a + std::sqrt(a * a + c2);
  const Shocked s = drive(gas, density, u, speed);
  EXPECT_NEAR(s.front / speed, 1, 0.02);
  EXPECT_NEAR(s.pressure / (p0 + density * speed * u), 1, 0.02);
  EXPECT_NEAR((1 - s.volume) / (u / speed), 1, 0.02);
  EXPECT_NEAR(s.imbalance, 0, 0.05);
}

}  // namespace
}  // namespace kardan

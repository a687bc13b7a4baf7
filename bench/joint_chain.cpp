// Cost of a joint: a chain of N hinged rods (the oracle's chain: 0.1 m, 0.1 kg a rod, first hinge on the ground) falling
// from rest, dt = 1e-4, one thread, whole step of the rigid stage. Prints nanoseconds per joint and step, the largest
// separation of a joint and the drift of the total energy beside it.
//
//   joint_chain [--json] [--quick]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "options.hpp"
#include "rigid/mechanism.hpp"

namespace {

using namespace kardan;

test::Mechanism chain(int rods, JointKind kind) {
  constexpr double length = 0.1, mass = 0.1;
  test::Mechanism m;
  const PartIndex ground = m.ground({-1, 0, 0});
  PartIndex previous = ground;
  const double transverse = mass * length * length / 12 + 1e-5;
  for (int i = 0; i < rods; ++i) {
    const Vec3 hinge{length * i, 0, 0};
    const PartIndex rod = m.body(mass, hinge + Vec3{0.5 * length, 0, 0}, Mat3::diagonal({1e-5, transverse, transverse}));
    const Vec3 axis = hinge + Vec3{0, 0.05, 0};
    if (kind == JointKind::spherical) {
      m.joint(kind, previous, rod, {hinge, hinge});
    } else {
      m.joint(kind, previous, rod, {hinge, hinge, axis, axis});
    }
    previous = rod;
  }
  return m;
}

struct Figures {
  double ns = 0, separation = 0, drift = 0;
};

Figures measure(int rods, JointKind kind, JointHolding holding, double seconds) {
  const test::Mechanism m = chain(rods, kind);
  test::Simulation run(m.model, 1e-4, holding);
  run.gravity = {0, 0, -9.81};
  const auto total_energy = [&] {
    double potential = 0;
    for (std::size_t b = 0; b < run.state.bodies.info.size(); ++b)
      potential += 9.81 * run.state.bodies.info[b].mass * run.state.bodies.motion[b].center.z;
    return run.state.energy.kinetic + run.state.energy.joint + potential;
  };
  run.to(0.0);
  const double e0 = total_energy();
  double steps_time = 0.02;
  run.to(steps_time);  // warm
  std::vector<double> samples;
  double spent = 0, kinetic = 0;
  while (spent < seconds) {
    const double begin = bench::thread_seconds();
    run.to(steps_time + 0.01);
    const double elapsed = bench::thread_seconds() - begin;
    samples.push_back(elapsed / 100 / rods * 1e9);
    steps_time += 0.01;
    spent += elapsed;
  }
  const double e1 = total_energy();
  kinetic = run.state.energy.kinetic;
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2), samples.end());
  return {samples[samples.size() / 2], run.system->largest_separation().distance, (e1 - e0) / kinetic};
}

}  // namespace

int main(int argc, char** argv) {
  const kardan::bench::Options options(argc, argv);
  const bool json = options.json, quick = options.quick;
  if (!json) fmt::print("{:<12} {:<8} {:>7} {:>16} {:>14} {:>14}\n", "joint", "held", "rods", "ns/joint-step", "separation m", "energy drift");
  for (const auto kind : {JointKind::spherical, JointKind::revolute})
    for (const auto holding : {JointHolding::exact, JointHolding::penalty})
      for (const int rods : {100, 1000, 10000}) {
        const Figures f = measure(rods, kind, holding, quick ? 0.2 : 2.0);
        const char* held = holding == JointHolding::exact ? "exact" : "penalty";
        if (json) {
          fmt::print("{{\"case\":\"joint_chain\",\"joint\":\"{}\",\"held\":\"{}\",\"rods\":{},\"threads\":1,\"ns_per_joint_step\":{:.1f},"
                     "\"separation\":{:.3e},\"energy_drift\":{:.3e}}}\n", to_string(kind), held, rods, f.ns, f.separation, f.drift);
        } else {
          fmt::print("{:<12} {:<8} {:>7} {:>16.1f} {:>14.2e} {:>14.2e}\n", to_string(kind), held, rods, f.ns, f.separation, f.drift);
        }
      }
}

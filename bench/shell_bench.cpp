// Speed of the shell kernel: nanoseconds per element-cycle of ElementSystem::internal_forces on a dished plate.
// usage: kardan_bench_shell [--json] [--quick]
#include <cmath>
#include <cstdio>

#include "kardan/base/isa.hpp"
#include "kardan/elements/element_system.hpp"
#include "options.hpp"

namespace {

kardan::Model plate(int side, int points) {
  using namespace kardan;
  Model model;
  for (int j = 0; j <= side; ++j) {
    for (int i = 0; i <= side; ++i) {
      model.nodes.id.push_back(j * (side + 1) + i + 1);
      model.nodes.x.push_back({5.0 * i + 0.3 * std::sin(0.7 * j), 5.0 * j + 0.2 * std::cos(0.3 * i), std::sin(0.01 * i)});
      model.nodes.constrained.push_back(0);
    }
  }
  Section section;
  section.shell.thickness = {1.2, 1.2, 1.2, 1.2};
  section.shell.nip = points;
  model.sections.push_back(section);
  Material material;
  material.law = ElasticMaterial{7.8e-6, 210, 0.3, 0, 0};
  model.materials.push_back(material);
  Part part;
  part.id = 1;
  part.section = part.material = 0;
  model.parts.push_back(part);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const NodeIndex n = j * (side + 1) + i;
      model.shells.id.push_back(j * side + i + 1);
      model.shells.part.push_back(0);
      model.shells.nodes.push_back({n, n + 1, n + side + 2, n + side + 1});
    }
  }
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kardan;
  const auto [json, quick] = bench::Options(argc, argv);
  const int side = quick ? 160 : 320, cycles = quick ? 40 : 200;
  const Model model = plate(side, 3);
  State state;
  state.nodes.resize(model.nodes.size());
  state.nodes.x = model.nodes.x;
  Diagnostics diagnostics;
  ElementSystem elements(model, state, diagnostics);
  for (std::size_t n = 0; n < state.nodes.v.size(); ++n) {
    const Vec3& x = state.nodes.x[n];
    state.nodes.v[n] = Vec3{std::sin(0.03 * x.x), std::sin(0.05 * x.y), std::sin(0.02 * x.x + 0.01 * x.y)} * 1e-3;
  }
  elements.internal_forces(model, state);
  state.clock.dt_previous = 5e-4;
  const double start = bench::thread_seconds();
  for (int c = 0; c < cycles; ++c) elements.internal_forces(model, state);
  const double seconds = bench::thread_seconds() - start;
  const double ns = 1e9 * seconds / cycles / (static_cast<double>(side) * side);
  if (json) {
    std::printf("{\"case\":\"shell\",\"isa\":\"x86-64-v%d\",\"threads\":1,\"elements\":%d,\"ns_per_element_cycle\":%.1f}\n", kernel_level(),
                side * side, ns);
  } else {
    std::printf("%d elastic shells, 3 points, x86-64-v%d, 1 thread, %d cycles: %.1f ns per element-cycle\n", side * side,
                kernel_level(), cycles, ns);
  }
}

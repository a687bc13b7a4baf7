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

namespace {

struct Case {
  const char* name;
  kardan::Model model;
};

/// One row. The plate is stretched evenly at first, so that every point of the plastic one yields in every cycle that is timed.
void measure(const Case& c, int cycles, bool json) {
  using namespace kardan;
  State state;
  state.nodes.resize(c.model.nodes.size());
  state.nodes.x = c.model.nodes.x;
  Diagnostics diagnostics;
  ElementSystem elements(c.model, state, diagnostics);
  for (std::size_t n = 0; n < state.nodes.v.size(); ++n) {
    const Vec3& x = state.nodes.x[n];
    state.nodes.v[n] = Vec3{2e-5 * x.x + 1e-5 * x.y, -5e-6 * x.y + 1e-5 * std::sin(0.05 * x.y), 1e-4 * std::sin(0.02 * x.x + 0.01 * x.y)};
  }
  elements.internal_forces(c.model, state);
  state.clock.dt_previous = 1.0;
  for (int i = 0; i < 40; ++i) elements.internal_forces(c.model, state);
  const double start = bench::thread_seconds();
  for (int i = 0; i < cycles; ++i) elements.internal_forces(c.model, state);
  const double seconds = bench::thread_seconds() - start;
  const std::size_t shells = c.model.shells.size();
  const double ns = 1e9 * seconds / cycles / static_cast<double>(shells);
  if (json) {
    std::printf("{\"case\":\"%s\",\"isa\":\"x86-64-v%d\",\"threads\":1,\"elements\":%zu,\"ns_per_element_cycle\":%.1f}\n", c.name,
                kernel_level(), shells, ns);
  } else {
    std::printf("%-34s %zu shells, 3 points, x86-64-v%d, 1 thread, %d cycles: %.1f ns per element-cycle\n", c.name, shells,
                kernel_level(), cycles, ns);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kardan;
  const auto [json, quick] = bench::Options(argc, argv);
  const int side = quick ? 160 : 320, cycles = quick ? 40 : 200;
  Case elastic{"shell", plate(side, 3)};
  Case plastic{"shell_plastic", elastic.model};
  PiecewisePlasticMaterial m;
  m.density = 7.8e-6;
  m.youngs_modulus = 210;
  m.poissons_ratio = 0.3;
  m.points = 8;
  m.strain = {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
  m.stress = {10, 11, 12, 13, 14, 15, 16, 17};
  plastic.model.materials[0].law = m;
  Case idle = plastic;
  idle.name = "shell_plastic_law_elastic";
  for (double& stress : std::get<PiecewisePlasticMaterial>(plastic.model.materials[0].law).stress) stress *= 0.005;
  measure(elastic, cycles, json);
  measure(idle, cycles, json);
  measure(plastic, cycles, json);
}

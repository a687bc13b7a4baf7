// Speed of the solid kernel: nanoseconds per element-cycle of ElementSystem::internal_forces on a wavy block.
// usage: kardan_bench_solid [--json] [--quick]
#include <omp.h>

#include <cmath>
#include <cstdio>

#include "kardan/base/isa.hpp"
#include "kardan/elements/element_system.hpp"
#include "kardan/elements/solid/solid_kernel.hpp"
#include "options.hpp"

namespace {

kardan::Model block(int side) {
  using namespace kardan;
  Model model;
  const int n = side + 1;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        model.nodes.id.push_back((k * n + j) * n + i + 1);
        model.nodes.x.push_back(
            {5.0 * i + 0.3 * std::sin(0.7 * j), 5.0 * j + 0.2 * std::cos(0.3 * k), 5.0 * k + std::sin(0.1 * i)});
        model.nodes.constrained.push_back(0);
      }
    }
  }
  Section section;
  section.kind = ElementKind::solid;
  model.sections.push_back(section);
  Material material;
  material.law = ElasticMaterial{7.8e-6, 210, 0.3, 0, 0};
  model.materials.push_back(material);
  Part part;
  part.id = 1;
  part.section = part.material = 0;
  model.parts.push_back(part);
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const NodeIndex a = (k * n + j) * n + i, b = a + n * n;
        model.solids.id.push_back((k * side + j) * side + i + 1);
        model.solids.part.push_back(0);
        model.solids.nodes.push_back({a, a + 1, a + n + 1, a + n, b, b + 1, b + n + 1, b + n});
      }
    }
  }
  return model;
}

double nanoseconds(const kardan::Model& model, int cycles) {
  using namespace kardan;
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
  return 1e9 * (bench::thread_seconds() - start) / cycles / static_cast<double>(model.solids.size());
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kardan;
  const bench::Options options(argc, argv);
  const bool json = options.json, quick = options.quick;
  omp_set_num_threads(1);  // the clock is that of one thread
  const int side = quick ? 28 : 46, cycles = quick ? 40 : 200;
  Model model = block(side);
  for (const int hourglass : {2, 4}) {
    model.control.hourglass_type = hourglass;
    const double ns = nanoseconds(model, cycles);
    const char* name = hourglass == 2 ? "viscous" : "stiffness";
    const int elements = side * side * side;
    if (json) {
      std::printf(
          "{\"case\":\"solid\",\"hourglass\":\"%s\",\"isa\":\"x86-64-v%d\",\"threads\":1,\"elements\":%d,"
          "\"ns_per_element_cycle\":%.1f,\"history_bytes_per_element\":%zu}\n",
          name, kernel_level(), elements, ns, solid_history::law * sizeof(double));
    } else {
      std::printf(
          "%d elastic hexahedra, %s hourglass control, x86-64-v%d, 1 thread, %d cycles: %.1f ns per element-cycle\n",
          elements, name, kernel_level(), cycles, ns);
    }
  }
}

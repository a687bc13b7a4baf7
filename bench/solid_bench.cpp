// Speed of one-point hexahedra in the whole step: a slightly wavy block between smooth walls that is stretched along z at a constant
// rate, so that every element of the yielding one yields in every cycle.
// usage: kardan_bench_solid [--json] [--quick] [--csv FILE]
#include <cmath>

#include "kardan/elements/solid/solid_kernel.hpp"
#include "step_bench.hpp"

namespace {

using namespace kardan;

constexpr double size = 5.0;          ///< mm; units kg, mm, ms, kN
/// Operations of an element by the rows of bench::laws(), counted in the compiled kernel (x86-64-v4, where an instruction is one
/// operation of an element).
constexpr double operations[] = {1355, 1375, 1425};
constexpr double stretching = 0.024;  ///< 1/ms: 2e-5 of strain a cycle

Model block(int side) {
  Model model;
  const int n = side + 1;
  Curve constant;
  constant.x = {0, 1};
  constant.y = {1, 1};
  model.curves.push_back(constant);
  PrescribedMotion pull;
  pull.dof = 3;
  pull.curve = 0;
  pull.scale = stretching * size * side;
  for (int k = 0; k < n; ++k) {
    InitialVelocity initial;
    initial.velocity = {0, 0, stretching * size * k};
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        initial.nodes.push_back((k * n + j) * n + i);
        model.nodes.id.push_back((k * n + j) * n + i + 1);
        const bool wall_x = i == 0 || i == side, wall_y = j == 0 || j == side, wall_z = k == 0 || k == side;
        const double wave = wall_x || wall_y || wall_z ? 0.0 : 0.3 * std::sin(0.7 * i + 0.5 * j + 0.3 * k);
        model.nodes.x.push_back({size * i + wave, size * j - wave, size * k + wave});
        model.nodes.constrained.push_back(static_cast<std::uint8_t>((wall_x ? dof_x : 0) | (wall_y ? dof_y : 0) | (k == 0 ? dof_z : 0)));
        if (k == side) pull.nodes.push_back((k * n + j) * n + i);
      }
    }
    model.initial_velocities.push_back(initial);
  }
  model.prescribed_motions.push_back(pull);
  Section section;
  section.kind = ElementKind::solid;
  model.sections.push_back(section);
  model.materials.emplace_back();
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
  model.control.termination.end_time = 1e6;
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options(argc, argv);
  bench::StepReport report(options);
  for (const int side : {46, 100}) {
    if (options.quick && side > 46) break;
    bench::StepCase c;
    c.name = "solid";
    c.elements = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    c.model = block(side);
    const double nodes_a_tile = 1.42;  // 9^3 nodes on 8^3 elements
    const double* flops = operations;
    for (const auto& [variant, law] : bench::laws()) {
      c.variant = variant;
      c.model.materials[0].law = law;
      c.work.bytes = 2 * 8.0 * static_cast<double>(one_point_hexahedron.history_size(bench::law_values(law))) + bench::bytes_of_nodes(8, nodes_a_tile, 3);
      c.work.flops = *flops++;
      report.add(c, options.quick ? 1.0 : 4.0);
    }
  }
}

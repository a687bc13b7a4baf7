// Speed of Belytschko-Tsay shells in the whole step: a slightly wavy plate that is stretched along x at a constant rate, its other
// two edges held in the plane, so that the strain is nearly even and every point of the yielding one yields in every cycle.
// usage: kardan_bench_shell [--json] [--quick] [--csv FILE]
#include <cmath>

#include "kardan/elements/shell/shell_kernel.hpp"
#include "step_bench.hpp"

namespace {

using namespace kardan;

constexpr double size = 5.0;          ///< mm; units kg, mm, ms, kN
/// Operations of an element by the rows of bench::laws(), counted in the compiled kernel (x86-64-v4, where an instruction is one
/// operation of an element; the loop over the points three times, the yielding one with one evaluation of the return mapping).
constexpr double operations[] = {1000, 1070, 1490};
constexpr double stretching = 0.024;  ///< 1/ms: 2e-5 of strain a cycle

void add_supports(Model& model, int side) {
  Curve constant;
  constant.x = {0, 1};
  constant.y = {1, 1};
  model.curves.push_back(constant);
  PrescribedMotion pull;
  pull.dof = 1;
  pull.curve = 0;
  pull.scale = stretching * size * side;
  for (int j = 0; j <= side; ++j) {
    model.nodes.constrained[static_cast<std::size_t>(j * (side + 1))] |= dof_x;
    pull.nodes.push_back(j * (side + 1) + side);
    model.nodes.constrained[static_cast<std::size_t>(j)] |= dof_y;
    model.nodes.constrained[static_cast<std::size_t>(side * (side + 1) + j)] |= dof_y;
  }
  model.prescribed_motions.push_back(pull);
  for (int i = 0; i <= side; ++i) {
    InitialVelocity v;
    v.velocity = {stretching * size * i, 0, 0};
    for (int j = 0; j <= side; ++j) v.nodes.push_back(j * (side + 1) + i);
    model.initial_velocities.push_back(v);
  }
}

Model plate(int side) {
  Model model;
  for (int j = 0; j <= side; ++j) {
    for (int i = 0; i <= side; ++i) {
      const bool edge = i == 0 || j == 0 || i == side || j == side;
      const double wave = edge ? 0.0 : 0.3 * std::sin(0.7 * j + 0.3 * i);
      model.nodes.id.push_back(j * (side + 1) + i + 1);
      model.nodes.x.push_back({size * i + wave, size * j - wave, 0.1 * std::sin(0.01 * i)});
      model.nodes.constrained.push_back(0);
    }
  }
  Section section;
  section.shell.thickness = {1.2, 1.2, 1.2, 1.2};
  section.shell.nip = 3;
  model.sections.push_back(section);
  model.materials.emplace_back();
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
  add_supports(model, side);
  model.control.termination.end_time = 1e6;
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Options options(argc, argv);
  bench::StepReport report(options);
  for (const int side : {320, 1000}) {
    if (options.quick && side > 320) break;
    bench::StepCase c;
    c.elements = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    c.model = plate(side);
    const double nodes_a_tile = 1.09;  // 23.6^2 nodes on 22.6^2 elements
    const double* flops = operations;
    for (const int elform : {2, 16}) {
      c.name = elform == 2 ? "shell" : "shell_16";
      c.model.sections[0].shell.elform = elform;
      ShellProperties points;
      points.points = 3;
      points.in_plane = elform == 2 ? 1 : 4;
      for (const auto& [variant, law] : bench::laws()) {
        c.variant = variant;
        c.model.materials[0].law = law;
        const double history = 8.0 * static_cast<double>(shell_history_size(points, bench::law_values(law)));
        c.work.bytes = 2 * history + bench::bytes_of_nodes(4, nodes_a_tile, 6);
        c.work.flops = elform == 2 ? *flops++ : 0.0;  // those of ELFORM 16 are not counted
        report.add(c, options.quick ? 1.0 : 4.0);
      }
    }
  }
}

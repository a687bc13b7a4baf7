// The sections of a state.
#include <algorithm>

#include "kardan/io/d3plot/d3plot_writer.hpp"
#include "kardan/io/tables/summaries.hpp"

namespace kardan {

namespace {

template <class T>
T at_or_zero(const std::vector<T>& v, std::size_t i) {
  return i < v.size() ? v[i] : T{};
}

double mean(const std::array<double, 4>& t) {
  return 0.25 * (t[0] + t[1] + t[2] + t[3]);
}

double initial_thickness(const Model& model, std::size_t shell) {
  const auto own = model.shells.thickness.find(static_cast<Index>(shell));
  if (own != model.shells.thickness.end()) return mean(own->second);
  const Index section = model.parts[static_cast<std::size_t>(model.shells.part[shell])].section;
  return section == none ? 0.0 : mean(model.sections[static_cast<std::size_t>(section)].shell.thickness);
}

void shell_words(const Model& model, const ShellResults& r, std::size_t e, WordBuffer& out) {
  const auto layers = static_cast<std::size_t>(r.layers);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    for (const double s : at_or_zero(r.stress, e * layers + layer)) out.real(s);
    out.real(at_or_zero(r.plastic_strain, e * layers + layer));
  }
  out.vector(at_or_zero(r.bending, e));
  for (const double q : at_or_zero(r.shear, e)) out.real(q);
  out.vector(at_or_zero(r.membrane, e));
  out.real(e < r.thickness.size() ? r.thickness[e] : initial_thickness(model, e));
  out.zeros(2);  // element-dependent variables
  out.real(at_or_zero(r.internal_energy, e));
}

void line_words(const State& state, const D3plotLayout::Line& line, WordBuffer& out) {
  const auto e = static_cast<std::size_t>(line.element);
  if (line.discrete) {  // global x, y, z force and resultant, as LS-DYNA writes discrete elements
    const DiscreteReport report = at_or_zero(state.discretes, e);
    out.vector(report.global_force);
    out.real(report.force);
    out.zeros(2);
    return;
  }
  const BeamResults& r = state.results.beam;
  out.real(at_or_zero(r.axial, e));
  for (const double q : at_or_zero(r.shear, e)) out.real(q);
  for (const double m : at_or_zero(r.bending, e)) out.real(m);
  out.real(at_or_zero(r.torsion, e));
}

}  // namespace

void D3plotWriter::global_words(const Model& model, const State& state, WordBuffer& out) const {
  const std::vector<PartSummary> summaries = part_summaries(model, state);
  const auto of = [&](Index p) -> const PartSummary& { return summaries[static_cast<std::size_t>(p)]; };
  out.real(state.energy.kinetic);
  out.real(state.energy.internal);
  out.real(state.energy.total());
  out.vector(global_velocity(state));
  for (const Index p : layout_.parts) out.real(of(p).internal);
  for (const Index p : layout_.parts) out.real(of(p).kinetic);
  for (const Index p : layout_.parts) out.vector(of(p).velocity);
  for (const Index p : layout_.parts) out.real(of(p).mass);
  for (const Index p : layout_.parts) out.real(of(p).hourglass);
  for (const WallReport& wall : state.walls) out.real(wall.eased_normal_force);
  for (std::size_t i = 0; i < state.walls.size(); ++i) out.vector(model.rigid_walls[i].point + state.walls[i].displacement);
}

void D3plotWriter::element_words(const Model& model, const State& state, WordBuffer& out) const {
  const SolidResults& solid = state.results.solid;
  for (const Index i : layout_.solids) {
    const auto e = static_cast<std::size_t>(i);
    for (const double s : at_or_zero(solid.stress, e)) out.real(s);
    out.real(at_or_zero(solid.plastic_strain, e));
  }
  for (const D3plotLayout::Line& line : layout_.lines) line_words(state, line, out);
  for (std::size_t i = 0; i < layout_.shells.size(); ++i) {
    if (words_.material_types && layout_.rigid_shell[i] != 0) continue;
    shell_words(model, state.results.shell, static_cast<std::size_t>(layout_.shells[i]), out);
  }
}

void D3plotWriter::deletion_words(const Model& model, const State& state, WordBuffer& out) const {
  // Alive: the element's internal part number; deleted: 0.
  const auto put = [&](const std::vector<std::uint8_t>& alive, Index element, PartIndex part) {
    const auto e = static_cast<std::size_t>(element);
    const bool deleted = e < alive.size() && alive[e] == 0;
    out.real(deleted ? 0.0 : layout_.part_number[static_cast<std::size_t>(part)]);
  };
  for (const Index e : layout_.solids)
    put(state.results.solid.alive, e, model.solids.part[static_cast<std::size_t>(e)]);
  for (const Index e : layout_.shells)
    put(state.results.shell.alive, e, model.shells.part[static_cast<std::size_t>(e)]);
  static const std::vector<std::uint8_t> always;
  for (const D3plotLayout::Line& line : layout_.lines) {
    const auto e = static_cast<std::size_t>(line.element);
    if (line.discrete)
      put(always, line.element, model.discretes.part[e]);
    else
      put(state.results.beam.alive, line.element, model.beams.part[e]);
  }
}

}  // namespace kardan

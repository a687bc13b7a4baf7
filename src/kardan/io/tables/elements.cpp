// ELOUT: stresses of the elements of *DATABASE_HISTORY_SHELL and _SOLID, resultants of those of _BEAM.
#include <array>
#include <cmath>

#include "kardan/io/tables/reporter.hpp"

namespace kardan {

namespace {

constexpr const char* states = "elastic,plastic";
constexpr std::array<const char*, 6> stress_names{"sig_xx", "sig_yy", "sig_zz", "sig_xy", "sig_yz", "sig_zx"};

std::int64_t state_of(double plastic_strain) { return plastic_strain > 0 ? 2 : 1; }

void add_stresses(Folder& f, const std::vector<const StressVector*>& stresses) {
  for (std::size_t c = 0; c < 6; ++c) {
    f.add_scalars(stress_names[c], stresses.size(), [&](std::size_t i) { return (*stresses[i])[c]; });
  }
}

double von_mises(const StressVector& s) {
  const auto square = [](double v) { return v * v; };
  return std::sqrt(0.5 * (square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) +
                   3 * (square(s[3]) + square(s[4]) + square(s[5])));
}

Folder shell_folder(const Model& model, const State& state) {
  Folder f;
  f.path = "/elout/shell";
  f.text_metadata = {{"states", states}, {"system", model.output.global_shell_axes ? "global" : "local "}};
  IntegerColumn ids{"ids", {}}, parts{"mat", {}}, points{"nip", {}}, formulations{"iop", {}}, plastic{"state", {}};
  std::vector<const StressVector*> stresses;
  std::vector<double> strains;
  const auto& histories = state.results.shell.history;
  for (std::size_t i = 0; i < histories.size(); ++i) {
    if (histories[i].empty()) continue;  // rigid or deleted
    const auto shell = static_cast<std::size_t>(model.output.history_shells[i]);
    const Part& part = model.parts[static_cast<std::size_t>(model.shells.part[shell])];
    ids.values.push_back(model.shells.id[shell]);
    parts.values.push_back(part.id);
    points.values.push_back(static_cast<std::int64_t>(histories[i].size()));
    formulations.values.push_back(model.sections[static_cast<std::size_t>(part.section)].shell.elform);
    for (const PointStress& point : histories[i]) {
      plastic.values.push_back(state_of(point.plastic_strain));
      stresses.push_back(&point.stress);
      strains.push_back(point.plastic_strain);
    }
  }
  f.integers = {{"cycle", {state.clock.cycle}}, ids, parts, points, formulations, plastic};
  add_stresses(f, stresses);
  f.columns.push_back({"plastic_strain", strains});
  return f;
}

Folder solid_folder(const Model& model, const State& state) {
  const SolidResults& r = state.results.solid;
  Folder f;
  f.path = "/elout/solid";
  f.text_metadata = {{"states", states}};
  IntegerColumn ids{"ids", {}}, parts{"mtype", {}}, plastic{"state", {}};
  std::vector<const StressVector*> stresses;
  std::vector<double> strains;
  for (const Index i : model.output.history_solids) {
    const auto solid = static_cast<std::size_t>(i);
    const bool alive = r.alive.empty() || r.alive[solid] != 0;
    if (solid >= r.stress.size() || !alive || model.rigid_part(model.solids.part[solid])) continue;
    ids.values.push_back(model.solids.id[solid]);
    parts.values.push_back(model.parts[static_cast<std::size_t>(model.solids.part[solid])].id);
    plastic.values.push_back(state_of(r.plastic_strain[solid]));
    stresses.push_back(&r.stress[solid]);
    strains.push_back(r.plastic_strain[solid]);
  }
  f.integers = {{"cycle", {state.clock.cycle}}, ids, parts, plastic};
  add_stresses(f, stresses);
  f.columns.push_back({"yield", strains});
  f.add_scalars("effsg", stresses.size(), [&](std::size_t i) { return von_mises(*stresses[i]); });
  return f;
}

Folder beam_folder(const Model& model, const State& state) {
  const BeamResults& r = state.results.beam;
  Folder f;
  f.path = "/elout/beam";
  IntegerColumn ids{"ids", {}}, parts{"mat", {}};
  std::vector<std::size_t> chosen;
  for (const Index i : model.output.history_beams) {
    const auto beam = static_cast<std::size_t>(i);
    const bool alive = r.alive.empty() || r.alive[beam] != 0;
    if (beam >= r.axial.size() || !alive || model.rigid_part(model.beams.part[beam])) continue;
    chosen.push_back(beam);
    ids.values.push_back(model.beams.id[beam]);
    parts.values.push_back(model.parts[static_cast<std::size_t>(model.beams.part[beam])].id);
  }
  f.integers = {{"cycle", {state.clock.cycle}}, ids, parts};
  const std::size_t n = chosen.size();
  f.add_scalars("axial", n, [&](std::size_t i) { return r.axial[chosen[i]]; });
  f.add_scalars("shear_s", n, [&](std::size_t i) { return r.shear[chosen[i]][0]; });
  f.add_scalars("shear_t", n, [&](std::size_t i) { return r.shear[chosen[i]][1]; });
  f.add_scalars("moment_s", n, [&](std::size_t i) { return r.bending[chosen[i]][0]; });
  f.add_scalars("moment_t", n, [&](std::size_t i) { return r.bending[chosen[i]][1]; });
  f.add_scalars("torsion", n, [&](std::size_t i) { return r.torsion[chosen[i]]; });
  return f;
}

}  // namespace

std::vector<Folder> elout_folders(const Model& model, const State& state) {
  return {solid_folder(model, state), beam_folder(model, state), shell_folder(model, state)};
}

}  // namespace kardan

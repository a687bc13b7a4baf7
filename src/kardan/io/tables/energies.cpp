// GLSTAT and MATSUM.
#include "kardan/io/tables/reporter.hpp"
#include "kardan/io/tables/summaries.hpp"

namespace kardan {

namespace {

/// Position (from 1) of the owner's kind in GLSTAT's list of element types; 14 is printed without a number.
std::int64_t type_number(TimeStepOwner::Kind kind) {
  switch (kind) {
    case TimeStepOwner::Kind::discrete:
      return 1;
    case TimeStepOwner::Kind::solid:
      return 2;
    case TimeStepOwner::Kind::beam:
      return 3;
    case TimeStepOwner::Kind::shell:
      return 4;
    case TimeStepOwner::Kind::joint:
      return 6;
    case TimeStepOwner::Kind::prescribed:
      break;
  }
  return 14;
}

constexpr const char* element_types =
    "discrete,solid,beam,shell,thk shell,joint,unused,unused,unused,unused,unused,unused,unused,load curve or default";

}  // namespace

Folder glstat_folder(const Model& model, const State& state) {
  const EnergyLedger& e = state.energy;
  const TimeStepOwner& owner = state.step_owner;
  const auto elements = static_cast<std::int64_t>(model.shells.size() + model.solids.size() + model.beams.size() +
                                                  model.discretes.size());
  Folder f;
  f.path = "/glstat";
  f.text_metadata = {{"element_types", element_types}};
  f.integers = {{"cycle", {state.clock.cycle}},
                {"ts_eltype", {type_number(owner.kind)}},
                {"ts_element", {owner.id}},
                {"ts_part", {owner.part}},
                {"number_of_nodes", {static_cast<std::int64_t>(model.nodes.size())}},
                {"number_of_elements", {elements}},
                {"nzc", {0}}};
  const double base = e.initial + e.external_work;
  const double ratio_without_eroded = base != 0 ? (e.total() - e.eroded_kinetic - e.eroded_internal) / base : 1.0;
  const Vec3 v = global_velocity(state);
  const auto put = [&](const char* name, double value) { f.columns.push_back({name, {value}}); };
  put("time_step", state.clock.dt);
  put("kinetic_energy", e.kinetic);
  put("internal_energy", e.internal);
  if (!state.walls.empty()) put("stonewall_energy", e.stonewall);
  put("rb_stopper_energy", e.stopper);
  put("spring_and_damper_energy", e.spring_damper);
  put("joint_internal_energy", e.joint);
  put("hourglass_energy", e.hourglass);
  put("system_damping_energy", e.system_damping);
  put("sliding_interface_energy", e.sliding);
  put("external_work", e.external_work);
  put("eroded_kinetic_energy", e.eroded_kinetic);
  put("eroded_internal_energy", e.eroded_internal);
  put("eroded_hourglass_energy", 0.0);
  put("total_energy", e.total());
  put("energy_ratio", e.ratio());
  put("energy_ratio_wo_eroded", ratio_without_eroded);
  put("global_x_velocity", v.x);
  put("global_y_velocity", v.y);
  put("global_z_velocity", v.z);
  if (model.control.time_step.dt2ms != 0) {
    put("added_mass", state.added_mass.added);
    put("percent_increase", state.added_mass.percent());
  }
  return f;
}

Folder matsum_folder(const Model& model, const State& state) {
  const std::vector<PartSummary> summaries = part_summaries(model, state);
  std::vector<std::size_t> parts;
  Folder f;
  f.path = "/matsum";
  IntegerColumn ids{"ids", {}};
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    if (!listed(model.parts[p])) continue;
    parts.push_back(p);
    ids.values.push_back(model.parts[p].id);
    if (model.parts[p].title.empty()) continue;
    f.legend_ids.push_back(model.parts[p].id);
    f.legend.push_back(model.parts[p].title);
  }
  f.metadata.push_back(std::move(ids));
  f.integers = {{"cycle", {state.clock.cycle}}};
  const std::size_t n = parts.size();
  const auto of = [&](std::size_t i) -> const PartSummary& { return summaries[parts[i]]; };
  f.add_scalars("internal_energy", n, [&](std::size_t i) { return of(i).internal; });
  f.add_scalars("kinetic_energy", n, [&](std::size_t i) { return of(i).kinetic; });
  f.add_scalars("hourglass_energy", n, [&](std::size_t i) { return of(i).hourglass; });
  f.add_scalars("mass", n, [&](std::size_t i) { return of(i).mass; });
  f.add_vectors("x_momentum", "y_momentum", "z_momentum", n, [&](std::size_t i) { return of(i).momentum; });
  f.add_vectors("x_rbvelocity", "y_rbvelocity", "z_rbvelocity", n, [&](std::size_t i) { return of(i).velocity; });
  return f;
}

}  // namespace kardan

#include "kardan/app/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "kardan/app/isa.hpp"
#include "kardan/app/version.hpp"

namespace kardan::app {

namespace {

using nlohmann::json;

const char* key(StopReason reason) {
  static constexpr const char* keys[] = {"running", "end_time", "end_cycle", "min_step", "mass", "energy", "interrupted", "broken"};
  return keys[static_cast<int>(reason)];
}

/// What was put in, to compare an error with.
double given_energy(const EnergyLedger& e) { return std::abs(e.initial) + std::abs(e.external_work); }

json energies(const EnergyLedger& e) {
  const double given = given_energy(e);
  return {{"kinetic", e.kinetic},
          {"internal", e.internal},
          {"spring_and_damper", e.spring_damper},
          {"hourglass", e.hourglass},
          {"system_damping", e.system_damping},
          {"sliding", e.sliding},
          {"joint", e.joint},
          {"stopper", e.stopper},
          {"stonewall", e.stonewall},
          {"external_work", e.external_work},
          {"initial", e.initial},
          {"initial_joint_loss", e.initial_joint_loss},
          {"total", e.total()},
          {"ratio", e.ratio()},
          {"error", given > 0 ? (e.total() - e.initial - e.external_work) / given : 0.0}};
}

/// Energies of the parts that have any, at the last state.
json parts(const Model& model, const EnergyLedger& e) {
  json list = json::array();
  for (std::size_t p = 0; p < model.parts.size() && p < e.part_kinetic.size(); ++p) {
    if (e.part_kinetic[p] == 0 && e.part_internal[p] == 0 && e.part_hourglass[p] == 0) continue;
    list.push_back({{"id", model.parts[p].id},
                    {"title", model.parts[p].title},
                    {"kinetic", e.part_kinetic[p]},
                    {"internal", e.part_internal[p]},
                    {"hourglass", e.part_hourglass[p]}});
  }
  return list;
}

json wall_seconds(const Solver& solver, const RunRecord& record) {
  json seconds{{"total", record.wall_seconds}, {"reading", record.reading_seconds}};
  for (int p = 0; p < static_cast<int>(Phase::count); ++p) {
    std::string name = to_string(static_cast<Phase>(p));
    for (char& c : name) c = c == ' ' ? '_' : c;
    seconds[name] = solver.timers().seconds(static_cast<Phase>(p));
  }
  return seconds;
}

json messages(const Diagnostics& diagnostics, Severity severity) {
  json list = json::array();
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == severity) list.push_back(to_string(d));
  return list;
}

}  // namespace

json summarize(const Solver& solver, const RunRecord& record) {
  const Model& model = solver.model();
  const State& state = solver.state();
  const BuildInfo& build = build_info();
  json summary;
  summary["program"] = {{"name", "kardan"}, {"version", build.version}, {"commit", build.commit},
                        {"compiler", build.compiler}};
  summary["deck"] = record.request.deck.string();
  summary["title"] = model.title;
  summary["termination"] = {{"reason", key(solver.stop_reason())},
                            {"text", to_string(solver.stop_reason())},
                            {"normal", normal(solver.stop_reason())},
                            {"message", record.failure}};
  summary["cycles"] = state.clock.cycle;
  summary["time"] = state.clock.time;
  summary["end_time"] = solver.end_time();
  summary["dt"] = state.clock.dt;
  summary["dt_governed_by"] = to_string(solver.view().step);
  summary["joints"] =
      joint_holding(model, record.request.joints).holding == JointHolding::exact ? "exact" : "penalty";
  summary["threads"] = record.request.threads;
  summary["instruction_set"] = to_string(record.request.isa.value_or(native_isa()));
  summary["model"] = {{"nodes", model.nodes.size()},   {"parts", model.parts.size()},
                      {"shells", model.shells.size()}, {"solids", model.solids.size()},
                      {"beams", model.beams.size()},   {"discretes", model.discretes.size()},
                      {"bodies", state.bodies.motion.size()}, {"joints", model.joints.size()},
                      {"contacts", model.contacts.size()},  {"rigid_walls", model.rigid_walls.size()}};
  summary["wall_seconds"] = wall_seconds(solver, record);
  summary["energies"] = energies(state.energy);
  if (model.control.time_step.dt2ms != 0)
    summary["added_mass"] = {{"mass", state.added_mass.added}, {"percent", state.added_mass.percent()}};
  summary["parts"] = parts(model, state.energy);
  const RigidSystem::Separation separation = solver.rigid().largest_separation();
  summary["joint_separation"] = {{"distance", separation.distance}, {"angle", separation.angle}};
  if (separation.joint != none)
    summary["joint_separation"]["joint"] = model.joints[static_cast<std::size_t>(separation.joint)].id;
  summary["state_hash"] = fmt::format("{:016x}", state.registry.hash());
  summary["warnings"] = messages(record.diagnostics, Severity::warning);
  summary["notices"] = messages(record.diagnostics, Severity::notice);
  return summary;
}

std::string energy_verdict(const Model& model, const EnergyLedger& e) {
  const double given = given_energy(e);
  if (!(given > 0)) return "energy: none was given";
  std::string text = fmt::format("energy: total {:.6g}, given {:.6g} (initial {:.6g} + external work {:.6g}), error {:.3f} %", e.total(),
                                 e.initial + e.external_work, e.initial, e.external_work,
                                 100 * (e.total() - e.initial - e.external_work) / given);
  if (e.hourglass == 0) return text;
  text += fmt::format("; hourglass {:.2f} % of internal", e.internal > 0 ? 100 * e.hourglass / e.internal : 0.0);
  const auto worst = std::max_element(e.part_hourglass.begin(), e.part_hourglass.end());
  if (worst == e.part_hourglass.end() || !(*worst > 0)) return text;
  const auto p = static_cast<std::size_t>(worst - e.part_hourglass.begin());
  return text + fmt::format(", most of it in part {}{} ({:.6g} beside {:.6g} internal)", model.parts[p].id,
                            model.parts[p].title.empty() ? "" : " \"" + model.parts[p].title + "\"", *worst, e.part_internal[p]);
}

void write_summary(const std::filesystem::path& path, const json& summary) {
  std::ofstream file(path);
  file << summary.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
  if (!file.flush()) throw RunError(fmt::format("cannot write {}", path.string()));
}

}  // namespace kardan::app

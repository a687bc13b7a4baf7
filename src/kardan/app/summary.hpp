// DIR/summary.json: how a run went, for people and for scripts.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "kardan/app/command_line.hpp"
#include "kardan/base/diagnostics.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::app {

/// What the summary says beside what the solver knows.
struct RunRecord {
  const RunRequest& request;
  const Diagnostics& diagnostics;
  double reading_seconds = 0, wall_seconds = 0;
  std::string failure;  ///< what() of the RunError that broke the run, or empty
};

/// Keys: program, deck, title, termination {reason, text, normal, message}, cycles, time, end_time, dt, dt_governed_by,
/// joints, threads, instruction_set, model {…counts}, wall_seconds {total, reading, setup, loads, …}, energies {…, total,
/// ratio, error}, joint_separation {distance, angle, joint}, state_hash, warnings, notices. `error` is
/// (total - initial - external work) / max(|initial| + |external work|), 0 where there is no energy.
nlohmann::json summarize(const Solver& solver, const RunRecord& record);

/// @throws RunError if the file cannot be written.
/// For the end of the log: how well the energies balance, and which part's hourglass energy is worst.
std::string energy_verdict(const Model& model, const EnergyLedger& energy);

void write_summary(const std::filesystem::path& path, const nlohmann::json& summary);

}  // namespace kardan::app

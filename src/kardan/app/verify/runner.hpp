// Runs one deck in process and records signals at fixed cycles.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "kardan/app/verify/case.hpp"
#include "kardan/app/verify/series.hpp"

namespace kardan::verify {

/// Reads run.deck, runs it with the run's joints and constant step and samples every signal at t = 0, sample, 2 sample,
/// … `run.end`, between kick and drift, so nothing is interpolated. With the deck's own step samples are interpolated
/// linearly between the cycles around them.
/// @throws CaseError if the deck cannot be run, the run breaks, or the solver did not keep the step.
std::vector<Series> record(const Run& run, const std::vector<nlohmann::json>& signals);

}  // namespace kardan::verify

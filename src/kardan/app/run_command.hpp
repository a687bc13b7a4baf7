// `kardan run` and `kardan check`.
#pragma once

#include "kardan/app/command_line.hpp"
#include "kardan/app/log.hpp"

namespace kardan::app {

/// Reads the deck, runs it and writes the results and summary.json into the results folder. Returns the exit code.
int run_deck(const RunRequest& request, Log& log);

/// Reads the deck, sets the model up and reports on it. Returns 0, or 2 if the deck could not be run.
int check_deck(const RunRequest& request, Log& log);

}  // namespace kardan::app

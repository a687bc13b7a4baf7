// The restart files of a run: checkpoint-000001, checkpoint-000002 … in the folder of its results. The last two are kept.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kardan/app/command_line.hpp"
#include "kardan/app/log.hpp"
#include "kardan/app/result_files.hpp"
#include "kardan/io/checkpoint/checkpoint_file.hpp"
#include "kardan/io/deck/deck.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::app {

/// A restart file that a run can go on from.
struct RestartPoint {
  std::filesystem::path path;
  int number = 0;
  CheckpointFile file;
};

/// The newest restart file in `folder` that is whole and whose result files are there; says on the log what is wrong with newer ones.
/// @throws RunError where there is none
RestartPoint newest_restart_point(const std::filesystem::path& folder, Log& log);

/// What a run is: the version of Kardan, the deck's files and the options that its result depends on.
nlohmann::json identity_of(const RunRequest& request, const std::vector<deck::DeckFile>& files);
/// The request with the deck and the options of the restart file. Complains about options that were given and differ, and about
/// another version of Kardan.
RunRequest continued(const RunRequest& request, const nlohmann::json& head, Diagnostics& diagnostics);
/// Complains where the deck's files are not those of the restart file, by name.
void compare_files(const nlohmann::json& head, const std::vector<deck::DeckFile>& files, Diagnostics& diagnostics);

class Checkpoints {
 public:
  /// @param last  number of the restart file that the run goes on from, 0 = it begins
  Checkpoints(std::filesystem::path folder, nlohmann::json identity, CheckpointPlan plan, int last);

  const CheckpointPlan& plan() const { return plan_; }
  /// Between two cycles: result files onto the disk, then a restart file. @return a line for the log. @throws RunError
  std::string write(Solver& solver, ResultFiles& results);

 private:
  std::filesystem::path folder_;
  nlohmann::json identity_;
  CheckpointPlan plan_;
  int last_;
};

/// Those of an earlier run must not seem to be of the one that begins.
void remove_checkpoints(const std::filesystem::path& folder);

/// Copies the result files of a restart point, as far as they count, to another folder.
void copy_results(const std::filesystem::path& from, const std::filesystem::path& to, const nlohmann::json& mark);

}  // namespace kardan::app

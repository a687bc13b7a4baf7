// The writers of results as an observer of the run.
#pragma once

#include <filesystem>

#include "kardan/io/results_writer.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::app {

class ResultFiles : public Observer {
 public:
  ResultFiles(const Solver& solver, const std::filesystem::path& folder);
  /// Goes on where `mark` was taken; see ResultsWriter.
  ResultFiles(const Solver& solver, const std::filesystem::path& folder, const nlohmann::json& mark);

  bool due(const State& state, const StepView& view) override;
  bool reads_elements(const State& state, const StepView& view) const override;
  void at(const Model& model, const State& state, const StepView& view) override;
  /// Completes all files. @throws RunError if one cannot be written.
  void close();
  const ResultsWriter& writer() const { return writer_; }
  ResultsWriter& writer() { return writer_; }
  /// A d3plot state at the next cycle, beside those of its schedule.
  void ask_for_d3plot() { d3plot_asked_ = true; }

 private:
  bool d3plot_asked_ = false;
  ResultsWriter writer_;
};

}  // namespace kardan::app

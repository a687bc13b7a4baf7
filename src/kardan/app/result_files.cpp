#include "kardan/app/result_files.hpp"

#include <fmt/format.h>

#include "kardan/app/version.hpp"

namespace kardan::app {

namespace {

WriterOptions writer_options() {
  WriterOptions options;
  options.version = fmt::format("kardan {}", build_info().version);
  return options;
}

}  // namespace

ResultFiles::ResultFiles(const Solver& solver, const std::filesystem::path& folder)
    : writer_(solver.model(), solver.state(), folder, writer_options()) {}

ResultFiles::ResultFiles(const Solver& solver, const std::filesystem::path& folder, const nlohmann::json& mark)
    : writer_(solver.model(), solver.state(), folder, writer_options(), mark) {}

bool ResultFiles::due(const State& state, const StepView&) { return d3plot_asked_ || writer_.due(state.clock.time, state.clock.dt); }

bool ResultFiles::reads_elements(const State& state, const StepView& view) const {
  return view.last() || d3plot_asked_ || writer_.elements_due(state.clock.time, state.clock.dt);
}

void ResultFiles::at(const Model& model, const State& state, const StepView& view) {
  view.last() ? writer_.write_now(model, state) : writer_.write_due(model, state);
  if (d3plot_asked_) writer_.write_d3plot(model, state);
  d3plot_asked_ = false;
}

void ResultFiles::close() { writer_.finish(); }

}  // namespace kardan::app

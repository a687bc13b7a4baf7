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

bool ResultFiles::due(const State& state, const StepView&) { return writer_.due(state.clock.time, state.clock.dt); }

bool ResultFiles::reads_elements(const State& state, const StepView& view) const {
  return view.last() || writer_.elements_due(state.clock.time, state.clock.dt);
}

void ResultFiles::at(const Model& model, const State& state, const StepView& view) {
  view.last() ? writer_.write_now(model, state) : writer_.write_due(model, state);
}

void ResultFiles::close() { writer_.finish(); }

}  // namespace kardan::app

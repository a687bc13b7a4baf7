#include "kardan/app/run_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "kardan/app/interrupt.hpp"
#include "kardan/app/isa.hpp"
#include "kardan/app/progress.hpp"
#include "kardan/app/result_files.hpp"
#include "kardan/app/summary.hpp"
#include "kardan/app/version.hpp"
#include "kardan/contact/tie_search.hpp"
#include "kardan/io/deck/load.hpp"
#include "kardan/io/report/model_report.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::app {

namespace {

SolverOptions solver_options(const RunRequest& request) {
  return {.joints = request.joints, .dt = request.dt, .threads = request.threads};
}

/// The model of the deck. An end time of the command line takes the place of ENDTIM, so that whoever reads the model's
/// control (writers, solver) sees the one that holds.
Model load(const RunRequest& request, Diagnostics& diagnostics) {
  deck::LoadOptions options;
  options.read.without.insert(request.without.begin(), request.without.end());
  options.build.end_time = request.end_time.value_or(0.0);
  Model model = deck::load_model(request.deck, options, diagnostics);
  if (request.end_time) model.control.termination.end_time = *request.end_time;
  if (diagnostics.ok()) move_tied_nodes(model, diagnostics);
  return model;
}

/// What the deck asks for and Kardan cannot compute refuses the run.
void refuse_unsupported(const Model& model, Diagnostics& diagnostics) {
  for (const Diagnostic& unsupported : model.unsupported) diagnostics.add(unsupported);
}

void refuse(const Diagnostics& diagnostics, Log& log) {
  log.diagnostics(diagnostics);
  const std::size_t errors = diagnostics.error_count();
  log.error(fmt::format("{} error{}: the deck cannot be run", errors, errors == 1 ? "" : "s"));
}

/// Which files are written beyond, or short of, what the deck asks for.
void note_files(const ResultsWriter& writer, Diagnostics& diagnostics) {
  if (writer.defaulted())
    diagnostics.notice("the deck has no *DATABASE_… request: d3plot (20 states) and glstat are written all the same");
  for (OutputFile file : writer.unwritten())
    diagnostics.warning(fmt::format("*DATABASE_{} is asked for, but this version does not write it", to_string(file)));
}

/// Where the results are and what opens them.
void say_results(const std::filesystem::path& folder, Log& log) {
  log.line(fmt::format("results in {}:", folder.string()));
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string(); name == "d3plot")
      log.line("  d3plot        states of the model: LS-PrePost, ParaView (open as LS-DYNA), lasso, META");
    else if (name.starts_with("binout"))
      log.line(fmt::format("  {:<13} histories: LS-PrePost (Binout), lasso", name));
  log.line("  summary.json  how the run went");
}

/// The run itself, once the model stands. Returns what broke it, or nothing.
std::string march(Solver& solver) {
  const InterruptGuard guard(solver);
  try {
    solver.run();
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

void say_end(const Solver& solver, const std::string& failure, double seconds, Log& log) {
  if (!failure.empty()) log.error("error: " + failure);
  const Clock& clock = solver.state().clock;
  const char* kind = normal(solver.stop_reason()) ? "normal termination" : "error termination";
  log.line(fmt::format("{}: {} at t = {:g} after {} cycles and {:.2f} s", kind, to_string(solver.stop_reason()), clock.time,
                       clock.cycle, seconds));
  log.line(energy_verdict(solver.model(), solver.state().energy));
  if (solver.model().control.time_step.dt2ms != 0) {
    const AddedMass& mass = solver.state().added_mass;
    log.line(fmt::format("mass scaling: {:.6g} added to {:.6g} ({:.3f} %)", mass.added, mass.physical, mass.percent()));
  }
}

}  // namespace

int run_deck(const RunRequest& request, Log& log) {
  const Stopwatch watch;
  const BuildInfo& build = build_info();
  log.line(fmt::format("kardan {} (commit {}), {} thread{}, kernels for {}", build.version, build.commit, request.threads,
                       request.threads == 1 ? "" : "s", to_string(request.isa.value_or(native_isa()))));
  for (const std::string& note : request.notes) log.line("notice: " + note);
  if (request.isa) use_isa(*request.isa);

  Diagnostics diagnostics;
  const Model model = load(request, diagnostics);
  refuse_unsupported(model, diagnostics);
  if (!diagnostics.ok()) {
    refuse(diagnostics, log);
    return bad_input;
  }
  RunRecord record{request, diagnostics, watch.seconds(), 0, {}};
  std::optional<Solver> solver;
  try {
    solver.emplace(model, solver_options(request), diagnostics);
  } catch (const InputError&) {
    refuse(diagnostics, log);
    return bad_input;
  }

  const std::filesystem::path folder = request.results_folder();
  std::filesystem::create_directories(folder);
  std::filesystem::remove(folder / "summary.json");  // of an earlier run: a killed one must not seem to have ended well
  log.open_file(folder / "kardan.log");
  log.line(fmt::format("deck: {}", request.deck.string()));
  if (!model.title.empty()) log.line(fmt::format("title: {}", model.title));
  ResultFiles results(*solver, folder);
  note_files(results.writer(), diagnostics);
  log.diagnostics(diagnostics);
  Progress progress(log);
  solver->attach(results);
  solver->attach(progress);
  record.failure = march(*solver);
  results.close();
  record.wall_seconds = watch.seconds();
  write_summary(folder / "summary.json", summarize(*solver, record));
  say_end(*solver, record.failure, record.wall_seconds, log);
  say_results(folder, log);
  return normal(solver->stop_reason()) ? normal_termination : error_termination;
}

int check_deck(const RunRequest& request, Log& log) {
  Diagnostics diagnostics;
  const Model model = load(request, diagnostics);
  log.line(model_report(model));
  refuse_unsupported(model, diagnostics);
  if (diagnostics.ok()) {
    try {
      const Solver solver(model, solver_options(request), diagnostics);
    } catch (const InputError&) {  // what is wrong stands in `diagnostics`
    }
  }
  if (!diagnostics.ok()) {
    refuse(diagnostics, log);
    return bad_input;
  }
  log.diagnostics(diagnostics);
  log.line("the deck can be run");
  return normal_termination;
}

}  // namespace kardan::app

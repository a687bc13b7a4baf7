#include "kardan/app/run_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "kardan/app/checkpoints.hpp"
#include "kardan/app/isa.hpp"
#include "kardan/app/progress.hpp"
#include "kardan/app/result_files.hpp"
#include "kardan/app/run_control.hpp"
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
/// @param files  gets the files of the deck
Model load(const RunRequest& request, Diagnostics& diagnostics, std::vector<deck::DeckFile>* files = nullptr) {
  deck::LoadOptions options;
  options.read.without.insert(request.without.begin(), request.without.end());
  options.build.end_time = request.end_time.value_or(0.0);
  Model model = deck::load_model(request.deck, options, diagnostics, files);
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
std::string march(Solver& solver, RunControl& control, ResultFiles& results) {
  try {
    do {
      control.between_cycles();
    } while (solver.step());
    results.close();
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

/// A run on its way from the command line to the solver.
struct Run {
  Stopwatch watch;
  RunRequest request;
  Diagnostics diagnostics;
  std::optional<RestartPoint> from;     ///< what it goes on from
  std::vector<deck::DeckFile> files;    ///< of the deck
  double reading_seconds = 0;
};

void say_program(const RunRequest& request, Log& log) {
  const BuildInfo& build = build_info();
  log.line(fmt::format("kardan {} (commit {}), {} thread{}, kernels for {}", build.version, build.commit, request.threads,
                       request.threads == 1 ? "" : "s", to_string(request.isa.value_or(native_isa()))));
  for (const std::string& note : request.notes) log.line("notice: " + note);
}

/// The folder of the results, with what a run that goes on finds there.
std::filesystem::path prepare_folder(const Run& run) {
  std::filesystem::path folder = run.request.results_folder();
  std::filesystem::create_directories(folder);
  const bool elsewhere = run.from && !std::filesystem::equivalent(folder, run.request.restart);
  if (!run.from || elsewhere) remove_checkpoints(folder);
  if (elsewhere) copy_results(run.request.restart, folder, run.from->file.head().at("results"));
  std::filesystem::remove(folder / "summary.json");  // of an earlier run: a killed one must not seem to have ended well
  std::filesystem::remove(folder / "d3kil");         // an order to an earlier run
  return folder;
}

/// The run from the first step to the last line of the log.
int run_model(Run& run, Solver& solver, Log& log) {
  const std::filesystem::path folder = prepare_folder(run);
  const Model& model = solver.model();
  log.open_file(folder / "kardan.log", run.from.has_value());
  log.line(fmt::format("deck: {}", run.request.deck.string()));
  if (!model.title.empty()) log.line(fmt::format("title: {}", model.title));
  const Clock& clock = solver.state().clock;
  if (run.from) log.line(fmt::format("goes on from {} at t = {:g}, cycle {}", run.from->path.string(), clock.time, clock.cycle));
  ResultFiles results = run.from ? ResultFiles(solver, folder, run.from->file.head().at("results")) : ResultFiles(solver, folder);
  const CheckpointPlan plan = run.request.checkpoint.value_or(CheckpointPlan{0, model.output.restart_cycles});
  Checkpoints checkpoints(folder, identity_of(run.request, run.files), plan, run.from ? run.from->number : 0);
  run.from.reset();
  note_files(results.writer(), run.diagnostics);
  log.diagnostics(run.diagnostics);
  Progress progress(log);
  solver.attach(results);
  solver.attach(progress);
  RunRecord record{run.request, run.diagnostics, run.reading_seconds, 0, {}};
  RunControl control(solver, results, progress, checkpoints, folder, log);
  record.failure = march(solver, control, results);
  record.wall_seconds = run.watch.seconds();
  say_end(solver, record.failure, record.wall_seconds, log);
  write_summary(folder / "summary.json", summarize(solver, record));
  say_results(folder, log);
  return normal(solver.stop_reason()) ? normal_termination : error_termination;
}

}  // namespace

int run_deck(const RunRequest& given, Log& log) {
  Run run{{}, given, {}, {}, {}, 0};
  say_program(given, log);
  if (given.isa) use_isa(*given.isa);
  std::optional<Model> model;
  std::optional<Solver> solver;
  try {
    if (!given.restart.empty()) {
      run.from = newest_restart_point(given.restart, log);
      run.request = continued(given, run.from->file.head(), run.diagnostics);
    }
    if (run.diagnostics.ok()) {
      model = load(run.request, run.diagnostics, &run.files);
      refuse_unsupported(*model, run.diagnostics);
      if (run.from) compare_files(run.from->file.head(), run.files, run.diagnostics);
      run.reading_seconds = run.watch.seconds();
    }
    if (!run.diagnostics.ok()) throw InputError(run.diagnostics);
    solver.emplace(*model, solver_options(run.request), run.diagnostics);
    if (run.from) run.from->file.restore(solver->registry());
  } catch (const InputError&) {
    refuse(run.diagnostics, log);
    return bad_input;
  } catch (const RunError& error) {  // of the restart file
    log.error(fmt::format("error: {}", error.what()));
    return bad_input;
  }
  return run_model(run, *solver, log);
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

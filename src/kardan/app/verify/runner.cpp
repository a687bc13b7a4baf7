#include "kardan/app/verify/runner.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "kardan/app/verify/signal.hpp"
#include "kardan/io/deck/load.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::verify {
namespace {

class Recorder : public Observer {
 public:
  Recorder(const Run& run, std::vector<Signal> signals)
      : run_(run), signals_(std::move(signals)), series_(signals_.size()) {}

  bool due(const State& state, const StepView&) override { return state.clock.cycle % run_.steps == 0; }

  void at(const Model&, const State& state, const StepView&) override {
    if (state.clock.cycle % run_.steps != 0) return;  // the last state of a run, which everybody gets
    const auto n = state.clock.cycle / run_.steps;
    const double t = static_cast<double>(n) * run_.sample;
    if (std::abs(state.clock.time - t) > 1e-6 * run_.dt())
      throw CaseError("run " + run_.name + ": sample " + std::to_string(n) +
                      " is at t = " + std::to_string(state.clock.time) + " instead of " + std::to_string(t) +
                      ": the step was not kept");
    samples_ = n;
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const auto values = signals_[i](state);
      series_[i].width = values.size();
      series_[i].append(t, values);
    }
  }

  std::int64_t samples() const { return samples_; }
  std::vector<Series> take() { return std::move(series_); }

 private:
  const Run& run_;
  std::vector<Signal> signals_;
  std::vector<Series> series_;
  std::int64_t samples_ = -1;
};

[[noreturn]] void refuse(const Run& run, const Diagnostics& diagnostics) {
  std::string text = "run " + run.name + ": " + run.deck.string() + " cannot be run";
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) text += "\n  " + to_string(d);
  throw CaseError(text);
}

Model model_of(const Run& run, Diagnostics& diagnostics) {
  deck::LoadOptions options;
  options.build.end_time = run.end;
  Model model = deck::load_model(run.deck, options, diagnostics);
  for (const Diagnostic& unsupported : model.unsupported) diagnostics.add(unsupported);
  if (!diagnostics.ok()) refuse(run, diagnostics);
  return model;
}

}  // namespace

std::vector<Series> record(const Run& run, const std::vector<nlohmann::json>& signals) {
  Diagnostics diagnostics;
  const Model model = model_of(run, diagnostics);
  const auto last = static_cast<std::int64_t>(std::llround(run.end / run.sample));
  try {
    // The end lies a few steps beyond the last sample, so that the solver does not shorten the steps before it.
    Solver solver(model, {.joints = run.joints, .end_time = run.end + 10 * run.dt(), .dt = run.dt()}, diagnostics);
    std::vector<Signal> made;
    for (const auto& signal : signals) made.push_back(make_signal(signal, model, solver.state()));
    Recorder recorder(run, std::move(made));
    solver.attach(recorder);
    while (recorder.samples() < last && solver.step()) {
    }
    if (recorder.samples() < last)
      throw CaseError("run " + run.name + " ended early: " + to_string(solver.stop_reason()));
    return recorder.take();
  } catch (const InputError& e) {
    refuse(run, e.diagnostics());
  } catch (const RunError& e) {
    throw CaseError("run " + run.name + " broke: " + e.what());
  }
}

}  // namespace kardan::verify

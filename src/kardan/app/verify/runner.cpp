#include "kardan/app/verify/runner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "kardan/app/verify/signal.hpp"
#include "kardan/contact/tie_search.hpp"
#include "kardan/io/deck/load.hpp"
#include "kardan/solver/solver.hpp"

namespace kardan::verify {
namespace {

/// Values of all signals at the times of samples.
class Recorder : public Observer {
 public:
  Recorder(const Run& run, std::vector<Signal> signals, bool elements)
      : run_(run), signals_(std::move(signals)), series_(signals_.size()), elements_(elements) {}

  bool reads_elements(const State&, const StepView&) const override { return elements_; }
  std::int64_t samples() const { return samples_; }
  std::vector<Series> take() { return std::move(series_); }

 protected:
  double next_sample() const { return static_cast<double>(samples_ + 1) * run_.sample; }
  std::vector<std::vector<double>> values(const State& state) const {
    std::vector<std::vector<double>> all;
    for (const Signal& signal : signals_) all.push_back(signal(state));
    return all;
  }
  void add(const std::vector<std::vector<double>>& values) {
    const double t = next_sample();
    for (std::size_t i = 0; i < series_.size(); ++i) {
      series_[i].width = values[i].size();
      series_[i].append(t, values[i]);
    }
    ++samples_;
  }
  const Run& run_;

 private:
  std::vector<Signal> signals_;
  std::vector<Series> series_;
  std::int64_t samples_ = -1;
  bool elements_;  ///< some signal is a stress
};

/// A constant step that divides the interval of the samples.
class ConstantStepRecorder : public Recorder {
 public:
  using Recorder::Recorder;

  bool due(const State& state, const StepView&) override { return state.clock.cycle % run_.steps == 0; }

  void at(const Model&, const State& state, const StepView&) override {
    if (state.clock.cycle % run_.steps != 0) return;  // the last state of a run, which everybody gets
    if (std::abs(state.clock.time - next_sample()) > 1e-6 * run_.dt())
      throw CaseError("run " + run_.name + ": sample " + std::to_string(samples() + 1) +
                      " is at t = " + std::to_string(state.clock.time) + " instead of " +
                      std::to_string(next_sample()) + ": the step was not kept");
    add(values(state));
  }
};

/// The step of the deck: samples lie between two cycles and are interpolated linearly.
class FreeStepRecorder : public Recorder {
 public:
  using Recorder::Recorder;

  bool due(const State& state, const StepView&) override {
    return state.clock.time + 1.001 * state.clock.dt >= next_sample();  // the cycle before a sample and the one behind it
  }

  void at(const Model&, const State& state, const StepView&) override {
    const double t = state.clock.time;
    auto now = values(state);
    if (samples() < 0) add(now);
    while (t >= next_sample()) {
      const double share = (next_sample() - before_time_) / (t - before_time_);
      auto between = now;
      for (std::size_t i = 0; i < now.size(); ++i)
        for (std::size_t c = 0; c < now[i].size(); ++c) between[i][c] = before_[i][c] + share * (now[i][c] - before_[i][c]);
      add(between);
    }
    before_time_ = t;
    before_ = std::move(now);
  }

 private:
  double before_time_ = 0;
  std::vector<std::vector<double>> before_;
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
  move_tied_nodes(model, diagnostics);
  return model;
}

}  // namespace

std::vector<Series> record(const Run& run, const std::vector<nlohmann::json>& signals) {
  Diagnostics diagnostics;
  const Model model = model_of(run, diagnostics);
  const auto last = static_cast<std::int64_t>(std::llround(run.end / run.sample));
  try {
    // The end lies beyond the last sample, so that the solver does not shorten the steps before it.
    SolverOptions options{.joints = run.joints, .end_time = run.end + run.sample};
    if (!run.free_step()) {
      options.end_time = run.end + 10 * run.dt();
      options.dt = run.dt();
    }
    Solver solver(model, options, diagnostics);
    std::vector<Signal> made;
    for (const auto& signal : signals) made.push_back(make_signal(signal, model, solver.state()));
    const bool elements = std::any_of(signals.begin(), signals.end(), [](const nlohmann::json& signal) {
      return signal.dump().find("\"stress\"") != std::string::npos;
    });
    std::unique_ptr<Recorder> recorder;
    if (run.free_step())
      recorder = std::make_unique<FreeStepRecorder>(run, std::move(made), elements);
    else
      recorder = std::make_unique<ConstantStepRecorder>(run, std::move(made), elements);
    solver.attach(*recorder);
    while (recorder->samples() < last && solver.step()) {
    }
    if (recorder->samples() < last)
      throw CaseError("run " + run.name + " ended early: " + to_string(solver.stop_reason()));
    return recorder->take();
  } catch (const InputError& e) {
    refuse(run, e.diagnostics());
  } catch (const RunError& e) {
    throw CaseError("run " + run.name + " broke: " + e.what());
  }
}

}  // namespace kardan::verify

// Who looks at a run: writers of results, the progress line, the verification's recorders.
#pragma once

#include <cstdint>
#include <string>

#include "kardan/base/timer.hpp"
#include "kardan/model/model.hpp"
#include "kardan/solver/time_step.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// The stages of a step, in their order; `setup` is everything before the first one.
enum class Phase { setup, loads, elements, time_step, contact, rigid, nodes, ledger, observers, count };
const char* to_string(Phase phase);

/// Why a run ended.
enum class StopReason {
  running,      ///< it goes on
  end_time,     ///< ENDTIM
  end_cycle,    ///< ENDCYC
  min_step,     ///< DTMIN
  mass,         ///< ENDMAS: mass scaling has added more than that
  energy,       ///< ENDENG: the energy ratio left its limits
  interrupted,  ///< Solver::request_stop()
  broken        ///< RunError: a value that is not finite, |omega| dt > 1, …
};
/// "end time reached (ENDTIM)" …
const char* to_string(StopReason reason);
/// The run did what the deck asked for: exit code 0.
inline bool normal(StopReason reason) {
  return reason == StopReason::end_time || reason == StopReason::end_cycle || reason == StopReason::min_step || reason == StopReason::mass;
}

/// What an observer sees beside the model and the state.
struct StepView {
  const StepBound& step;               ///< the dt to come and what governs it
  const PhaseTimers<Phase>& timers;
  double end_time = 0;
  StopReason stop = StopReason::running;  ///< not running: this is the last state of the run
  std::int64_t elements_processed = 0; ///< deformable and discrete elements computed a cycle

  bool last() const { return stop != StopReason::running; }
};

/// Called between kick and drift, when everything "at t_n" is known.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Asked every cycle, so it must be cheap: does this observer want the state at t_n? It is not asked about the last
  /// state, which everybody gets.
  virtual bool due(const State& state, const StepView& view) = 0;
  /// False if only bodies and energies are looked at: then the nodes of rigid bodies and the joints' reports are not brought
  /// up to date for it.
  virtual bool reads_nodes() const { return true; }
  /// True if stresses and other results of elements are looked at (state.results): they are brought up to date for it. Asked only
  /// where this observer is due.
  virtual bool reads_elements(const State&, const StepView&) const { return false; }
  virtual void at(const Model& model, const State& state, const StepView& view) = 0;
};

}  // namespace kardan

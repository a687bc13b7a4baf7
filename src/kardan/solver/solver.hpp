// The run of a model from t = 0 to its end. No file formats here: results leave through observers.
//
//   Diagnostics diagnostics;
//   Solver solver(model, {.joints = JointHolding::penalty, .dt = 1e-6}, diagnostics);   // InputError if it cannot be run
//   solver.attach(my_recorder);
//   StopReason reason = solver.run();                                                  // RunError if it breaks
//   solver.state().bodies.motion[0].center;
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/base/timer.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/rigid_system.hpp"
#include "kardan/solver/observer.hpp"
#include "kardan/solver/time_step.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class ContactSystem;
class ElementSystem;
class RigidWalls;
class LoadSystem;
class NodeMover;
struct Relaxation;
class TiedContacts;

/// What the command line can override.
struct SolverOptions {
  std::optional<JointHolding> joints{};  ///< absent: as the deck says (see joint_holding)
  std::optional<double> end_time{};      ///< absent: ENDTIM
  std::optional<double> dt{};            ///< constant step if nothing deforms, else an upper bound
  int threads = 1;
};

/// The holding a run uses and a sentence for the log that says why. *CONTROL_RIGID LMF = 1 means exact, a
/// written 0 penalty, as in LS-DYNA; a blank field or no card at all is Kardan's default, exact.
struct HoldingChoice {
  JointHolding holding = JointHolding::exact;
  std::string reason;
};
HoldingChoice joint_holding(const Model& model, std::optional<JointHolding> given);

class Solver {
 public:
  /// Sets the run up: masses, bodies, joints, initial velocities, time step rule. `model` must outlive the solver.
  /// @throws InputError with everything found if the model cannot be run; warnings and notices go to `diagnostics`.
  Solver(const Model& model, const SolverOptions& options, Diagnostics& diagnostics);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// `observer` must outlive the run. Observers are called in the order of attachment.
  void attach(Observer& observer) { observers_.push_back(&observer); }

  /// Steps until something ends the run; the state is then complete at its last t_n (between kick and drift).
  /// @throws RunError if the run breaks, after all observers have seen the last good state with stop == broken.
  StopReason run();

  /// One step, or one cycle of the dynamic relaxation; false if the run has ended. For callers that steer the loop themselves.
  bool step();

  /// Makes the run end after the cycle in progress. Safe in a signal handler and from other threads.
  void request_stop() { stop_requested_.store(true, std::memory_order_relaxed); }

  /// The arrays of the run. Before the first step a restart may fill them: the run then goes on from there.
  Registry& registry() { return state_.registry; }

  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  const RigidSystem& rigid() const { return *rigid_; }
  const PhaseTimers<Phase>& timers() const { return timers_; }
  StopReason stop_reason() const { return stop_; }
  double end_time() const { return end_time_; }
  StepView view() const;

 private:
  void set_up(const SolverOptions& options, Diagnostics& diagnostics);
  void register_state();
  void clear_forces();
  void take_masses();
  void choose_time_step(const TimeStepRule& rule);
  void contact();
  void kick();
  /// One cycle of the dynamic relaxation.
  void relax();
  void end_relaxation();
  void account();
  StopReason reason_to_stop() const;
  void find_due_observers();
  void notify();

  const Model& model_;
  State state_;
  std::unique_ptr<ElementSystem> elements_;
  std::unique_ptr<LoadSystem> loads_;
  std::unique_ptr<RigidSystem> rigid_;
  std::unique_ptr<ContactSystem> contacts_;
  std::unique_ptr<RigidWalls> walls_;
  std::unique_ptr<TiedContacts> ties_;
  std::unique_ptr<NodeMover> nodes_;
  std::unique_ptr<TimeStepRule> rule_, relaxation_rule_;
  std::unique_ptr<Relaxation> relaxation_;  // null where there is none
  ClockHand clock_hand_;
  StepBound step_;
  double first_dt_ = 0, end_time_ = 0;
  std::int64_t elements_processed_ = 0;
  std::int64_t deleted_ = 0;  // elements that contacts know to be deleted
  std::vector<NodeIndex> summed_nodes_;  // nodes that receive forces: all but the idle nodes of bodies
  std::vector<NodeIndex> summed_not_kicked_;  // those among them that belong to bodies or have no mass
  StopReason stop_ = StopReason::running;
  std::atomic<bool> stop_requested_{false};
  std::vector<Observer*> observers_;
  std::vector<Observer*> due_;  ///< those that look at this cycle
  bool looked_at_ = true;       ///< somebody wants energies, or velocities at t_n, of this cycle
  bool relaxation_pending_ = false;  ///< the dynamic relaxation is still to come
  PhaseTimers<Phase> timers_;
};

}  // namespace kardan

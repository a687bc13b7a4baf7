// When a dynamic relaxation has come to rest.
#pragma once

#include <cstdint>
#include <vector>

#include "kardan/model/control.hpp"
#include "kardan/solver/time_step.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Kinetic energy of free nodes and bodies with the velocities in the state, in total and without the rigid motion of the whole.
struct MotionEnergy {
  double total = 0, distortional = 0;
};
MotionEnergy motion_energy(const State& state);

/// Watches the distortional kinetic energy: at rest when, between two checks, it never exceeds DRTOL of the largest so far. A
/// single check could hit a moment at which the model turns round. Where nothing distorts, as with a mass on a spring, it
/// watches the total.
class RelaxationWatch {
 public:
  explicit RelaxationWatch(const DynamicRelaxation& control) : control_(control) {}
  /// The energy of one more cycle.
  void add(const MotionEnergy& energy);
  bool at_rest() const { return at_rest_; }
  /// Largest energy since the check before last, of the largest of all.
  double ratio() const { return ratio_; }
  std::int64_t cycles() const { return cycles_; }

 private:
  DynamicRelaxation control_;
  MotionEnergy largest_, recent_;
  std::int64_t cycles_ = 0;
  double ratio_ = 1;
  bool at_rest_ = false;
};

/// The velocities of a state, put aside.
class Velocities {
 public:
  explicit Velocities(const State& state) : v_(state.nodes.v), omega_(state.nodes.omega), motion_(state.bodies.motion) {}
  void restore(State& state) const;
  void register_state(Registry& registry);

 private:
  std::vector<Vec3> v_, omega_;
  std::vector<BodyMotion> motion_;
};

/// What a dynamic relaxation carries from cycle to cycle beside the state.
struct Relaxation {
  Relaxation(const DynamicRelaxation& control, const State& state) : watch(control), initial(state) {}
  void register_state(Registry& registry);

  RelaxationWatch watch;
  ClockHand hand;
  Velocities initial;   ///< of t = 0
};

}  // namespace kardan

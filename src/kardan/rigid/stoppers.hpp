// *CONSTRAINED_RIGID_BODY_STOPPERS: limits on the coordinate, displacement or velocity of a body's centre (or its rotation).
//
// A stopper acts where the forces of the kick alone would carry the body past its limit in the step to come: the velocity
// along its direction is then prescribed such that the body meets the limit, and the body is free again as soon as the
// forces pull it back. What the impulse of the stop takes from the body, impulse x mean velocity of the kick, is the stopper
// energy: nothing while a body rests on its stop.
#pragma once

#include <map>
#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class Stoppers {
 public:
  void initialise(const Model& model, const State& state, Diagnostics& diagnostics);
  /// Bodies that may be stopped.
  std::vector<BodyIndex> bodies() const;
  void bind(const std::map<BodyIndex, std::size_t>& constraint_of);
  /// Adds the directions of the stoppers that act in this kick; trial velocities hold the kick of the applied forces.
  void prescribe(const Model& model, const State& state, BodySet& bodies);
  /// After the kick: energy taken by the stops that acted in it.
  void account(const State& state, const BodySet& bodies);
  /// Energy taken up to t_n.
  double energy() const { return energy_before_ + energy_until_now_; }
  /// Work of the stops on one body in the last kick.
  double work_on(std::size_t constraint) const;
  void register_state(State& state);

 private:
  struct Stopped {             ///< a body and how a stop of the lead reaches it
    BodyIndex body;
    double closure;
    std::size_t constraint;
  };
  struct Stopper {
    const RigidBodyStopper* deck;
    Stopped lead;
    std::vector<Stopped> followers_maximum, followers_minimum;
  };
  Vec3 direction(const Model& model, const Stopper& stopper) const;
  struct Acting {              ///< a stop of the kick in progress
    Stopped stopped;
    Vec3 along;
    bool rotation;
    double work;               ///< on the body, in the whole kick
  };
  void stop(const Stopper& stopper, const Stopped& stopped, const Vec3& direction, double value, BodySet& bodies);

  std::vector<Stopper> stoppers_;
  std::vector<double> turned_;     ///< by stopper: rotation about its direction so far
  std::vector<Acting> acting_;
  double energy_before_ = 0, energy_of_kick_ = 0, energy_until_now_ = 0;  ///< up to t_{n-1/2}, in the kick, in it up to t_n
};

}  // namespace kardan

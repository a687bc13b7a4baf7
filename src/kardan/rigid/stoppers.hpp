// *CONSTRAINED_RIGID_BODY_STOPPERS: limits on the coordinate, displacement or velocity of a body's centre (or its rotation).
//
// A stopper acts where the forces of the kick alone would carry the body past its limit in the step to come: the velocity
// along its direction is then prescribed such that the body meets the limit, and the body is free again as soon as the
// forces pull it back. The kinetic energy that the stop takes is reported as stopper energy.
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
  double energy() const { return energy_; }
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
  void stop(const Stopper& stopper, const Stopped& stopped, const Vec3& direction, double value, const State& state,
            BodySet& bodies);

  std::vector<Stopper> stoppers_;
  std::vector<double> turned_;     ///< by stopper: rotation about its direction so far
  double energy_ = 0;
};

}  // namespace kardan

// Fixed and prescribed degrees of freedom of the bodies, step by step: fills the BodyConstraints of a kick.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/body_assembly.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/stoppers.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class BodyMotions {
 public:
  /// Constraints of all bodies that have a fixed or prescribed degree of freedom, or a stopper. Appends one reaction to
  /// state.reactions for every prescribed motion.
  std::vector<BodyConstraint> initialise(const Model& model, State& state, const BodyAssembly& assembly,
                                         Diagnostics& diagnostics);

  /// Directions and values of the kick from t_{n-1/2} to t_{n+1/2}; with `initial`, the values at t = 0.
  void prescribe(const Model& model, const State& state, BodySet& bodies, bool initial);

  /// Reactions at t_n after the kick, and their work; what the stoppers took in it.
  void account(const Model& model, State& state, const BodySet& bodies);
  /// Work of the prescribed motions up to t_n.
  double work(const Clock& clock) const { return work_before_ + clock.share_before() * work_of_kick_; }
  /// Energy the stoppers have taken out.
  double stopper_energy() const { return stoppers_.energy(); }

  void register_state(State& state);

 private:
  struct Driver {             ///< one prescribed motion on one body
    Index motion;             ///< into Model::prescribed_motions
    std::size_t constraint;   ///< into BodySet::constraints
    std::size_t reaction;     ///< into State::reactions
    bool rotation;
  };
  struct Fixed {
    std::size_t constraint;
    BodyFixity fixity;
    double birth, death;
  };
  struct Directed {           ///< a direction and the point its rotation is about
    Vec3 direction;
    bool rotation = false;
    bool only = false;        ///< negative DOF: motion in the other directions of its kind is not permitted
    bool offset_axis = false;
    Vec3 axis_point;
  };
  /// The direction `ahead` of t_n.
  Directed direction_of(const Model& model, const State& state, const PrescribedMotion& motion, BodyIndex body,
                        double ahead) const;
  double speed(const Model& model, const State& state, const PrescribedMotion& motion, const Directed& d, BodyIndex body,
               std::size_t driver, bool initial) const;

  std::vector<Driver> drivers_;
  std::vector<Fixed> fixed_;
  Stoppers stoppers_;
  std::vector<double> travelled_;   ///< by driver: displacement (rotation) along its direction so far
  std::vector<double> reported_work_;  ///< by driver, so far: 0 where another driver of the body reports it
  std::vector<Vec3> directions_;    ///< by driver: of the kick in progress
  std::vector<std::uint8_t> counted_;  ///< scratch by constraint
  double work_before_ = 0, work_of_kick_ = 0;
};

}  // namespace kardan

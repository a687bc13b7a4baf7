// From the deck's joints to the runtime set, their failure, and what is said of redundant ones.
#pragma once

#include <vector>

#include "kardan/base/diagnostics.hpp"
#include "kardan/model/model.hpp"
#include "kardan/rigid/body_set.hpp"
#include "kardan/rigid/exact_joints.hpp"
#include "kardan/rigid/joint_set.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

/// Finds the bodies and points of every joint and appends its recipe; errors for joint nodes on no rigid body, or with
/// both sides on the same one.
void setup_joints(const Model& model, const State& state, JointSet& set, Diagnostics& diagnostics);

/// Takes out the rows that repeat what others hold in the position at t_n, and names their joints in one notice.
void find_redundant_joints(const Model& model, const State& state, JointSet& set, const BodySet& bodies, ExactJoints& exact,
                           Diagnostics& diagnostics);

/// *CONSTRAINED_JOINT_…_FAILURE: by time, or by force and moment resultants:
/// (N_x/NXX)^2 + (N_y/NYY)^2 + (N_z/NZZ)^2 >= 1 or the same of the moments; with COUPL the sum of both. Zero limits take no
/// part. Resultants in the failure system at t = 0 turning with body A.
class JointFailure {
 public:
  void initialise(const Model& model, const JointSet& joints);
  bool watches() const { return !watched_.empty(); }
  /// Marks joints that fail with the forces at t_n. @return model joints that failed in this call.
  const std::vector<Index>& check(const Model& model, const State& state, JointSet& joints, const BodySet& bodies,
                                  const std::vector<double>& force);

 private:
  std::vector<std::size_t> watched_;
  std::vector<Index> just_failed_;
};

}  // namespace kardan

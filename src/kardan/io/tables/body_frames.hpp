// Local systems and rotations of rigid bodies as the result files report them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan {

class BodyFrames {
 public:
  BodyFrames(const Model& model, const State& state);

  /// Local axes of body `b` at t_n (columns, global components): the output frame of *MAT_RIGID (LCO or A, V) or of the
  /// nodal rigid body (CID), moving with the body; its principal axes where none is given.
  Mat3 axes(const State& state, BodyIndex b) const;

  /// Follows the rotations to t_n. To be called at every output, in the order of time.
  void follow(const State& state);

  /// What a later run needs to go on.
  nlohmann::json mark() const;
  void resume(const nlohmann::json& mark);

  /// Rotation since t = 0 as a rotation vector (radians) at the last follow(). A rotation vector is unique up to whole
  /// turns about its axis; the turns are chosen nearest to the integral of the angular velocity between the outputs, so
  /// that a shaft's angle grows beyond pi. Whole turns are lost only if that integral is wrong by half a turn.
  const Vec3& rotation(BodyIndex b) const { return rotation_[static_cast<std::size_t>(b)]; }

 private:
  std::vector<Mat3> initial_axes_;
  std::vector<Vec3> rotation_, angular_velocity_;
  double time_ = 0;
};

}  // namespace kardan

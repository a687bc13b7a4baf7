// How far the nodes of a contact have moved against each other: says when the list of candidates must be renewed.
//
// Motion is measured against a common translation with the nodes' mean velocity (of the last renewal), so that a car that drives past costs nothing.
// Two nodes have approached each other by at most 2 (travel now - travel then), and since the last renewal by at most twice the largest way.
// Everything is counted from the last renewal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/state/registry.hpp"

namespace kardan {

class MotionMeter {
 public:
  explicit MotionMeter(std::vector<NodeIndex> nodes) : nodes_(std::move(nodes)) {}

  /// From now on these nodes count; renew() must follow.
  void watch(std::vector<NodeIndex> nodes) { nodes_ = std::move(nodes); }
  /// The positions of now are those of the list of candidates.
  void renew(const std::vector<Vec3>& x, const std::vector<Vec3>& v);
  void register_state(Registry& registry, const std::string& name);
  /// After a step of length dt with the velocities v.
  void advance(const std::vector<Vec3>& v, double dt);
  /// Whether some node has moved by more than `way` since renew().
  bool exceeds(double way, const std::vector<Vec3>& x);

  double travel() const { return travel_; }            ///< sum over the steps since renew() of the largest way
  double last_travel() const { return last_travel_; }  ///< of the last step

 private:
  std::vector<NodeIndex> nodes_;
  std::vector<Vec3> x_;              ///< at the last renewal
  Vec3 velocity_, shift_;
  double travel_ = 0, last_travel_ = 0;
  double checked_way_ = 0, checked_travel_ = 0;  ///< largest way when it was last looked at
};

}  // namespace kardan

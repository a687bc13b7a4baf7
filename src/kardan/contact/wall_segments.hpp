// Areas of a plane wall by which its force is reported (SSID of *RIGIDWALL_PLANAR_FORCES).
#pragma once

#include <array>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"
#include "kardan/model/model.hpp"

namespace kardan {

class WallSegments {
 public:
  WallSegments(const Model& model, const RigidWall& wall);

  bool empty() const { return corners_.empty(); }
  /// The first segment that holds r, seen along the normal; r relative to the wall's place at the start. `none` if there is none.
  Index find(const Vec3& r) const;

 private:
  Vec3 normal_;
  std::vector<std::array<Vec3, 4>> corners_;
};

}  // namespace kardan

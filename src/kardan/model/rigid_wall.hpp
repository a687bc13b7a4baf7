// Rigid walls: what nodes meet that is not meshed.
#pragma once

#include <string>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// *RIGIDWALL_PLANAR: an infinite plane that stands still.
struct RigidWall {
  UserId id = 0;
  std::string title;
  Vec3 point{}, normal{};            ///< of the plane; the unit normal points to the side of the nodes
  double friction = 0;               ///< FRIC: 0 frictionless, below 1 Coulomb's coefficient, 1 no sliding
  double birth = 0, death = 1e20;
  std::vector<NodeIndex> nodes;      ///< tracked: NSID without NSIDEX, in the box BOXID, within OFFSET
};

}  // namespace kardan

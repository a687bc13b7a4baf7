// One node in touch with one segment, and what is remembered of it from cycle to cycle.
#pragma once

#include <array>

#include "kardan/base/index.hpp"
#include "kardan/base/vec3.hpp"

namespace kardan {

/// Only numbers of eight bytes or pairs of four: it is part of the state's hash, so it has no gaps.
struct Touch {
  Index place = none;               ///< of the node in its surface
  Index segment = none;
  std::array<double, 4> weights{};  ///< of the segment's corners at the closest point
  Vec3 direction;                   ///< unit vector that leads the node out
  Vec3 force;                       ///< on the node at t_n, shared among the corners by -weights; zero where it is only remembered
  Vec3 friction;                    ///< stored in the spring of sticking, on the node
  double penetration = 0;           ///< depth of the node, `offset` not taken off
  double offset = 0;                ///< penetration that causes no force (what there was when it began)
  double largest = 0;               ///< penetration less offset reached so far
  double share = 0;                 ///< of the force that counts; 0 = only remembered
};

}  // namespace kardan

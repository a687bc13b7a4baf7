// The square crush tube of the benches: steel in kg, mm, ms, kN; 160 x 160 x 600 x 1.2, a rigid plate on top that shares its upper nodes and drives it
// down at 15 mm/ms onto a rigid wall, contact of everything with itself.
#pragma once

#include <vector>

#include "kardan/model/model.hpp"

namespace kardan::bench {

/// @param sides  shells across a side of the tube; the tube has some 15 sides^2 of them
Model crush_tube(int sides);
/// `count` copies of a model's shells beside one another, elastic, at rest in the positions x, with contact of everything with itself and without its
/// wall and motions: a large surface that is as folded as x.
Model folded_copies(const Model& tube, const std::vector<Vec3>& x, int count);

}  // namespace kardan::bench

// Names for the two kinds of integers that stand for things: an index into the model's arrays, and the user's own number.
#pragma once

#include <cstdint>

namespace kardan {

/// Position in one of the model's arrays; `none` where nothing is referred to.
using Index = std::int32_t;
inline constexpr Index none = -1;

using NodeIndex = Index;
using PartIndex = Index;
using BodyIndex = Index;
using CurveIndex = Index;

/// The number a user gave in the deck; shown in every message and result, never used to address an array.
using UserId = std::int64_t;

}  // namespace kardan

// The width of a block of elements in memory.
#pragma once

#include <cstddef>

namespace kardan {

/// Elements of a block; histories and connectivities of tiles lie in blocks (AoSoA) of this width on every machine.
inline constexpr std::size_t block_lanes = 8;

}  // namespace kardan

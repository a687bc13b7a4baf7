// Which instruction set the kernels of this run use.
#pragma once

namespace kardan {

/// Levels of x86-64: 1 (SSE2) to 4 (AVX-512).
inline constexpr int lowest_kernel_level = 2, highest_kernel_level = 4;

/// Highest level that this processor has.
int native_level();
/// Level of the kernels: what set_kernel_level() asked for, as far as the processor has it and there are kernels of it.
int kernel_level();
/// Call before the elements are made; 0 = the highest level there is. Results do not depend on it.
void set_kernel_level(int level);

}  // namespace kardan

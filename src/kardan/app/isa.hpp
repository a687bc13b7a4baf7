// Instruction sets of x86-64 by their levels.
#pragma once

#include <optional>
#include <string>

namespace kardan::app {

/// The levels the kernels are compiled for; the rest of the program is baseline x86-64.
enum class Isa { v2, v3, v4 };

/// "x86-64-v2" …
const char* to_string(Isa isa);
/// Accepts the names of to_string(), "v2" … and "native"; nothing otherwise.
std::optional<Isa> isa_from(const std::string& name);
/// The highest level this processor has: what a run uses unless it is told otherwise.
Isa native_isa();
/// Makes the kernels of the runs to come those of `isa`, which this processor must have.
void use_isa(Isa isa);

}  // namespace kardan::app

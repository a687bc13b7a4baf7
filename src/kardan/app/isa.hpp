// Instruction sets of x86-64 by their levels.
#pragma once

#include <optional>
#include <string>

namespace kardan::app {

enum class Isa { v1, v2, v3, v4 };

/// "x86-64", "x86-64-v2" …
const char* to_string(Isa isa);
/// Accepts the names of to_string(), "v2" … and "native"; nothing otherwise.
std::optional<Isa> isa_from(const std::string& name);
/// The highest level this processor has.
Isa native_isa();
/// The level the kernels of this build are compiled for.
Isa built_isa();

}  // namespace kardan::app

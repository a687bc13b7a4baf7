// The program `kardan`, callable in process.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace kardan::app {

/// Does what the arguments (without the program's name) say. @param terminal whether `out` is a terminal
/// @returns the exit code: 0 normal termination, 1 error termination, 2 bad input or usage
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, bool terminal);

}  // namespace kardan::app

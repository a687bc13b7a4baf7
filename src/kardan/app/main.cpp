#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "kardan/app/program.hpp"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return kardan::app::run_program(arguments, std::cout, std::cerr, isatty(STDOUT_FILENO) != 0);
}

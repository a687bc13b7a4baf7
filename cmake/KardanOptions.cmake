# Flags every target of Kardan is compiled with.
#
# Reproducibility: results must be the same to the last bit whatever the number of threads, so no
# fast-math, and multiply-add contraction is fixed rather than left to the optimiser's mood.
option(KARDAN_SANITIZE "build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(KARDAN_FUZZ "build the libFuzzer targets (clang only)" OFF)

add_library(kardan_options INTERFACE)
target_compile_options(kardan_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion -Werror
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_include_directories(kardan_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(KARDAN_SANITIZE)
  target_compile_options(kardan_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(kardan_options INTERFACE -fsanitize=address,undefined)
endif()

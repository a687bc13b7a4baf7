#include "kardan/elements/shell/c0_triangle.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

extern const TileKernels c0_triangle_kernels;
const TileKernels c0_triangle_kernels = {nullptr, nullptr, &triangle_tile<Called>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

#include "kardan/materials/erosion_update.hpp"
#include "kardan/materials/law_kernels.hpp"

namespace kardan::KARDAN_ISA_NAMESPACE {

template <class Point>
void update_eroding(const void* erosion, void* point, const StepTime& t, double* values) {
  erode(*static_cast<const Erosion*>(erosion), *static_cast<Point*>(point), t, values);
}

extern const LawKernels erosion_kernels;
const LawKernels erosion_kernels = {&update_eroding<MaterialPoint<Pack>>, &update_eroding<ShellPoint<Pack>>};

}  // namespace kardan::KARDAN_ISA_NAMESPACE

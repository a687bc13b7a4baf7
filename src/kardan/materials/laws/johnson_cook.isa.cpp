#include "kardan/materials/laws/johnson_cook.hpp"
#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(JohnsonCook, johnson_cook)

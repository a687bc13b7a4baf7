#include "kardan/materials/laws/power_plastic.hpp"
#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(PowerPlastic, power_plastic)

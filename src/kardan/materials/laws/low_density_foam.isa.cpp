#include "kardan/materials/laws/low_density_foam.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(LowDensityFoam, low_density_foam)

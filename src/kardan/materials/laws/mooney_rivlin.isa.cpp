#include "kardan/materials/laws/mooney_rivlin.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(MooneyRivlin, mooney_rivlin)

#include "kardan/materials/laws/rate_plastic.hpp"
#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(RatePlastic, rate_plastic)

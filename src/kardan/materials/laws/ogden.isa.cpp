#include "kardan/materials/laws/ogden.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(Ogden, ogden)

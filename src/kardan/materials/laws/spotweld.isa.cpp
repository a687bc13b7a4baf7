#include "kardan/materials/laws/spotweld.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(Spotweld, spotweld)

#include "kardan/materials/laws/crushable_foam.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(CrushableFoam, crushable_foam)

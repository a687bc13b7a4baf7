#include "kardan/materials/laws/frazer_nash.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(FrazerNash, frazer_nash)

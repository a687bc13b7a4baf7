#include "kardan/materials/laws/blatz_ko.hpp"

#include "kardan/materials/law_kernels.hpp"

KARDAN_LAW_KERNELS(BlatzKo, blatz_ko)
